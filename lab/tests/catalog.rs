//! `viewcert-lab catalog`, through the program.

use crate::common::nauty;
use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::Duration;

fn lab(arguments: &[&str]) -> Output {
    command(arguments).output().unwrap()
}

fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_viewcert-lab"));
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
    // Under the rows stand digests.
    let mut lines = table.lines().filter(|line| !line.contains(": "));
    let header = lines.next().unwrap();
    let columns = ["candidates", "fin_solv", "unproved"].map(|name| column(header, name));
    lines
        .map(|line| [0, 1, 2].map(|k| columns[k](line)))
        .collect()
}

#[test]
#[ignore = "needs data"]
fn table_1_as_published() {
    let data = crate::common::data();
    let published = fs::read_to_string(data.join("table1.csv")).unwrap();
    let expected: Vec<[u64; 3]> = published
        .lines()
        .skip(1)
        .map(|line| {
            let cells: Vec<u64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
            [cells[2], cells[3], 0]
        })
        .collect();
    let all = good(&lab(&["catalog", "--nodes", "3-10"]));
    assert_eq!(counts(&all), expected, "{all}");
    let necessary = good(&lab(&["catalog", "--nodes", "3-10", "--necessary"]));
    for (necessary, all) in counts(&necessary).iter().zip(&expected) {
        assert!(necessary[0] <= all[0]);
        assert_eq!(necessary[1..], all[1..]);
    }
}

/// The same graphs as nauty's geng, which only counts here.
#[test]
#[ignore = "needs geng"]
fn as_many_candidates_as_geng() {
    for nodes in 3..=11usize {
        let edges = (11 * nodes - 15).div_ceil(7);
        let size = format!("{edges}:{edges}");
        let run = nauty("geng", &["-Cu", &nodes.to_string(), &size]);
        let report = text(&run.stderr);
        let line = report.lines().find(|line| line.starts_with(">Z")).unwrap();
        let expected: u64 = line.split(' ').nth(1).unwrap().parse().unwrap();
        let mut found = 0u64;
        viewcert_lab_catalog::Candidates::new(nodes, edges, false)
            .unwrap()
            .for_each(&mut |_| {
                found += 1;
                true
            });
        assert_eq!(found, expected, "{nodes} nodes");
    }
}

#[test]
#[ignore = "needs geng"]
fn candidates_of_geng_have_the_same_verdicts() {
    let run = nauty("geng", &["-Cq", "9", "12:12"]);
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
        (&["--nodes", "2"][..], "3 to 17 nodes"),
        (&["--nodes", "0"], "3 to 17 nodes"),
        (&["--nodes", "18"], "3 to 17 nodes"),
        (&["--nodes", "17", "--edges", "26"], "with up to 25 edges"),
        (&["--nodes", "5", "--edges", "11"], "5 to 10 edges"),
        (&["--nodes", "5", "--edges", "4"], "5 to 10 edges"),
        (&["--nodes", "7-5"], "range is empty"),
        (&["--nodes", "6", "--shard", "3/2"], "I/K"),
        (&["--nodes", "6", "--prime", "15"], "prime"),
        (&[], "--nodes"),
    ] {
        let run = lab(&[&["catalog"], arguments].concat());
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
        let shard = shard.unwrap().path();
        if !shard.is_dir() {
            continue;
        }
        for part in fs::read_dir(shard).unwrap() {
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
    let list = good(&lab(&["catalog", "--nodes", "9", "--list"]));
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
        let table = good(&lab(&["catalog", "merge", folder]));
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
        let run = lab(&["catalog", "merge", folder.to_str().unwrap()]);
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
    // Another seed, another split: refused before any work, and nothing is left of it.
    for (which, option, why) in [
        (
            "2/3",
            &["--seed", "2"][..],
            "--seed is 1 there and 2 here; give",
        ),
        (
            "2/4",
            &[],
            "the number of shards is 3 there and 4 here; give",
        ),
        (
            "2/3",
            &["--solutions"],
            "--solutions is off there and on here; give",
        ),
        (
            "2/3",
            &["--solvable-only"],
            "--solvable-only is off there and on here; give",
        ),
        (
            "2/3",
            &["--certificates"],
            "--certificates is off there and on here; give",
        ),
    ] {
        let other = shard(out, which).args(option).output().unwrap();
        assert_eq!(other.status.code(), Some(2));
        let said = text(&other.stderr);
        assert!(said.contains("the folder of another run"), "{said}");
        assert!(said.contains(why), "{said}");
    }
    assert_eq!(
        fs::read_dir(out).unwrap().count(),
        4,
        "2 shards, run, kernels"
    );
    good(&shard(out, "2/3").output().unwrap());
    let merge = || good(&lab(&["catalog", "merge", out.to_str().unwrap()]));
    let whole = merge();
    let of = out.join("shard-2-of-3");
    let [zero, one] = ["part-000000.tsv", "part-000001.tsv"].map(|name| of.join(name));
    let part = fs::read_to_string(&one).unwrap();
    let other = tempfile::tempdir().unwrap();
    let seeded = shard(other.path(), "2/3").args(["--seed", "2"]).output();
    good(&seeded.unwrap());
    let foreign = fs::read(other.path().join("shard-2-of-3/part-000001.tsv")).unwrap();
    let middle = part.len() / 2;
    let row = part.lines().nth(7).unwrap();
    let first = fs::read_to_string(&zero).unwrap();
    // What was damaged, swapped, cut off, or is of somebody else is named.
    for (damaged, why) in [
        (&part.as_bytes()[..middle], "part-000001.tsv: cut off"),
        (
            part.replacen(row, "", 1).as_bytes(),
            "part-000001.tsv: changed",
        ),
        (
            part.replacen("proof", "2^-99", 1).as_bytes(),
            "part-000001.tsv: changed",
        ),
        (
            part.replace("\"refuted\":", "\"refuted\":1").as_bytes(),
            "changed",
        ),
        (&[part.as_bytes(), b"\n"].concat(), "part-000001.tsv: "),
        (b"", "part-000001.tsv: cut off"),
        (b"\xff\xfe\n", "part-000001.tsv: cut off"),
        (
            first.as_bytes(),
            "part-000001.tsv: it holds part 0 of shard 2/3",
        ),
    ] {
        assert_ne!(damaged, part.as_bytes(), "{why}");
        fs::write(&one, damaged).unwrap();
        refused(out, why);
        refused(out, "run shard 2/3 again, which computes it again");
        // The next run says so, and makes it again.
        let again = shard(out, "2/3").output().unwrap();
        good(&again);
        assert!(text(&again.stderr).contains("computed again"), "{why}");
        assert_eq!(fs::read_to_string(&one).unwrap(), part, "{why}");
        assert_eq!(merge(), whole);
    }
    fs::write(&one, foreign).unwrap();
    refused(
        out,
        "part-000001.tsv: of another run than run.json: --seed is 2 there and 1 here",
    );
    let mixed = shard(out, "2/3").output().unwrap();
    assert_eq!(mixed.status.code(), Some(2));
    assert!(text(&mixed.stderr).contains("--seed is 2 there and 1 here; give"));
    fs::remove_file(&one).unwrap();
    refused(out, "part-000001.tsv: is missing");
    fs::write(&one, &part).unwrap();
    // Doubled parts and shards.
    fs::write(of.join("part-000003.tsv"), &part).unwrap();
    refused(out, "part-000003.tsv: does not belong to the shard");
    fs::remove_file(of.join("part-000003.tsv")).unwrap();
    fs::rename(&of, out.join("shard-4-of-3")).unwrap();
    refused(out, "shard-4-of-3: is no shard of this run");
    refused(out, "shards are missing: 2/3");
    fs::rename(out.join("shard-4-of-3"), &of).unwrap();
    let done = |index: u32| out.join(format!("shard-{index}-of-3/done.json"));
    let [second, third] = [2, 3].map(|index| fs::read(done(index)).unwrap());
    fs::write(done(2), &third).unwrap();
    refused(out, "shard-2-of-3: holds shard 3/3");
    fs::write(done(2), &second[..second.len() - 9]).unwrap();
    refused(out, "done.json: cut off");
    let fewer = text(&second).replace("\"parts\":3", "\"parts\":2");
    fs::write(done(2), fewer).unwrap();
    refused(out, "done.json: changed");
    fs::remove_file(done(2)).unwrap();
    refused(out, "not finished");
    fs::write(done(2), &second).unwrap();
    // What the whole is about.
    let run = fs::read_to_string(out.join("run.json")).unwrap();
    fs::write(
        out.join("run.json"),
        run.replace("\"seed\":1", "\"seed\":3"),
    )
    .unwrap();
    refused(out, "run.json: changed");
    let again = shard(out, "2/3").output().unwrap();
    assert!(text(&again.stderr).contains("run.json: changed"));
    assert_eq!(fs::read_to_string(out.join("run.json")).unwrap(), run);
    fs::remove_file(out.join("run.json")).unwrap();
    refused(out, "shards without run.json");
    assert_eq!(shard(out, "2/3").output().unwrap().status.code(), Some(2));
    fs::write(out.join("run.json"), run).unwrap();
    let kernels = fs::read(out.join("kernels")).unwrap();
    fs::write(out.join("kernels"), &kernels[..kernels.len() - 1]).unwrap();
    refused(out, "kernels: cut off");
    fs::remove_file(out.join("kernels")).unwrap();
    assert_eq!(merge(), whole);
}

/// A part whose own digests are right is found by deciding its graphs again, and by its arithmetic.
#[test]
fn a_recheck_finds_what_digests_do_not() {
    use sha2::{Digest, Sha256};
    let hex = |bytes: &[u8]| -> String { bytes.iter().map(|byte| format!("{byte:02x}")).collect() };
    let seal = |text: &str| format!("{text}{{\"sha256\":\"{}\"}}\n", hex(&Sha256::digest(text)));
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path();
    let run = |which: &str| good(&shard(out, which).arg("--certificates").output().unwrap());
    run("1/2");
    run("2/2");
    let merge = |more: &[&str]| {
        let words = [&["catalog", "merge", out.to_str().unwrap()], more].concat();
        let run = lab(&words);
        (run.status.code(), text(&run.stdout), text(&run.stderr))
    };
    let path = out.join("shard-1-of-2/part-000001.tsv");
    let part = fs::read_to_string(&path).unwrap();
    let lines: Vec<&str> = part.lines().collect();
    let unsealed = lines[..lines.len() - 1].join("\n") + "\n";
    assert_eq!(seal(&unsealed), part);
    for share in ["1%", "50%", "all", "100%"] {
        let (code, said, _) = merge(&["--recheck", share, "--threads", "1"]);
        assert_eq!(code, Some(0), "{said}");
        let last = said.lines().last().unwrap();
        assert!(
            last.contains("decided again ") && last.ends_with(" of 433: all agree"),
            "{last}"
        );
        assert_eq!(
            share.ends_with("l") || share == "100%",
            last.contains("again 433 of"),
            "{last}"
        );
    }
    // A verdict alone: the counts do not agree with it.
    let wrong = unsealed.replacen("not-finite-solvable\tproof", "finite-solvable\tproof", 1);
    fs::write(&path, seal(&wrong)).unwrap();
    let (code, _, said) = merge(&[]);
    assert_eq!(code, Some(2));
    assert!(said.contains("do not add up"), "{said}");
    // A rank, with the digests of the lines made to fit, in the part and in the end of the shard: only
    // deciding again finds that.
    let row = lines[2];
    let rank = row.split('\t').nth(3).unwrap();
    let other = row.replacen(&format!("\t{rank}\t"), "\t60\t", 1);
    assert_ne!((rank, row), ("60", other.as_str()));
    let digest = |rows: &[&str]| {
        let mut digest = viewcert_lab_catalog::set_digest::SetDigest::default();
        rows.iter().for_each(|row| digest.insert(row.as_bytes()));
        digest.to_string()
    };
    let mut rows: Vec<&str> = lines[2..lines.len() - 2].to_vec();
    let right = digest(&rows);
    rows[0] = &other;
    let forged = unsealed
        .replacen(row, &other, 1)
        .replace(&right, &digest(&rows));
    fs::write(&path, seal(&forged)).unwrap();
    let (code, _, said) = merge(&[]);
    assert_eq!(code, Some(2));
    assert!(
        said.contains("the parts do not add up to what done.json says"),
        "{said}"
    );
    let done = out.join("shard-1-of-2/done.json");
    let end = fs::read_to_string(&done).unwrap();
    let all = lines_of(&out.join("shard-1-of-2"));
    let all: Vec<&str> = all.iter().map(String::as_str).collect();
    let before: Vec<&str> = all
        .iter()
        .map(|line| if *line == other { row } else { line })
        .collect();
    fs::write(
        &done,
        resealed(&end.replace(&digest(&before), &digest(&all))),
    )
    .unwrap();
    assert_eq!(merge(&[]).0, Some(0), "what digests cannot find");
    let (code, said, _) = merge(&["--recheck", "all"]);
    assert_eq!(code, Some(1), "{said}");
    let graph = row.split('\t').next().unwrap();
    let contradiction = format!("part-000001.tsv: {graph}: the file says");
    assert!(
        said.starts_with("CONTRADICTED ") && said.contains(&contradiction),
        "{said}"
    );
    assert_eq!(said.lines().count(), 2, "the graph and the counts: {said}");
    // Certificates are bound, too.
    fs::write(&path, &part).unwrap();
    fs::write(&done, &end).unwrap();
    assert_eq!(merge(&["--recheck", "all"]).0, Some(0));
    let certificates = out.join("certificates");
    let check = crate::common::verify(&["check", certificates.to_str().unwrap()]).out;
    assert!(
        check.starts_with("433 certificates verified, 0 rejected\n433 distinct graphs"),
        "{check}"
    );
    let [one, two] =
        [0, 1].map(|part| certificates.join(format!("shard-2-of-2-part-00000{part}.jsonl.gz")));
    let [first, second] = [&one, &two].map(|path| fs::read(path).unwrap());
    fs::write(&one, &second).unwrap();
    let (code, _, said) = merge(&[]);
    assert_eq!(code, Some(2));
    assert!(
        said.contains("part-000000.jsonl.gz was changed or cut off"),
        "{said}"
    );
    fs::remove_file(&two).unwrap();
    assert!(merge(&[]).2.contains("part-000001.jsonl.gz is missing"));
    run("2/2");
    assert_eq!(
        [&one, &two].map(|path| fs::read(path).unwrap()),
        [first, second]
    );
    assert_eq!(merge(&[]).0, Some(0));
    for bad in ["0%", "1", "x", "101%"] {
        assert_eq!(merge(&["--recheck", bad]).0, Some(2));
    }
}

/// All lines of entries of a shard.
fn lines_of(shard: &Path) -> Vec<String> {
    let mut all = Vec::new();
    for part in fs::read_dir(shard).unwrap() {
        let text = fs::read_to_string(part.unwrap().path()).unwrap();
        let inner = text.lines().filter(|line| line.contains("proof\t"));
        all.extend(inner.map(String::from));
    }
    all
}

/// A sealed file with another content, sealed anew.
fn resealed(text: &str) -> String {
    use sha2::{Digest, Sha256};
    let content = text.strip_prefix("{\"content\":").unwrap();
    let content = content.rsplit_once(",\"sha256\":").unwrap().0;
    let digest = Sha256::digest(content);
    let hex: String = digest.iter().map(|byte| format!("{byte:02x}")).collect();
    format!("{{\"content\":{content},\"sha256\":\"{hex}\"}}\n")
}

/// The lines of a run have one digest, however it is cut; a merge after `--solvable-only` rechecks what
/// is not kept, too.
#[test]
fn one_digest_for_all_splits() {
    let mut digests = std::collections::BTreeSet::new();
    for (count, part, more) in [(1, "16384", ""), (2, "50", ""), (3, "7", "--solvable-only")] {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().to_str().unwrap();
        let prepared = ["catalog", "--nodes", "9", "--part", part, "--out", out];
        for index in 1..=count {
            let which = format!("{index}/{count}");
            let mut words = [&prepared[..], &["--shard", &which, "--threads", "1"]].concat();
            words.extend(Some(more).filter(|more| !more.is_empty()));
            if index == 1 {
                assert_eq!(good(&lab(&[&words[..], &["--prepare"]].concat())), "");
            }
            good(&lab(&words));
        }
        let merged = good(&lab(&["catalog", "merge", out, "--recheck", "all"]));
        let [.., digest, last] = merged.lines().collect::<Vec<_>>()[..] else {
            panic!("{merged}");
        };
        assert!(
            last.ends_with("decided again 433 of 433: all agree"),
            "{last}"
        );
        digests.insert(digest.to_owned());
    }
    let list = good(&lab(&["catalog", "--nodes", "9", "--list"]));
    let mut digest = viewcert_lab_catalog::set_digest::SetDigest::default();
    list.lines()
        .skip(1)
        .for_each(|line| digest.insert(line.as_bytes()));
    let expected = format!("9 nodes, 12 edges, biconnected: lines {digest}");
    assert_eq!(digests.into_iter().collect::<Vec<_>>(), [expected]);
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
    let table = good(&lab(&["catalog", "--nodes", "3-7", "--minimal"]));
    let found = counts(&table);
    let least = counts(&good(&lab(&["catalog", "--nodes", "3-7"])));
    for (minimal, least) in found.iter().zip(least) {
        assert!(minimal[1] >= least[1], "{table}");
        assert_eq!(minimal[0], minimal[1], "only minimal graphs are counted");
    }
    assert_eq!(found[..2], [[1, 1, 0]; 2]);
}

/// A shard counts its own candidates only; so does its estimate of the time that is left.
#[test]
fn a_shard_says_how_many_candidates_are_its_own() {
    let mut sum = 0;
    for index in 1..=3 {
        let shard = format!("{index}/3");
        let run = lab(&["catalog", "--nodes", "9", "--shard", &shard]);
        let own = counts(&good(&run))[0][0];
        let said = text(&run.stderr);
        let expected = format!("viewcert-lab: shard {shard}: {own} of 433 candidates\n");
        assert_eq!(said, expected);
        sum += own;
    }
    assert_eq!(sum, 433);
}

/// Kernel by kernel and one by one: the same counts, the same graphs.
#[test]
fn verdicts_are_those_of_the_table() {
    let sizes = ["catalog", "--nodes", "3-10", "--necessary"];
    let table = counts(&good(&lab(&sizes)));
    let verdicts = good(&lab(&[&sizes[..], &["--verdicts"]].concat()));
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
    let listed = good(&lab(&ten));
    let finite_solvable = listed
        .lines()
        .filter(|line| line.contains("\tfinite-solvable\t"));
    let finite_solvable: Vec<&str> = finite_solvable
        .map(|line| line.split('\t').next().unwrap())
        .collect();
    let lines = good(&lab(&[&ten[..], &["--verdicts"]].concat()));
    assert_eq!(lines.lines().collect::<Vec<_>>(), finite_solvable);
    // The digest is of the list, in any order.
    let mut digest = viewcert_lab_catalog::set_digest::SetDigest::default();
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
    let whole = good(&lab(&["catalog", "--nodes", "10", "--verdicts"]));
    let without_time = |table: &str| -> Vec<String> {
        let trimmed = table.lines().map(|line| match line.rsplit_once("  ") {
            Some((row, seconds)) if seconds.trim().parse::<f64>().is_ok() => row.trim_end().into(),
            _ => line.trim_end().into(),
        });
        trimmed.collect()
    };
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path();
    let merge = || lab(&["catalog", "merge", out.to_str().unwrap()]);
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
    refused("block-000000.json: cut off");
    let broken = blocks(out, "1/3").output().unwrap();
    good(&broken);
    let said = text(&broken.stderr);
    assert!(
        said.contains("block-000000.json: cut off") && said.contains("counted again"),
        "{said}"
    );
    assert_eq!(read(0), first);
    // Any number of shards goes on with them.
    good(&blocks(out, "1/1").output().unwrap());
    assert_eq!(read(13), last);
    let second = read(1);
    fs::write(path(1), &first).unwrap();
    refused("block-000001.json: it holds block 0");
    let swapped = blocks(out, "2/2").output().unwrap();
    assert!(text(&swapped.stderr).contains("it holds block 0; counted again"));
    assert_eq!(read(1), second);
    fs::write(
        path(1),
        text(&second).replacen("\"finite\":", "\"finite\":1", 1),
    )
    .unwrap();
    refused("block-000001.json: changed");
    let answers = text(&second).replacen("\"by_blocks\":", "\"by_blocks\":1", 1);
    fs::write(path(1), resealed(&answers)).unwrap();
    refused("its candidates and its answers do not add up");
    let kernels = text(&second).replacen("\"kernels_sha256\":\"", "\"kernels_sha256\":\"0", 1);
    fs::write(path(1), resealed(&kernels)).unwrap();
    refused("its kernels are not those that there are");
    // What adds up and is sealed is found by counting again.
    let digest = text(&second)
        .split("\"finite_solvable\":\"")
        .nth(1)
        .unwrap()[..64]
        .to_owned();
    let digit = if digest.starts_with('0') { "1" } else { "0" };
    let forged = text(&second).replace(&digest, &format!("{digit}{}", &digest[1..]));
    fs::write(path(1), resealed(&forged)).unwrap();
    good(&merge());
    let words = [
        "catalog",
        "merge",
        out.to_str().unwrap(),
        "--recheck",
        "all",
    ];
    let run = lab(&words);
    assert_eq!(run.status.code(), Some(1));
    assert!(text(&run.stdout).starts_with("CONTRADICTED "));
    fs::write(path(1), &second).unwrap();
    let said = good(&lab(&words));
    assert!(
        said.ends_with("decided again 5898 of 5898: all agree\n"),
        "{said}"
    );
    fs::write(out.join("block-000014.json"), &second).unwrap();
    refused("block-000014.json: is no block of this run");
    fs::remove_file(out.join("block-000014.json")).unwrap();
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
    let plain = good(&lab(&["catalog", "--nodes", "8-9"]));
    assert!(!plain.contains("solutions"), "{plain}");
    let counted = good(&lab(&["catalog", "--nodes", "8-9", "--solutions"]));
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
