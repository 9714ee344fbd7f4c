//! The program: what it prints where, its options, and its exit codes.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

struct Run {
    code: i32,
    out: String,
    err: String,
}

fn run_with(input: &str, arguments: &[&str]) -> Run {
    let mut child = Command::new(env!("CARGO_BIN_EXE_viewcert-check"))
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // The program may end before it reads everything.
    let _ = child.stdin.take().unwrap().write_all(input.as_bytes());
    let output = child.wait_with_output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    Run {
        code: output.status.code().unwrap(),
        out: text(output.stdout),
        err: text(output.stderr),
    }
}

fn run(arguments: &[&str]) -> Run {
    run_with("", arguments)
}

fn path(name: &str) -> String {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    // The workspace runs this file for the program beside `verify`.
    let check = own.join("crates/check");
    let own = if check.is_dir() { &check } else { own };
    let folder = own.join("tests/certificates");
    folder.join(format!("{name}.json")).display().to_string()
}

fn text(name: &str) -> String {
    std::fs::read_to_string(path(name)).unwrap()
}

/// A file of the test's own.
fn file(name: &str, bytes: &[u8]) -> String {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::write(&path, bytes).unwrap();
    path.display().to_string()
}

#[test]
fn verified_lines() {
    let run = run(&[&path("square")]);
    assert_eq!((run.code, run.err.as_str()), (0, ""));
    let lines: Vec<&str> = run.out.lines().collect();
    assert_eq!(lines.len(), 4);
    assert!(lines.iter().all(|line| line.starts_with("VERIFIED ")));
    assert!(lines[0].starts_with("VERIFIED graph: 4 nodes, 4 edges, SHA-256 9ac8d97b"));
    assert!(lines[1].starts_with("VERIFIED not-finite-solvable: "));
    assert_eq!(lines[2], "VERIFIED rank: 28 of 29 required (proof)");
    assert_eq!(lines[3], "VERIFIED components: 4 maximal (proof)");
    let read = run_with(&text("square"), &["-"]);
    assert_eq!((read.code, read.out), (0, run.out));
}

/// Nothing that a certificate holds can pass for an answer.
#[test]
fn a_rejected_file_says_nothing() {
    let hostile = text("square").replace("\"plane-flow\"", "\"x\\nVERIFIED y\\u001b[2K\"");
    let run = run_with(&hostile, &["-"]);
    assert_eq!((run.code, run.out.as_str()), (1, "REJECTED\n"));
    assert_eq!(run.err.lines().count(), 1);
    assert!(run.err.starts_with("viewcert-check: "), "{}", run.err);
    assert!(
        run.err.contains("`x\\nVERIFIED y\\u{1b}[2K`"),
        "{}",
        run.err
    );
    let long = text("square").replace("\"plane-flow\"", &format!("\"{}\"", "x".repeat(100_000)));
    assert!(run_with(&long, &["-"]).err.len() < 300);
    // Names that are verified are not printed either.
    let name = text("square").replace("\"example\"", "\"\\nVERIFIED everything\"");
    let run = run_with(&name, &["-"]);
    assert_eq!(run.code, 0);
    assert!(!run.out.contains("everything"), "{}", run.out);
}

#[test]
fn help_and_version() {
    for option in ["--help", "-h", "--version", "-V"] {
        let run = run(&[option]);
        assert_eq!((run.code, run.err.as_str()), (0, ""), "{option}");
        assert!(!run.out.contains("VERIFIED ") && !run.out.is_empty());
    }
    let help = run(&["--help"]).out;
    for option in [
        "--expect",
        "--proofs-only",
        "--max-operations",
        "[20000]",
        "[2000000000000]",
        "verify convert",
    ] {
        assert!(help.contains(option), "{option}");
    }
}

#[test]
fn bad_usage() {
    let square = path("square");
    for arguments in [
        &[][..],
        &["--what"],
        &[&square, &square, &square],
        &[&square, "--expect", "maybe"],
        &[&square, "--expect"],
        &[&square, "--model", "plane"],
        &[&square, "--nodes", "four"],
        &[&square, "--nodes", "-4"],
        &[&square, "--sha256", "9ac8"],
        &[&square, "--format", "edges"],
        &[&square, "--max-core", "1e3"],
        &["-", "-"],
        &["no-such-file.json"],
        &[&square, "no-such-file.txt"],
    ] {
        let run = run(arguments);
        assert_eq!((run.code, run.out.as_str()), (2, ""), "{arguments:?}");
        assert!(run.err.starts_with("viewcert-check: "), "{}", run.err);
    }
}

#[test]
fn what_is_expected() {
    const HASH: &str = "9ac8d97b8710d2c0fe901270dcfd1aa77fc5e73a9d406ddf480210a460626727";
    let square = path("square");
    let fine = [
        &["--expect", "not-finite-solvable"][..],
        &["--model=projective", "--nodes=4", "--edges", "4"],
        &["--sha256", HASH],
        &["--sha256", &HASH.to_uppercase()],
        &["--proofs-only"],
    ];
    for options in fine {
        let run = run(&[options, &[&square]].concat());
        assert_eq!((run.code, run.err.as_str()), (0, ""), "{options:?}");
        assert!(run.out.starts_with("VERIFIED "));
    }
    let other = HASH.replace('9', "8");
    for (name, options, wanted) in [
        (
            "square",
            &["--expect", "solvable"][..],
            "the verdict is not-finite-solvable",
        ),
        (
            "square",
            &["--expect=finite-solvable"],
            "the verdict is not-finite-solvable",
        ),
        (
            "square",
            &["--model", "calibrated"],
            "the model is projective",
        ),
        (
            "square-calibrated",
            &["--model", "projective"],
            "the model is calibrated",
        ),
        ("square", &["--nodes", "5"], "the graph has 4 nodes"),
        ("square", &["--edges", "5"], "the graph has 4 edges"),
        (
            "square",
            &["--sha256", &other],
            "the graph has the SHA-256 9ac8",
        ),
        (
            "draws",
            &["--proofs-only"],
            "the verdict is not proved: error at most 2^-153",
        ),
        (
            "draws",
            &["--proofs-only"],
            "the rank is not proved: error at most 2^-153",
        ),
        (
            "draws",
            &["--proofs-only"],
            "the number of components is not proved",
        ),
    ] {
        let run = run(&[options, &[&path(name)]].concat());
        assert_eq!((run.code, run.out.as_str()), (1, ""), "{options:?}");
        assert!(run.err.contains(wanted), "{}", run.err);
    }
    // What is expected does not turn a rejection into anything else.
    let wrong = text("square").replace("\"bound\":28", "\"bound\":27");
    let run = run_with(&wrong, &["-", "--expect=solvable"]);
    assert_eq!((run.code, run.out.as_str()), (1, "REJECTED\n"));
}

#[test]
fn limits_have_an_answer_of_their_own() {
    for (name, option) in [
        ("square", "--max-bytes"),
        ("square", "--max-core"),
        ("bipartite", "--max-flows"),
        ("integer", "--max-bits"),
        ("integer", "--max-operations"),
    ] {
        let stopped = run(&[&path(name), option, "3"]);
        assert_eq!((stopped.code, stopped.out.as_str()), (3, ""), "{option}");
        assert!(
            stopped.err.contains("too large for the limits: "),
            "{}",
            stopped.err
        );
        assert!(
            stopped.err.contains(&format!("raise it with {option}")),
            "{}",
            stopped.err
        );
        assert_eq!(run(&[&path(name), option, "9000000000000"]).code, 0);
    }
    let size = text("square").len().to_string();
    assert_eq!(run(&[&path("square"), "--max-bytes", &size]).code, 0);
    let one_less = (text("square").len() - 1).to_string();
    assert_eq!(run(&[&path("square"), "--max-bytes", &one_less]).code, 3);
    assert_eq!(
        run_with(&text("square"), &["-", "--max-bytes", &one_less]).code,
        3
    );
}

#[test]
fn graphs_in_files() {
    let square = path("square");
    let list = file("square.txt", b"# 0 left\n0 1\n1 2\n2 3\n3 0\n");
    assert_eq!(run(&[&square, &list]).code, 0);
    let other = file("path.txt", b"0 1\n1 2\n2 3\n");
    let run_other = run(&[&square, &other]);
    assert_eq!((run_other.code, run_other.out.as_str()), (1, "REJECTED\n"));
    // The right one of several, as the certificate says.
    let several = file("several.g6", b"Bw\nC~\nCl\n");
    assert_eq!(run(&[&square, &several]).code, 0);
    // A line that is a graph6 graph makes no graph6 file.
    let mixed = file("mixed.txt", b"Cl\n0 1\n");
    let unreadable = run(&[&square, &mixed]);
    assert_eq!((unreadable.code, unreadable.out.as_str()), (2, ""));
    assert!(
        unreadable.err.contains("mixed.txt: line 2: graph6: "),
        "{}",
        unreadable.err
    );
    for (name, bytes) in [
        ("square.mat", &b"MATLAB 5.0 MAT-file\0"[..]),
        ("square.gz", b"\x1f\x8b\x08"),
        ("square.json", b"{\"edges\": []}"),
        ("square.xml", b"<graphml>"),
        ("square.bin", b"0 1\0"),
        ("names.txt", b"a b\nb c\nc d\nd a\n"),
    ] {
        let unreadable = run(&[&square, &file(name, bytes)]);
        assert_eq!(
            (unreadable.code, unreadable.out.as_str()),
            (2, ""),
            "{name}"
        );
        // What to do about it.
        assert!(unreadable.err.contains("`verify convert`"), "{name}");
    }
    // An unreadable graph is no answer about a certificate that is wrong.
    let wrong = file(
        "wrong.json",
        text("square")
            .replace("\"bound\":28", "\"bound\":27")
            .as_bytes(),
    );
    assert_eq!(run(&[&wrong, &mixed]).code, 2);
    assert_eq!(run(&[&wrong, &list]).code, 1);
}

/// Whoever expects something of the pairs alone gets no answer that supposes more.
#[test]
fn hypotheses_are_none_unless_they_are_named() {
    let (rigs, rig) = (path("displaced-rigs"), path("parts-rig"));
    let hash = "2eaec72a74890accb2edf31caf4b2e9e8351715092f824e37a10c1317e13c424";
    let supposed =
        format!("displacements are supposed to be known: 4 nodes in 2 groups, SHA-256 {hash}");
    let graph_of = |certificate: &str| {
        let text = std::fs::read_to_string(certificate).unwrap();
        let field = |name: &str| {
            let rest = text
                .split(&format!("\"{name}\":"))
                .nth(1)
                .unwrap()
                .trim_start();
            let end = rest.find([',', '}']).unwrap();
            rest[..end].trim().trim_matches('"').to_owned()
        };
        ["graph6", "sha256", "nodes", "edges"].map(field)
    };
    for (certificate, own, reason) in [
        (
            &rigs,
            file("rigs.txt", format!("displacements {hash}\n").as_bytes()),
            &*supposed,
        ),
        (
            &rig,
            file("rig.txt", b"part 0 1 2\npart 2 4\npart 2 4 5\npart 3 5\n"),
            "4 known parts are taken for given",
        ),
    ] {
        let [line, sha256, nodes, edges] = graph_of(certificate);
        let model = ["calibrated", "projective"][usize::from(certificate == &rig)];
        let graph = file("hypotheses.g6", line.as_bytes());
        assert_eq!(run(&[certificate]).code, 0);
        let of_model = ["--model", model];
        for arguments in [
            ["--expect", "solvable"],
            ["--model", model],
            ["--nodes", &nodes],
            ["--edges", &edges],
            ["--sha256", &sha256],
        ] {
            let alone = run(&[&arguments[..], &[certificate]].concat());
            assert_eq!((alone.code, alone.out.as_str()), (1, ""), "{arguments:?}");
            assert!(alone.err.contains(reason), "{}", alone.err);
            let also = if arguments[0] == "--model" {
                &[][..]
            } else {
                &of_model
            };
            let named = [&arguments[..], &[certificate, "--given", &own], also].concat();
            assert_eq!(run(&named).code, 0, "{named:?}");
        }
        let given = run(&[certificate, &graph]);
        assert_eq!((given.code, given.out.as_str()), (1, "REJECTED\n"));
        let named = [
            &[certificate.as_str(), &graph, "--given", &own][..],
            &of_model,
        ]
        .concat();
        assert_eq!(run(&named).code, 0);
        let unnamed = run(&[certificate, &graph, "--given", &own]);
        assert_eq!(unnamed.code, i32::from(model != "projective"));
    }
    let turning = path("../base_lines/turning");
    let hash = "efb3ef2096bfb158e2fc3d336efe10983dede9f44f455c0cc9156256e99d4d39";
    let frames = file("frames.txt", format!("frames {hash}\n").as_bytes());
    let asked = ["--model", "calibrated", &*turning];
    assert_eq!(run(&[&*turning]).code, 0);
    let alone = run(&asked);
    let reason = format!("frames are supposed to be known: SHA-256 {hash}");
    assert!(
        alone.code == 1 && alone.err.contains(&reason),
        "{}",
        alone.err
    );
    assert_eq!(run(&[&asked[..], &["--given", &frames]].concat()).code, 0);
    let zeros = file(
        "zeros.txt",
        format!("displacements {}\n", "0".repeat(64)).as_bytes(),
    );
    for certificate in [&rigs, &path("square-calibrated")] {
        let other = run(&["--given", &zeros, certificate]);
        assert_eq!((other.code, other.out.as_str()), (1, "REJECTED\n"));
    }
    let wrong = run(&["--given", &file("some.txt", b"displacements some\n"), &rigs]);
    assert_eq!(wrong.code, 2);
    assert!(
        wrong.err.contains("stands a hash, 64 hexadecimal digits"),
        "{}",
        wrong.err
    );
}

/// What is no certificate is neither verified nor rejected.
#[test]
fn files_that_are_no_certificates() {
    let square = path("square");
    let graph = file("graph.txt", b"a b\nb c\nc d\nd a\n");
    let swapped = run(&[&graph, &square]);
    assert_eq!((swapped.code, swapped.out.as_str()), (2, ""));
    assert!(
        swapped.err.contains("did you swap them?"),
        "{}",
        swapped.err
    );
    let empty = file("empty.json", b"");
    let report = file("report.json", b"{\"graph\":{\"name\":\"a\"},\"notes\":[]}");
    for other in [&graph, &empty, &report] {
        let none = run(&[other]);
        assert_eq!((none.code, none.out.as_str()), (2, ""));
        assert!(none.err.contains("this is no certificate"), "{}", none.err);
    }
    // What says that it is one is judged.
    let hollow = file("hollow.json", b"{\"format\":\"viewcert certificate\"}");
    assert_eq!(run(&[&hollow]).code, 1);
}

/// Every certificate that is not about pairs alone has to be named with what it supposes.
#[test]
fn cameras_and_classes_are_named() {
    for (name, option, between) in [
        ("../at_cameras/square", "--centres", ("with centres ", "\n")),
        ("../intrinsics/pair", "--classes", ("with classes ", " ")),
    ] {
        let certificate = path(name);
        let alone = run(&[&certificate]);
        assert_eq!(alone.code, 0, "{}", alone.err);
        let hash = alone.out.split(between.0).nth(1).unwrap();
        let hash = hash.split(between.1).next().unwrap();
        let model = alone.out.split("model ").nth(1).unwrap_or("projective");
        let model = model.split('\n').next().unwrap();
        assert_eq!(run(&[&certificate, "--model", model]).code, 1, "{name}");
        let named = [&*certificate, "--model", model, option, hash];
        assert_eq!(run(&named).code, 0, "{name}");
        let zeros = "0".repeat(64);
        let other = run(&[&*certificate, "--model", model, option, &zeros]);
        assert_eq!((other.code, other.out.as_str()), (1, ""));
        let square = run(&[&*path("square"), option, hash]);
        assert_eq!((square.code, square.out.as_str()), (1, ""));
        let parts = file("some-parts.txt", b"part 0 1\n");
        let given = run(&[&[&*certificate, "--given", &parts][..], &named[1..]].concat());
        assert_eq!((given.code, given.out.as_str()), (1, "REJECTED\n"));
    }
}
