//! `verify catalog`, through the program.

mod common;

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::Duration;

fn verify(arguments: &[&str]) -> Output {
    command(arguments).output().unwrap()
}

fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_verify"));
    command.args(arguments);
    command
}

fn with_input(arguments: &[&str], input: &[u8]) -> Output {
    let mut child = command(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(input).unwrap();
    child.wait_with_output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

fn good(output: &Output) -> String {
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    text(&output.stdout)
}

/// Candidates, finite-solvable ones and unproved verdicts of each line of a table.
fn counts(table: &str) -> Vec<[u64; 3]> {
    let column = |header: &str, name: &str| {
        let at = header.find(name).unwrap() + name.len();
        move |line: &str| -> u64 {
            let cell = line[..at].rsplit(' ').next().unwrap();
            cell.parse().unwrap()
        }
    };
    let mut lines = table.lines();
    let header = lines.next().unwrap();
    let columns = ["candidates", "fin_solv", "unproved"].map(|name| column(header, name));
    lines
        .map(|line| [0, 1, 2].map(|k| columns[k](line)))
        .collect()
}

/// geng of nauty with these arguments; `None` if it is not installed.
fn geng(arguments: &[&str]) -> Option<Output> {
    let run = |program| Command::new(program).args(arguments).output().ok();
    let found = ["nauty-geng", "geng"].into_iter().find_map(run);
    if found.is_none() {
        common::absent("neither geng nor nauty-geng is installed");
    }
    found
}

#[test]
fn table_1_as_published() {
    let Some(data) = common::data() else { return };
    let published = fs::read_to_string(data.join("table1.csv")).unwrap();
    let expected: Vec<[u64; 3]> = published
        .lines()
        .skip(1)
        .map(|line| {
            let cells: Vec<u64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
            [cells[2], cells[3], 0]
        })
        .collect();
    let all = good(&verify(&["catalog", "--nodes", "3-10"]));
    assert_eq!(counts(&all), expected, "{all}");
    let necessary = good(&verify(&["catalog", "--nodes", "3-10", "--necessary"]));
    for (necessary, all) in counts(&necessary).iter().zip(&expected) {
        assert!(necessary[0] <= all[0]);
        assert_eq!(necessary[1..], all[1..]);
    }
}

/// The same graphs as nauty's geng, which only counts here.
#[test]
fn as_many_candidates_as_geng() {
    for nodes in 3..=11usize {
        let edges = (11 * nodes - 15).div_ceil(7);
        let size = format!("{edges}:{edges}");
        let Some(run) = geng(&["-Cu", &nodes.to_string(), &size]) else {
            return;
        };
        let report = text(&run.stderr);
        let line = report.lines().find(|line| line.starts_with(">Z")).unwrap();
        let expected: u64 = line.split(' ').nth(1).unwrap().parse().unwrap();
        let mut found = 0u64;
        viewcert_catalog::Candidates::new(nodes, edges, false)
            .unwrap()
            .for_each(&mut |_| {
                found += 1;
                true
            });
        assert_eq!(found, expected, "{nodes} nodes");
    }
}

#[test]
fn candidates_of_geng_have_the_same_verdicts() {
    let Some(run) = geng(&["-Cq", "9", "12:12"]) else {
        return;
    };
    let table = good(&with_input(&["catalog", "--from", "-"], &run.stdout));
    assert_eq!(counts(&table), [[433, 27, 0]]);
}

/// Bw is the triangle, C^ two triangles with a common edge.
#[test]
fn a_malformed_line_is_named_and_the_rest_goes_on() {
    let run = with_input(&["catalog", "--from", "-"], b"Bw\nB w\nC^\n");
    assert_eq!(run.status.code(), Some(2));
    assert_eq!(counts(&text(&run.stdout)), [[2, 2, 0]]);
    let errors = text(&run.stderr);
    assert!(errors.contains("-:2: graph6"), "{errors}");
}

/// A stream of 100,003 lines, in which three are malformed: across batches, beyond
/// 2^16, and the last one, which has no end of line.
#[test]
fn malformed_lines_of_a_long_stream_are_named() {
    let bad = [4097, 70_001, 100_003];
    let mut stream = Vec::new();
    for line in 1..=100_003 {
        if bad.contains(&line) {
            stream.extend(b"C^^");
        } else {
            stream.extend(if line % 2 == 0 { b"Bw" } else { b"C^" });
        }
        stream.extend(if line < 100_003 { &b"\n"[..] } else { b"" });
    }
    let run = with_input(&["catalog", "--from", "-"], &stream);
    assert_eq!(run.status.code(), Some(2));
    assert_eq!(counts(&text(&run.stdout)), [[100_000, 100_000, 0]]);
    let errors = text(&run.stderr);
    let named: Vec<&str> = errors
        .lines()
        .filter(|line| line.contains("graph6"))
        .collect();
    assert_eq!(named.len(), 3, "{errors}");
    for (line, number) in named.iter().zip(bad) {
        assert!(line.contains(&format!("-:{number}: graph6")), "{line}");
    }
}

#[test]
fn impossible_sizes_are_bad_usage() {
    for (arguments, message) in [
        (&["--nodes", "2"][..], "3 to 16 nodes"),
        (&["--nodes", "0"], "3 to 16 nodes"),
        (&["--nodes", "17"], "3 to 16 nodes"),
        (&["--nodes", "5", "--edges", "11"], "5 to 10 edges"),
        (&["--nodes", "5", "--edges", "4"], "5 to 10 edges"),
        (&["--nodes", "7-5"], "range is empty"),
        (&["--nodes", "6", "--shard", "3/2"], "I/K"),
        (&["--nodes", "6", "--prime", "15"], "prime"),
        (&[], "--nodes"),
    ] {
        let run = verify(&[&["catalog"], arguments].concat());
        assert_eq!(run.status.code(), Some(2), "{arguments:?}");
        let errors = text(&run.stderr);
        assert!(errors.contains(message), "{arguments:?}: {errors}");
    }
}

fn shard(out: &Path, shard: &str) -> Command {
    command(&[
        "catalog",
        "--nodes",
        "9",
        "--part",
        "50",
        "--shard",
        shard,
        "--out",
        out.to_str().unwrap(),
    ])
}

/// All lines of entries in a folder of shards, sorted.
fn lines(out: &Path) -> Vec<String> {
    let mut lines = Vec::new();
    for shard in fs::read_dir(out).unwrap() {
        for part in fs::read_dir(shard.unwrap().path()).unwrap() {
            let path = part.unwrap().path();
            if path.extension().is_some_and(|ending| ending == "tsv") {
                let text = fs::read_to_string(path).unwrap();
                let inner = text.lines().filter(|line| line.contains('\t'));
                lines.extend(
                    inner
                        .filter(|line| !line.starts_with("graph6"))
                        .map(String::from),
                );
            }
        }
    }
    lines.sort();
    lines
}

#[test]
fn the_union_of_the_shards_is_the_whole() {
    let list = good(&verify(&["catalog", "--nodes", "9", "--list"]));
    let mut whole: Vec<String> = list.lines().skip(1).map(String::from).collect();
    whole.sort();
    assert_eq!(whole.len(), 433);
    for count in [1, 2, 5] {
        let folder = tempfile::tempdir().unwrap();
        for index in 1..=count {
            good(
                &shard(folder.path(), &format!("{index}/{count}"))
                    .output()
                    .unwrap(),
            );
        }
        assert_eq!(lines(folder.path()), whole, "{count} shards");
        let folder = folder.path().to_str().unwrap();
        let table = good(&verify(&["catalog", "merge", folder]));
        assert_eq!(counts(&table), [[433, 27, 0]]);
    }
}

/// Killed again and again at different times, and finished at last: as if it had not
/// been.
#[test]
#[cfg(unix)]
fn a_killed_run_goes_on() {
    let quiet = tempfile::tempdir().unwrap();
    good(&shard(quiet.path(), "1/1").output().unwrap());
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path();
    let mut killed = 0;
    for wait in 0..40 {
        let mut child = shard(out, "1/1")
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        std::thread::sleep(Duration::from_millis(wait * 7 % 60));
        // On Unix this is the signal that cannot be caught, kill -9.
        child.kill().unwrap();
        killed += u32::from(!child.wait().unwrap().success());
        let complete = lines(quiet.path());
        let found = lines_if_any(out);
        assert!(found.windows(2).all(|pair| pair[0] != pair[1]), "twice");
        assert!(
            found
                .iter()
                .all(|line| complete.binary_search(line).is_ok())
        );
    }
    assert!(killed > 0, "no run was killed in time");
    good(&shard(out, "1/1").output().unwrap());
    for name in ["part-000000.tsv", "part-000008.tsv", "done.json"] {
        let path = Path::new("shard-1-of-1").join(name);
        let read = |folder: &Path| fs::read(folder.join(&path)).unwrap();
        assert_eq!(read(out), read(quiet.path()), "{name}");
    }
    assert_eq!(lines(out), lines(quiet.path()));
}

fn lines_if_any(out: &Path) -> Vec<String> {
    if out.join("shard-1-of-1").is_dir() {
        lines(out)
    } else {
        Vec::new()
    }
}

#[test]
fn a_merge_names_what_is_wrong() {
    let refused = |folder: &Path, message: &str| {
        let run = verify(&["catalog", "merge", folder.to_str().unwrap()]);
        assert_eq!(run.status.code(), Some(2));
        let errors = text(&run.stderr);
        assert!(errors.contains(message), "{errors}");
    };
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path();
    refused(out, "no shards here");
    refused(&out.join("nothing"), "nothing");
    good(&shard(out, "1/3").output().unwrap());
    good(&shard(out, "3/3").output().unwrap());
    refused(out, "shards are missing: 2/3");
    // A shard of another run: another seed.
    let foreign = shard(out, "2/3").args(["--seed", "2"]).output().unwrap();
    good(&foreign);
    refused(out, "different runs");
    // The right one does not continue the foreign one.
    let mixed = shard(out, "2/3").output().unwrap();
    assert_eq!(mixed.status.code(), Some(2));
    let said = text(&mixed.stderr);
    assert!(
        said.contains("another run: --seed is 2 there and 1 here; give"),
        "{said}"
    );
    fs::remove_dir_all(out.join("shard-2-of-3")).unwrap();
    good(&shard(out, "2/3").output().unwrap());
    good(&verify(&["catalog", "merge", out.to_str().unwrap()]));
    // A copy under another name, a missing part, an unfinished shard.
    let of = out.join("shard-2-of-3");
    fs::rename(&of, out.join("shard-4-of-3")).unwrap();
    refused(out, "holds shard 2/3");
    fs::rename(out.join("shard-4-of-3"), &of).unwrap();
    let part = fs::read(of.join("part-000001.tsv")).unwrap();
    fs::remove_file(of.join("part-000001.tsv")).unwrap();
    refused(out, "part-000001.tsv");
    fs::write(of.join("part-000001.tsv"), &part[..part.len() / 2]).unwrap();
    refused(out, "not a part of a catalog");
    fs::write(of.join("part-000001.tsv"), part).unwrap();
    fs::remove_file(of.join("done.json")).unwrap();
    refused(out, "not finished");
}

/// Parts of other candidates are not taken for one's own.
#[test]
fn a_run_on_other_candidates_does_not_continue() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().to_str().unwrap();
    let arguments = ["catalog", "--from", "-", "--out", out];
    good(&with_input(&arguments, b"Bw\n"));
    good(&with_input(&arguments, b"Bw\n"));
    let other = with_input(&arguments, b"C^\n");
    assert_eq!(other.status.code(), Some(2));
    assert!(text(&other.stderr).contains("other candidates"));
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_is_an_error() {
    let full = fs::OpenOptions::new()
        .write(true)
        .open("/dev/full")
        .unwrap();
    let run = command(&["catalog", "--nodes", "5"])
        .stdout(full)
        .output()
        .unwrap();
    assert_eq!(run.status.code(), Some(2));
    let errors = text(&run.stderr);
    assert!(errors.contains("No space left"), "{errors}");
}

/// Minimal graphs with 5 nodes; both ways of looking agree on those with the least number
/// of edges.
#[test]
fn minimal_graphs() {
    let table = good(&verify(&["catalog", "--nodes", "3-7", "--minimal"]));
    let found = counts(&table);
    let least = counts(&good(&verify(&["catalog", "--nodes", "3-7"])));
    for (minimal, least) in found.iter().zip(least) {
        assert!(minimal[1] >= least[1], "{table}");
        assert_eq!(minimal[0], minimal[1], "only minimal graphs are counted");
    }
    assert_eq!(found[..2], [[1, 1, 0]; 2]);
}

/// Links that lead around are followed once, and what is no file is not waited for.
#[test]
#[cfg(unix)]
fn a_folder_of_links_ends() {
    use std::os::unix::fs::symlink;
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    fs::create_dir_all(at("sub/deeper")).unwrap();
    let one = at("one.json");
    good(&with_input(
        &["-", "--certificate", one.to_str().unwrap()],
        b"1 2\n",
    ));
    symlink("..", at("sub/up")).unwrap();
    symlink("../..", at("sub/deeper/top")).unwrap();
    symlink("nowhere", at("gone.json")).unwrap();
    symlink("one.json", at("same.json")).unwrap();
    let pipe = at("pipe.json");
    assert!(
        Command::new("mkfifo")
            .arg(&pipe)
            .status()
            .unwrap()
            .success()
    );
    let run = verify(&["check", folder.path().to_str().unwrap()]);
    let said = text(&run.stdout);
    assert_eq!(run.status.code(), Some(0), "{said}");
    assert!(
        said.starts_with("2 certificates verified, 0 rejected\n1 distinct graph\n"),
        "{said}"
    );
    let skipped = text(&run.stderr);
    for (name, why) in [
        ("sub/up", "checked already"),
        ("sub/deeper/top", "checked already"),
        ("gone.json", "a link to nothing"),
        ("pipe.json", "not a file"),
    ] {
        let line = skipped.lines().find(|line| line.contains(name));
        assert!(line.is_some_and(|line| line.contains(why)), "{skipped}");
    }
}

/// A certificate can hold what a terminal would obey.
#[test]
fn the_reason_of_a_rejection_is_escaped() {
    let folder = tempfile::tempdir().unwrap();
    let bad = folder.path().join("bad.json");
    fs::write(
        &bad,
        "{\"\\u001b[2J\\nVERIFIED solvable\\u202e\": 1, \"claim\": 1}",
    )
    .unwrap();
    for path in [bad.as_path(), folder.path()] {
        let run = verify(&["check", path.to_str().unwrap()]);
        assert_eq!(run.status.code(), Some(1));
        let said = text(&run.stdout);
        assert!(said.starts_with("REJECTED"), "{said}");
        assert!(said.contains("\\u{1b}[2J"), "{said}");
        assert!(!said.contains(['\u{1b}', '\u{202e}']), "{said:?}");
        assert!(
            !said.lines().any(|line| line.starts_with("VERIFIED")),
            "{said}"
        );
    }
}

/// A shard counts its own candidates only; so does its estimate of the time that is left.
#[test]
fn a_shard_says_how_many_candidates_are_its_own() {
    let mut sum = 0;
    for index in 1..=3 {
        let shard = format!("{index}/3");
        let run = verify(&["catalog", "--nodes", "9", "--shard", &shard]);
        let own = counts(&good(&run))[0][0];
        let said = text(&run.stderr);
        let expected = format!("verify: shard {shard}: {own} of 433 candidates\n");
        assert_eq!(said, expected);
        sum += own;
    }
    assert_eq!(sum, 433);
}

/// Kernel by kernel and one by one: the same counts, the same graphs.
#[test]
fn verdicts_are_those_of_the_table() {
    let sizes = ["catalog", "--nodes", "3-10", "--necessary"];
    let table = counts(&good(&verify(&sizes)));
    let verdicts = good(&verify(&[&sizes[..], &["--verdicts"]].concat()));
    let rows = verdicts.lines().take(9).collect::<Vec<_>>().join("\n");
    assert_eq!(counts(&rows), table);
    for row in rows.lines().skip(1) {
        let cells = row.rsplit_once("necessary").unwrap().1.split_whitespace();
        let cells: Vec<u64> = cells.flat_map(str::parse).collect();
        let [
            candidates,
            finite_solvable,
            unique,
            refuted,
            one,
            several,
            otherwise,
            0,
        ] = cells[..]
        else {
            panic!("{row}");
        };
        assert_eq!(candidates, finite_solvable + refuted, "{row}");
        assert_eq!(refuted, one + several + otherwise, "{row}");
        assert!(unique <= finite_solvable, "{row}");
    }
    let ten = ["catalog", "--nodes", "10", "--list"];
    let listed = good(&verify(&ten));
    let finite_solvable = listed
        .lines()
        .filter(|line| line.contains("\tfinite-solvable\t"));
    let finite_solvable: Vec<&str> = finite_solvable
        .map(|line| line.split('\t').next().unwrap())
        .collect();
    let lines = good(&verify(&[&ten[..], &["--verdicts"]].concat()));
    assert_eq!(lines.lines().collect::<Vec<_>>(), finite_solvable);
    // The digest is of the list, in any order.
    let mut digest = viewcert_catalog::set_digest::SetDigest::default();
    for line in finite_solvable.iter().rev() {
        digest.insert(line.as_bytes());
    }
    let last = verdicts.lines().last().unwrap();
    assert_eq!(
        last,
        format!("10 nodes, 14 edges, necessary: finite solvable {digest}")
    );
}

fn blocks(out: &Path, shard: &str) -> Command {
    command(&[
        "catalog",
        "--nodes",
        "10",
        "--verdicts",
        "--part",
        "9",
        "--shard",
        shard,
        "--out",
        out.to_str().unwrap(),
    ])
}

/// Shards of verdicts in one folder, stopped and completed, are the whole; and a merge names what is
/// wrong with them.
#[test]
fn blocks_of_verdicts() {
    let whole = good(&verify(&["catalog", "--nodes", "10", "--verdicts"]));
    let without_time = |table: &str| -> Vec<String> {
        let trimmed = table.lines().map(|line| match line.rsplit_once("  ") {
            Some((row, seconds)) if seconds.trim().parse::<f64>().is_ok() => row.trim_end().into(),
            _ => line.trim_end().into(),
        });
        trimmed.collect()
    };
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path();
    let merge = || verify(&["catalog", "merge", out.to_str().unwrap()]);
    let refused = |message: &str| {
        let run = merge();
        assert_eq!(run.status.code(), Some(2));
        let errors = text(&run.stderr);
        assert!(errors.contains(message), "{errors}");
    };
    refused("no shards here");
    good(&blocks(out, "2/3").output().unwrap());
    refused("of 14 blocks are missing: 0, 2, 3");
    good(&blocks(out, "1/3").output().unwrap());
    good(&blocks(out, "3/3").output().unwrap());
    assert_eq!(without_time(&good(&merge())), without_time(&whole));
    let path = |block: usize| out.join(format!("block-{block:06}.json"));
    let read = |block| fs::read(path(block)).unwrap();
    let (first, last) = (read(0), read(13));
    // What is there is not computed again; what is missing is.
    fs::remove_file(path(13)).unwrap();
    refused("1 of 14 blocks are missing: 13");
    fs::write(path(0), &first[..first.len() / 2]).unwrap();
    refused("not a block of verdicts");
    let broken = blocks(out, "1/3").output().unwrap();
    assert_eq!(broken.status.code(), Some(2));
    fs::write(path(0), &first).unwrap();
    good(&blocks(out, "1/1").output().unwrap());
    assert_eq!(read(13), last);
    fs::write(path(1), &first).unwrap();
    refused("holds block 0");
    let other = blocks(out, "1/1").args(["--seed", "2"]).output().unwrap();
    assert_eq!(other.status.code(), Some(2));
    let said = text(&other.stderr);
    assert!(
        said.contains("another run: --seed is 1 there and 2 here; give"),
        "{said}"
    );
    fs::remove_file(path(1)).unwrap();
    let other = tempfile::tempdir().unwrap();
    let run = blocks(other.path(), "2/14").args(["--seed", "2"]).output();
    good(&run.unwrap());
    fs::copy(other.path().join("block-000001.json"), path(1)).unwrap();
    refused("another run");
}

/// As many as Groebner bases find (docs/catalog.md), under the table, and only if they are asked for.
#[test]
fn numbers_of_solutions_under_the_table() {
    let plain = good(&verify(&["catalog", "--nodes", "8-9"]));
    assert!(!plain.contains("solutions"), "{plain}");
    let counted = good(&verify(&["catalog", "--nodes", "8-9", "--solutions"]));
    let last = counted.lines().skip(3).collect::<Vec<_>>();
    assert_eq!(
        last,
        [
            "8 nodes, 11 edges, biconnected: solutions: graphs  1: 36",
            "9 nodes, 12 edges, biconnected: solutions: graphs  1: 17, 2: 10",
        ]
    );
    let header = counted.lines().next().unwrap();
    assert!(
        header.contains("contract") && !header.contains("unique"),
        "{header}"
    );
}
