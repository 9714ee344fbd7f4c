//! `verify overview --html`, and the page of `verify split`, in a real browser without a window.

use crate::common::browser::Browser;
use crate::common::{samples, verify, verify_with};
use std::fs;
use std::path::Path;

/// The page as the browser has it; nothing may have gone to the console.
fn opened(browser: &Browser, page: &Path) -> String {
    let (dom, said) = browser.dump(page, "");
    assert!(!said.contains("CONSOLE"), "{said}");
    assert!(!dom.contains("<script"), "the page has no script");
    dom
}

/// The part of a page in the section with this id.
fn section<'a>(page: &'a str, id: &str) -> &'a str {
    let (_, rest) = page
        .split_once(&format!("<section id=\"{id}\""))
        .unwrap_or_else(|| panic!("no section {id}: {page}"));
    rest.split_once("</section>").unwrap().0
}

/// The names of a part of a page, as its table has them.
fn count(text: &str, what: &str) -> usize {
    text.matches(what).count()
}

/// All that the screen says is on the page, with the images of every part, dashed lines where tracks
/// are too short, and dotted ones for suggestions.
#[test]
#[ignore = "needs samples and chromium"]
fn the_page_says_what_the_screen_says() {
    let colmap = samples();
    let browser = Browser::find();
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("page.html");
    let database = colmap.join("clusters_three_edges.db");
    let words = [
        "overview",
        database.to_str().unwrap(),
        "--html",
        page.to_str().unwrap(),
    ];
    let run = verify(&words);
    assert_eq!(run.code, 1, "{}", run.err);
    let dom = opened(&browser, &page);
    let summary = section(&dom, "summary");
    for line in run
        .out
        .lines()
        .skip(1)
        .filter(|line| !line.starts_with("  time "))
    {
        let words = line
            .get(14..)
            .unwrap_or(line)
            .trim()
            .trim_start_matches("# ");
        let words = words
            .replace('&', "&amp;")
            .replace('<', "&lt;")
            .replace('>', "&gt;");
        assert!(summary.contains(words.as_str()), "{words}: {summary}");
    }
    let images = section(&dom, "cameras");
    assert_eq!(count(images, "data-image="), 12);
    assert!(
        images.contains("2 pairs")
            || images.contains("3 pairs of images are matched, their tracks too short")
    );
    assert!(images.contains("are suggested to be matched"));
    assert!(images.contains("stroke-dasharray=\"6 4\"") && images.contains(" class=\"suggested\""));
    let parts = section(&dom, "parts");
    assert_eq!(count(parts, "6 images"), 2);
    for name in ["A_000.jpg", "A_003.jpg", "B_006.jpg", "B_011.jpg"] {
        assert!(parts.contains(name), "{name}: {parts}");
        assert!(images.contains(name), "{name}");
    }
    assert!(count(section(&dom, "suggestions"), "<li>") > 0);
    // The same page each time, and the same screen as without it.
    let first = fs::read(&page).unwrap();
    verify(&words);
    assert_eq!(fs::read(&page).unwrap(), first);
    let lines = |text: &str| {
        let lines = text.lines().filter(|line| !line.starts_with("  time "));
        lines.map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(lines(&verify(&words[..2]).out), lines(&run.out));
}

/// Pages of sets with and without parts, of pairs alone, and of what is no database.
#[test]
#[ignore = "needs samples and chromium"]
fn every_kind_of_input_has_a_page() {
    let colmap = samples();
    let browser = Browser::find();
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("page.html");
    for name in [
        "photos_banana.db",
        "photos_lund.db",
        "real_sceaux_421.db",
        "names.db",
    ] {
        let database = colmap.join(name);
        let run = verify(&[
            "overview",
            database.to_str().unwrap(),
            "--html",
            page.to_str().unwrap(),
        ]);
        assert!(run.code <= 1, "{name}: {}", run.err);
        let dom = opened(&browser, &page);
        let good = dom.contains("id=\"verdict\" class=\"good\"");
        assert_eq!(good, run.code == 0, "{name}");
    }
    // Names are of others: nothing of them is taken for a tag.
    let pairs = b"\"<b>x</b>\" \"&amp;\"\n\"&amp;\" c\nc \"<b>x</b>\"\n";
    let run = verify_with(pairs, &["overview", "-", "--html", page.to_str().unwrap()]);
    assert_eq!(run.code, 0, "{}", run.err);
    let dom = opened(&browser, &page);
    let images = section(&dom, "cameras");
    assert!(images.contains("&lt;b&gt;x&lt;/b&gt;"), "{images}");
    assert!(images.contains("&amp;amp;"), "{images}");
    assert!(images.contains("3 pairs of images are matched"), "{images}");
    // The page goes to standard output, and the words to standard error.
    let run = verify_with(pairs, &["overview", "-", "--html", "-"]);
    assert!(run.out.starts_with("<!DOCTYPE html>"), "{}", run.out);
    assert!(run.err.contains("  calibrated  "), "{}", run.err);
}

/// The input is never an output, and a page is about one input.
#[test]
fn a_page_is_apart_from_inputs() {
    let folder = tempfile::tempdir().unwrap();
    let graph = folder.path().join("graph.txt");
    fs::write(&graph, "a b\nb c\nc a\n").unwrap();
    let graph = graph.to_str().unwrap();
    let run = verify(&["overview", graph, "--html", graph]);
    assert_eq!(run.code, 2);
    assert!(
        run.err.contains("--html") && run.err.contains("this is the input"),
        "{}",
        run.err
    );
    assert_eq!(fs::read_to_string(graph).unwrap(), "a b\nb c\nc a\n");
    let page = folder.path().join("page.html");
    let run = verify(&[
        "overview",
        graph,
        "examples/house.txt",
        "--html",
        page.to_str().unwrap(),
    ]);
    assert_eq!(run.code, 2);
    assert!(run.err.contains("a page is about one input"), "{}", run.err);
    assert!(!page.exists());
}
