//! `verify draw` through the binary; the page in a real browser without a window.

use crate::common::browser::Browser;
use crate::common::{Run, cycle, data, samples, verify, verify_with};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// A page that the program has written, in a folder of its own.
struct Page {
    folder: tempfile::TempDir,
    run: Run,
}

impl Page {
    fn of(input: &[u8], arguments: &[&str]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("report.html");
        let draw = ["draw", arguments[0], path.to_str().unwrap()];
        let run = verify_with(input, &[&draw, &arguments[1..]].concat());
        assert!(run.code <= 1, "{}", run.err);
        Self { folder, run }
    }

    fn path(&self) -> PathBuf {
        self.folder.path().join("report.html")
    }

    fn text(&self) -> String {
        fs::read_to_string(self.path()).unwrap()
    }

    /// The JSON that the page carries.
    fn report(&self) -> Value {
        let text = self.text();
        let (_, rest) = text.split_once(r#"id="report">"#).unwrap();
        serde_json::from_str(rest.split_once("</script>").unwrap().0).unwrap()
    }

    /// The page as the browser has it, with this view in the address.
    fn opened(&self, browser: &Browser, view: &str) -> String {
        open(browser, &self.path(), view)
    }
}

/// The elements of a page after its script has run. Nothing may have gone to the console.
fn open(browser: &Browser, path: &Path, view: &str) -> String {
    let (page, said) = browser.dump(path, view);
    assert!(!said.contains("CONSOLE"), "{said}");
    assert!(page.contains(r#"role="alert" hidden"#), "{page}");
    // What a script shows of something that has no words.
    for nothing in ["[object ", ">undefined<", ">NaN<"] {
        let (body, _) = page.split_once("<script").unwrap_or((&page, ""));
        assert!(!body.contains(nothing), "{nothing}: {body}");
    }
    page
}

/// The part of a page between the tags of the element with this id.
fn section<'a>(page: &'a str, id: &str) -> &'a str {
    let (_, rest) = page.split_once(&format!("<section id=\"{id}\"")).unwrap();
    rest.split_once("</section>").unwrap().0
}

/// The text of an element's content.
fn text_of(content: &str) -> String {
    let mut text = String::new();
    let mut inside = false;
    for c in content.chars() {
        match c {
            '<' => inside = true,
            '>' if inside => inside = false,
            c if !inside => text.push(c),
            _ => (),
        }
    }
    let text = text.replace("&lt;", "<").replace("&gt;", ">");
    text.replace("&nbsp;", "\u{a0}").replace("&amp;", "&")
}

/// The cells of the rows of a table's body.
fn rows(page: &str, id: &str) -> Vec<Vec<String>> {
    let (_, body) = section(page, id).split_once("<tbody>").unwrap();
    let body = body.split_once("</tbody>").unwrap().0;
    let row = |row: &str| {
        let cells = row.split("<td").skip(1);
        let cells = cells.map(|cell| text_of(cell.split_once('>').unwrap().1));
        cells.collect()
    };
    body.split("<tr>").skip(1).map(row).collect()
}

/// What the page's facts say, by where they come from.
fn facts(page: &str) -> BTreeMap<String, String> {
    let value = |part: &str, name: &str| {
        let (_, rest) = part.split_once(&format!("{name}=\"")).unwrap();
        rest.split_once('"').unwrap().0.to_owned()
    };
    let facts = page.split("<dd data-from=").skip(1).map(|part| {
        let part = format!("data-from={}", part.split_once('>').unwrap().0);
        (value(&part, "data-from"), value(&part, "data-value"))
    });
    facts.collect()
}

/// Every fact that names a place in the report has the value that is there.
fn agrees(page: &str, report: &Value) {
    let mut places = 0;
    for (from, value) in facts(page) {
        if from.starts_with('/') && from != "/seconds" {
            let expected = report.pointer(&from).unwrap();
            let expected = expected
                .as_str()
                .map_or(expected.to_string(), str::to_owned);
            assert_eq!(value, expected, "{from}");
            places += 1;
        }
    }
    assert!(places >= 5, "{places}");
    let verdict = report["verdict"].as_str().unwrap();
    assert!(page.contains(&format!("data-verdict=\"{verdict}\"")));
}

const GAPS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/courtyard-gaps.txt");

#[test]
#[ignore = "needs chromium"]
fn the_numbers_on_the_page_are_those_of_the_json() {
    let page = Page::of(b"", &[GAPS, "--json", "--components"]);
    let report = page.report();
    assert_eq!(page.run.json(), std::slice::from_ref(&report));
    let browser = Browser::find();
    let opened = page.opened(&browser, "");
    agrees(&opened, &report);
    // Four walls with one pair at every corner: 28 photographs, 8 of them at corners.
    let facts = facts(&opened);
    for (name, value) in [("components", "8"), ("hinges", "8"), ("/graph/nodes", "28")] {
        assert_eq!(facts[name], value, "{name}");
    }
    let sizes = report["components"].as_array().unwrap().iter();
    let sizes = sizes.map(|part| vec![part["nodes"].to_string(), part["edges"].to_string()]);
    let shown = rows(&opened, "components");
    let shown_sizes = shown.iter().map(|row| row[1..3].to_vec());
    assert_eq!(shown_sizes.collect::<Vec<_>>(), sizes.collect::<Vec<_>>());
    let cameras = rows(&opened, "cameras");
    assert_eq!(cameras.len(), 28);
    // Every camera's pairs are counted at both ends.
    let ends: usize = cameras
        .iter()
        .map(|row| row[1].parse::<usize>().unwrap())
        .sum();
    assert_eq!(ends as u64, 2 * report["graph"]["edges"].as_u64().unwrap());
    // One pair at each corner.
    let joints = rows(&opened, "joints");
    let how: Vec<&str> = joints.iter().map(|row| &*row[1]).collect();
    assert_eq!(how, ["one pair"; 4]);
}

#[test]
#[ignore = "needs chromium"]
fn tables_sort_and_filter() {
    let browser = Browser::find();
    // A triangle with a long tail: c9 has one pair, c10 two; numbers sort as numbers.
    let list = "c1 c2\nc1 c3\nc2 c3\nc3 c10\nc10 c9\n";
    let page = Page::of(list.as_bytes(), &["-"]);
    let names = |view: &str| -> Vec<String> {
        let opened = page.opened(&browser, view);
        let rows = rows(&opened, "cameras").into_iter();
        rows.map(|row| row[0].clone()).collect()
    };
    assert_eq!(
        names("cameras.sort=image&cameras.order=descending"),
        ["c10", "c9", "c3", "c2", "c1"]
    );
    assert_eq!(
        names("cameras.sort=pairs&cameras.order=descending"),
        ["c3", "c1", "c10", "c2", "c9"]
    );
    assert_eq!(names("cameras.filter=C1&cameras.sort=image"), ["c1", "c10"]);
    assert_eq!(
        names("cameras.component=several&cameras.sort=image"),
        ["c3", "c10"]
    );
    assert_eq!(names("cameras.filter=nothing"), [""; 0]);
}

/// A name is text, whatever it holds: with the page's policy, and without it.
#[test]
#[ignore = "needs chromium"]
fn a_hostile_name_does_not_run() {
    let names = [
        "<script>document.title='taken'</script>",
        "</script><script>document.title='taken'</script>",
        "<img src=x onerror=document.title='taken'>",
        "</title></svg><svg onload=document.title='taken'>",
        "'-(document.title='taken')-'",
        "<!--{{script}}",
        "&lt;b&gt;",
    ];
    let lines = names.map(|name| format!("\"{name}\" plain\n")).concat();
    let pairs = format!("# viewcert pairs\n{lines}");
    let page = Page::of(pairs.as_bytes(), &["-"]);
    let labels = page.report()["components"].to_string();
    assert!(labels.contains("</title></svg><svg onload"), "{labels}");
    let browser = Browser::find();
    let text = page.text();
    let (before, rest) = text.split_once("<meta http-equiv").unwrap();
    let (_, after) = rest.split_once('>').unwrap();
    let lax = page.folder.path().join("lax.html");
    fs::write(&lax, format!("{before}{after}")).unwrap();
    for path in [page.path(), lax] {
        let opened = open(&browser, &path, "cameras.sort=image");
        assert!(opened.contains("<title>-</title>"), "{}", path.display());
        assert!(!opened.contains("<img src=\"x\""));
        let shown: Vec<String> = rows(&opened, "cameras")
            .into_iter()
            .map(|row| row[0].clone())
            .collect();
        for name in names {
            assert!(shown.contains(&name.to_owned()), "{name}: {shown:?}");
        }
    }
}

/// Parts that a report may have besides are shown as they stand in the JSON.
#[test]
#[ignore = "needs chromium"]
fn further_parts_are_shown() {
    let browser = Browser::find();
    let page = Page::of(cycle(4).as_bytes(), &["-"]);
    let extra = r#""extra":{"asked":"pairs","found":[{"pair":"x-y","inliers":3},{"pair":"x-z","inliers":12}]}"#;
    let text = page.text();
    let start = r#"id="report">{"#;
    assert!(text.contains(start));
    let path = page.folder.path().join("more.html");
    fs::write(&path, text.replace(start, &format!("{start}{extra},"))).unwrap();
    let opened = open(
        &browser,
        &path,
        "part-extra-found.sort=inliers&part-extra-found.order=descending",
    );
    // Four pairs, each two of which at an image share that image and nothing else.
    let joints = page.report()["joints"].as_array().unwrap().clone();
    assert_eq!(joints.len(), 4);
    for (row, joint) in rows(&opened, "joints").iter().zip(&joints) {
        let between = &joint["between"];
        assert_eq!(row[0], format!("{}, {}", between[0], between[1]));
        assert_eq!(row[1], "a shared image");
        assert_eq!(row[2], joint["images"][0].as_str().unwrap());
    }
    let found = rows(&opened, "part-extra-found");
    assert_eq!(found, [["x-z", "12"], ["x-y", "3"]]);
}

/// Pages of graphs as they are: all nodes drawn, and some of them.
#[test]
#[ignore = "needs data and chromium"]
fn real_graphs_have_pages() {
    let folder = data();
    let browser = Browser::find();
    for (name, detailed) in [("Tower_of_London", true), ("Roman_Forum", false)] {
        let path = folder.join(format!("table3/{name}.mat"));
        let page = Page::of(b"", &[path.to_str().unwrap()]);
        let report = page.report();
        let nodes = report["graph"]["nodes"].as_u64().unwrap() as usize;
        // Both fall into four components in the paper's Table 3.
        assert_eq!(report["components"].as_array().unwrap().len(), 4, "{name}");
        let opened = page.opened(&browser, "");
        agrees(&opened, &report);
        let drawn = opened.matches("<g data-node=").count();
        assert_eq!(drawn == nodes, detailed, "{name}: {drawn} of {nodes}");
        assert!(fs::metadata(page.path()).unwrap().len() < 3 << 20, "{name}");
    }
}

/// Two groups of four cameras and four points each, which share camera 3, and a camera that sees
/// nothing, as a problem of bundle adjustment.
fn tracks() -> String {
    let group = |cameras: [u32; 4], first: u32| {
        cameras
            .into_iter()
            .flat_map(move |c| (first..first + 4).map(move |p| (c, p)))
    };
    let seen: Vec<(u32, u32)> = group([0, 1, 2, 3], 0)
        .chain(group([3, 4, 5, 6], 4))
        .collect();
    let lines: String = seen
        .iter()
        .map(|(c, p)| format!("{c} {p} 0.5 0.5\n"))
        .collect();
    format!(
        "8 8 {}\n{lines}{}",
        seen.len(),
        "0.5\n".repeat(9 * 8 + 3 * 8)
    )
}

/// Two triangles with one camera and a pair that hangs on: with two calibrated cameras in each triangle
/// both are metric, and nothing is known of what hangs on (theory, Theorem 17.3).
#[test]
#[ignore = "needs chromium"]
fn intrinsics_are_drawn_over_the_picture() {
    let folder = tempfile::tempdir().unwrap();
    let classes = folder.path().join("classes.txt");
    fs::write(&classes, "known a c d\n").unwrap();
    let asked = ["-", "--json", "--intrinsics", classes.to_str().unwrap()];
    let page = Page::of(b"a b\na c\nb c\nc d\nc e\nd e\ne f\n", &asked);
    let report = page.report();
    assert_eq!(report["intrinsics"]["verdict"], "not-metric");
    let browser = Browser::find();
    let opened = page.opened(&browser, "");
    agrees(&opened, &report);
    let lines = |part: &str| {
        let (before, _) = opened.split_once(&format!("data-metric=\"{part}\""))?;
        Some(
            before[before.rfind("<path").unwrap()..]
                .matches('M')
                .count(),
        )
    };
    let found = ["1", "2", "3", "none"].map(lines);
    assert_eq!(found, [Some(3), Some(3), None, Some(1)]);
    let rings = |determined: bool| {
        opened
            .matches(&format!("data-determined=\"{determined}\""))
            .count()
    };
    assert_eq!((rings(true), rings(false)), (5, 1));
    assert!(opened.contains("data-metric-verdict=\"not-metric\""));
    let found = section(&opened, "part-intrinsics");
    let tables: Vec<&str> = found.split("<tbody>").skip(1).collect();
    assert_eq!(tables.len(), 2);
    for (table, words) in tables.iter().zip(["133", "f"]) {
        let body = text_of(table.split_once("</tbody>").unwrap().0);
        assert!(body.starts_with(words), "{body}");
    }
}

/// A page of cameras and points: its numbers are those of the JSON, and of the graph by hand.
#[test]
#[ignore = "needs chromium"]
fn cameras_and_points_have_a_page() {
    let asked = ["-", "--tracks", "--json", "--components"];
    let page = Page::of(tracks().as_bytes(), &asked);
    let report = page.report();
    assert_eq!(page.run.json(), std::slice::from_ref(&report));
    let browser = Browser::find();
    let opened = page.opened(&browser, "");
    agrees(&opened, &report);
    let facts = facts(&opened);
    for (name, value) in [
        ("cameras", "8"),
        ("/graph/nodes", "16"),
        // Two groups; a camera that sees nothing is in none.
        ("components", "2"),
        ("hinges", "1"),
        ("isolated", "1"),
    ] {
        assert_eq!(facts[name], value, "{name}");
    }
    // Cameras, points and observations of each.
    let shown = rows(&opened, "components");
    let sizes: Vec<&[String]> = shown.iter().map(|row| &row[1..4]).collect();
    assert_eq!(sizes, [["4", "4", "16"], ["4", "4", "16"]]);
    let joints = rows(&opened, "joints");
    assert_eq!(
        (joints.len(), joints[0][1].as_str()),
        (1, "a shared camera")
    );
    assert!(
        !opened.contains("e+") && !opened.contains("single_pairs</"),
        "{opened}"
    );
    // Every camera, with what it sees.
    let cameras = rows(&opened, "cameras");
    let seen: Vec<(&str, &str)> = cameras.iter().map(|row| (&*row[0], &*row[1])).collect();
    assert_eq!(
        (cameras.len(), seen[3], seen[7]),
        (8, ("3", "8"), ("7", "0"))
    );
}

/// A database as it is, with a hinge between its two groups.
#[test]
#[ignore = "needs samples and chromium"]
fn tracks_of_a_database_have_a_page() {
    let folder = samples();
    let browser = Browser::find();
    for (name, parts, hinges) in [
        ("clusters_shared_image", 2, "1"),
        ("real_sceaux_421", 1, "0"),
        ("names", 1, "0"),
    ] {
        let path = folder.join(format!("{name}.db"));
        let page = Page::of(b"", &[path.to_str().unwrap(), "--tracks"]);
        let report = page.report();
        let opened = page.opened(&browser, "");
        agrees(&opened, &report);
        let images = report["database"]["images"].to_string();
        let facts = facts(&opened);
        assert_eq!(
            (&facts["cameras"], &*facts["hinges"]),
            (&images, hinges),
            "{name}"
        );
        let shown = rows(&opened, "components");
        let components = report["components"].as_array().unwrap();
        let sizes: Vec<Vec<String>> = components
            .iter()
            .map(|part| vec![part["cameras"].to_string(), part["points"].to_string()])
            .collect();
        assert_eq!(shown.len(), parts, "{name}");
        for (row, size) in shown.iter().zip(sizes) {
            assert_eq!(row[1..3], size, "{name}");
        }
    }
}

#[test]
fn nothing_is_loaded_from_elsewhere() {
    let page = Page::of(cycle(5).as_bytes(), &["-"]);
    let text = page.text();
    assert!(text.contains("default-src 'none'"));
    for word in ["https:", "src=\"http", "@import", "url("] {
        assert!(!text.contains(word), "{word}");
    }
    // The only address is the name of a language.
    let rest = text.replace("http://www.w3.org/2000/svg", "");
    assert!(!rest.contains("http:"));
}

/// How outputs are written is tested with certificates; here, that pages and pictures go the same
/// way.
#[test]
fn one_graph_a_page_and_no_input_is_lost() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (graph, list) = (at("g.txt"), at("two.g6"));
    fs::write(&graph, cycle(4)).unwrap();
    fs::write(&list, "C~\nBw\n").unwrap();
    for (what, out) in [("page", at("out.html")), ("picture", at("out.svg"))] {
        let run = verify(&["draw", &list, &out]);
        assert_eq!((run.code, run.out.as_str()), (2, ""), "{}", run.err);
        let why = format!("{what} {out}: this is about one graph");
        assert!(run.err.contains(&why), "{}", run.err);
        assert!(!Path::new(&out).exists());
    }
    let run = verify(&["draw", &graph, "-"]);
    assert_eq!(run.code, 1);
    assert!(run.out.starts_with('<') && run.err.contains("verdict"));
    let run = verify(&["draw", &graph, &at("one.svg"), &at("two.svg")]);
    assert!(run.err.contains("are files of one kind"), "{}", run.err);
    assert_eq!(fs::read_to_string(&graph).unwrap(), cycle(4));

    let run = verify(&["draw", &graph, &at("a.html"), &at("a.svg")]);
    assert!(
        run.out
            .contains(&format!("  page        {}\n", at("a.html"))),
        "{}",
        run.out
    );
    assert!(
        run.out
            .contains(&format!("  picture     {}\n", at("a.svg"))),
        "{}",
        run.out
    );
    let again = verify(&["draw", &graph, "-"]);
    assert_eq!(
        fs::read_to_string(at("a.svg")).unwrap(),
        again.out,
        "the same each time"
    );
}
