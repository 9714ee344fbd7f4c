//! What `verify check`, `viewcert-check` and the second checker ask for, refuse and say alike.

use crate::common::{Run, cycle, first_checker, root, second_checker, verify};
use serde_json::{Value, json};
use std::fs;
use std::path::Path;
use std::process::Command;

/// A folder with the files of a test.
struct Folder(tempfile::TempDir);

impl Folder {
    fn new(files: &[(&str, &str)]) -> Self {
        let folder = Self(tempfile::tempdir().unwrap());
        for (name, text) in files {
            folder.write(name, text);
        }
        folder
    }

    fn path(&self, name: &str) -> String {
        self.0.path().join(name).to_str().unwrap().to_owned()
    }

    fn write(&self, name: &str, text: &str) -> String {
        fs::write(self.0.path().join(name), text).unwrap();
        self.path(name)
    }

    /// The certificate that `verify` writes of a graph.
    fn certify(&self, name: &str, graph: &str, options: &[&str]) -> String {
        let certificate = self.path(name);
        let run = verify(&[&[graph, "--certificate", &certificate], options].concat());
        assert!(run.code <= 1, "{graph} {options:?}: {}", run.err);
        certificate
    }
}

type Checker = fn(&[&str]) -> Run;

fn verify_check(arguments: &[&str]) -> Run {
    verify(&[&["check"], arguments].concat())
}

/// All three.
const CHECKERS: [Checker; 3] = [verify_check, first_checker, second_checker];

#[track_caller]
fn all_say(code: i32, arguments: &[&str]) {
    for (k, checker) in CHECKERS.iter().enumerate() {
        let run = checker(arguments);
        let said = format!("checker {k}, {arguments:?}: {}{}", run.out, run.err);
        assert_eq!(run.code, code, "{said}");
        assert_eq!(run.out.contains("VERIFIED"), code == 0, "{said}");
    }
}

const SQUARE: &str = "0 1\n1 2\n2 3\n0 3\n";
const HOUSE: &str = "0 1\n0 2\n1 2\n1 3\n3 4\n2 4\n";
const CAMERAS: &str = "centre 0 0 0 0\ncentre 1 1 0 0\ncentre 2 0 1 0\ncentre 3 1 1 3\n";

/// The member `question` says what a certificate is about, and no name does.
#[test]
#[ignore = "needs python3"]
fn a_name_is_no_question() {
    let folder = Folder::new(&[("square.txt", SQUARE), ("cameras.txt", CAMERAS)]);
    let classes = folder.write("classes.txt", "default focal\n");
    let cameras = folder.path("cameras.txt");
    for (k, name) in [
        "viewcert certificate",
        "at-cameras",
        "\"intrinsics\"",
        "\"question\": \"at-cameras\"",
    ]
    .into_iter()
    .enumerate()
    {
        let graph = folder.write(name, SQUARE);
        for (kind, options) in [
            ("plain", &[][..]),
            ("at", &["--given", &cameras]),
            ("of", &["--intrinsics", &classes]),
        ] {
            all_say(
                0,
                &[&folder.certify(&format!("{kind}{k}.json"), &graph, options)],
            );
        }
    }
    // Another order of the members, and the member somewhere else.
    let text = fs::read_to_string(folder.path("at0.json")).unwrap();
    let mut document: Value = serde_json::from_str(&text).unwrap();
    let object = document.as_object_mut().unwrap();
    let question = object.remove("question").unwrap();
    let without = folder.write("without.json", &json!(object).to_string());
    all_say(1, &[&without]);
    object.insert("zzz".into(), json!({"question": question}));
    all_say(
        1,
        &[&folder.write("inside.json", &json!(object).to_string())],
    );
    object.remove("zzz");
    let text = json!(object).to_string();
    let last = format!("{}, \"question\": {question}}}", &text[..text.len() - 1]);
    all_say(0, &[&folder.write("last.json", &last)]);
    let twice = format!("{{\"question\": \"generic\", {}", &last[1..]);
    all_say(1, &[&folder.write("twice.json", &twice)]);
}

/// With a graph or an expectation nothing is supposed, the model is projective: unless it is named.
#[test]
#[ignore = "needs python3"]
fn hypotheses_are_named() {
    let folder = Folder::new(&[("square.txt", SQUARE), ("cameras.txt", CAMERAS)]);
    let (graph, cameras) = (folder.path("square.txt"), folder.path("cameras.txt"));
    let classes = folder.write("classes.txt", "default focal\n");
    let calibrated = folder.certify("calibrated.json", &graph, &["--model", "calibrated"]);
    all_say(0, &[&calibrated]);
    all_say(1, &[&calibrated, &graph]);
    all_say(1, &[&calibrated, "--model", "projective"]);
    all_say(0, &[&calibrated, &graph, "--model", "calibrated"]);
    let of_two: [Checker; 2] = [verify_check, first_checker];
    for checker in of_two {
        let run = checker(&[&calibrated, "--expect", "solvable"]);
        assert_eq!((run.code, &*run.out), (1, ""));
        assert!(
            run.err
                .contains("the model is calibrated (if that is meant, say --model calibrated)"),
            "{}",
            run.err
        );
        let both = [
            "--expect",
            "solvable",
            "--model",
            "calibrated",
            &*calibrated,
        ];
        assert_eq!(checker(&both).code, 0);
        let other = [
            "--expect",
            "finite-solvable",
            "--model",
            "calibrated",
            &*calibrated,
        ];
        assert_eq!(checker(&other).code, 1);
        assert_eq!(checker(&[&calibrated, "--expect", "metric"]).code, 1);
        assert_eq!(checker(&[&calibrated, "--expect", "maybe"]).code, 2);
    }

    let at = folder.certify("at.json", &graph, &["--given", &cameras]);
    let text = first_checker(&[&at]).out;
    let centres = text
        .split("with centres ")
        .nth(1)
        .unwrap()
        .split('\n')
        .next()
        .unwrap();
    all_say(0, &[&at]);
    all_say(1, &[&at, &graph]);
    all_say(0, &[&at, &graph, "--centres", centres]);
    all_say(1, &[&at, &graph, "--centres", &"0".repeat(64)]);
    all_say(1, &[&at, "--classes", centres]);
    // By their file.
    let moved = folder.write("moved.txt", &CAMERAS.replace("1 1 3", "1 1 4"));
    let parts = folder.write("parts.txt", "part 0 1 2\n");
    let plain = folder.certify("plain.json", &graph, &[]);
    for (certificate, option, file, code) in [
        (&at, "--given", &cameras, 0),
        (&at, "--cameras", &cameras, 0),
        (&at, "--given", &moved, 1),
        (&at, "--given", &parts, 1),
        (&plain, "--given", &cameras, 1),
        (&plain, "--given", &parts, 1),
    ] {
        for arguments in [&[&**certificate, &*graph][..], &[&**certificate]] {
            let run = verify_check(&[arguments, &[option, file]].concat());
            assert_eq!(run.code, code, "{arguments:?} {option} {file}: {}", run.err);
        }
    }

    let of = folder.certify("of.json", &graph, &["--intrinsics", &classes]);
    let text = first_checker(&[&of]).out;
    let hash = text
        .split("with classes ")
        .nth(1)
        .unwrap()
        .split(' ')
        .next()
        .unwrap();
    all_say(0, &[&of]);
    all_say(1, &[&of, &graph]);
    all_say(0, &[&of, &graph, "--classes", hash]);
    all_say(1, &[&of, &graph, "--classes", &"0".repeat(64)]);
    all_say(1, &[&plain, "--classes", hash]);
    assert_eq!(
        verify_check(&[&of, &graph, "--intrinsics", &classes]).code,
        0
    );
    let other = folder.write("other.txt", "default unknown\n");
    assert_eq!(verify_check(&[&of, &graph, "--intrinsics", &other]).code, 1);
    assert_eq!(
        verify_check(&[&plain, &graph, "--intrinsics", &classes]).code,
        1
    );

    // Known parts, with an expectation and no graph.
    let with_parts = folder.certify("parts.json", &graph, &["--given", &parts]);
    all_say(0, &[&with_parts]);
    all_say(1, &[&with_parts, "--model", "projective"]);
    all_say(
        0,
        &[&with_parts, "--model", "projective", "--given", &parts],
    );
}

/// What one program can check has one name in both; what only the other reads, it says how to write for this one.
#[test]
#[ignore = "needs python3"]
fn one_vocabulary() {
    let folder = Folder::new(&[("house.txt", HOUSE)]);
    let graph = folder.path("house.txt");
    let certificate = folder.certify("c.json", &graph, &[]);
    let hash = serde_json::from_str::<Value>(&fs::read_to_string(&certificate).unwrap()).unwrap();
    let hash = hash["graph"]["sha256"].as_str().unwrap().to_owned();
    let other = hash.replace(['0', '1', '2'], "3");
    for (options, code) in [
        (&["--expect", "not-finite-solvable"][..], 0),
        (&["--expect", "solvable"], 1),
        (&["--model", "projective", "--proofs-only"], 0),
        (&["--model", "affine"], 1),
        (&["--model", "conformal"], 2),
        (&["--sha256", &hash], 0),
        (&["--sha256", &hash.to_uppercase()], 0),
        (&["--sha256", &other], 1),
        (&["--sha256", "12"], 2),
        (&["--nodes", "5", "--edges", "6"], 0),
        (&["--nodes", "4"], 1),
        (&["--edges", "7"], 1),
        (&["--max-operations", "3"], 3),
        (&["--max-core", "2"], 3),
        (&["--max-bytes", "10"], 3),
    ] {
        let checkers: [Checker; 2] = [verify_check, first_checker];
        for checker in checkers {
            let run = checker(&[&[&*certificate], options].concat());
            assert_eq!(run.code, code, "{options:?}: {}{}", run.out, run.err);
        }
    }
    for (options, said) in [
        (&["--tracks"][..], "`verify convert GRAPH --tracks -o FILE`"),
        (
            &["--format", "edges"],
            "`verify convert GRAPH --format .. -o FILE`",
        ),
        (
            &["--min-inliers=30"],
            "`verify convert GRAPH --min-inliers .. -o FILE`",
        ),
        (
            &["--cameras", "f"],
            "`verify convert GRAPH --cameras FILE --to given -o GIVEN`",
        ),
        (&["--intrinsics"], "--classes HEX"),
        (&["--sweep"], "there is no option --sweep"),
    ] {
        let run = first_checker(&[&[&*certificate, &*graph], options].concat());
        assert_eq!((run.code, &*run.out), (2, ""), "{options:?}");
        assert!(run.err.contains(said), "{options:?}: {}", run.err);
    }
    // Nodes from 1.
    let shifted = folder.write("shifted.txt", "1 2\n2 3\n3 4\n4 5\n");
    for checker in [first_checker, second_checker] {
        let run = checker(&[&certificate, &shifted]);
        assert_eq!(run.code, 2);
        assert!(run.err.contains("`verify convert"), "{}", run.err);
    }
}

/// What a hostile name prints is none of the program's words: paths, tables, comma-separated values.
#[test]
#[cfg(unix)]
fn names_imitate_nothing() {
    let folder = Folder::new(&[]);
    let names = [
        "a\n  answer  solvable (proved)\nb.txt",
        "x\u{1b}[2K\rVERIFIED.txt",
        "txt.\u{202e}gnp.txt",
    ];
    let graphs: Vec<String> = names
        .iter()
        .map(|name| folder.write(name, SQUARE))
        .collect();
    let hostile = |text: &str| {
        text.contains(['\u{1b}', '\r', '\u{202e}'])
            || text
                .lines()
                .any(|line| line.starts_with("  answer  solvable (proved)"))
            || text.lines().any(|line| line.starts_with("b.txt"))
    };
    for (graph, name) in graphs.iter().zip(names) {
        for arguments in [
            &[&**graph][..],
            &[&**graph, "--table=csv"],
            &[&**graph, "--json"],
            &["models", graph],
            &["label", graph],
            &["overview", graph],
            &["convert", graph, "--to", "given"],
            &["check", graph],
            &["check", graph, graph],
            &["advise", graph, "--suggest"],
            &[&**graph, "--format", "g2o"],
        ] {
            let run = verify(arguments);
            assert!(!hostile(&run.out), "{arguments:?}: {}", run.out);
            assert!(!hostile(&run.err), "{arguments:?}: {}", run.err);
        }
        let run = first_checker(&[graph]);
        assert!(run.code == 2 && !hostile(&run.err), "{}", run.err);
        // JSON has the name itself.
        let record = &verify(&[graph, "--json"]).json()[0];
        assert!(record.to_string().contains(&json!(name).to_string()[1..5]));
        let read = record["graph"]["name"].as_str().or(record["name"].as_str());
        assert!(read.is_some_and(|read| read.ends_with(name)), "{record}");
    }
    // A label that is no file name.
    let list = folder.write("list.txt", "a\u{202e}b c\nc d\nd a\u{202e}b\n");
    let picture = folder.path("list.svg");
    for arguments in [
        &[&*list, "--components"][..],
        &["convert", &list],
        &["draw", &list, &picture],
        &["catalog", &list],
        &[&list, "--prime=\u{202e}"],
    ] {
        let run = verify(arguments);
        let (out, err) = (&run.out, &run.err);
        assert!(!hostile(out) && !hostile(err), "{arguments:?}: {out}{err}");
    }
    assert!(!hostile(&std::fs::read_to_string(picture).unwrap()));
    // No cell is a formula.
    folder.write("=1+1.txt", SQUARE);
    let table = Command::new(crate::common::program("verify"))
        .args(["=1+1.txt", "--table=csv"])
        .current_dir(folder.0.path())
        .output()
        .unwrap();
    let table = String::from_utf8(table.stdout).unwrap();
    let row = table.lines().nth(1).unwrap();
    assert!(row.starts_with("'=1+1"), "{table}");
}

/// Certificates of several kinds in one folder, each with what it supposes; a manifest has to name that.
#[test]
fn a_folder_says_what_is_supposed() {
    let path = "0 1\n1 2\n2 3\n";
    let folder = Folder::new(&[("square.txt", SQUARE), ("path.txt", path)]);
    let sources = Folder::new(&[("cameras.txt", CAMERAS), ("all.txt", "part 0 1 2 3\n")]);
    let (square, line) = (folder.path("square.txt"), folder.path("path.txt"));
    let (cameras, all) = (sources.path("cameras.txt"), sources.path("all.txt"));
    fs::create_dir(folder.0.path().join("c")).unwrap();
    folder.certify("c/square.json", &square, &[]);
    folder.certify("c/calibrated.json", &square, &["--model", "calibrated"]);
    folder.certify("c/known.json", &line, &["--given", &all]);
    folder.certify("c/at.json", &square, &["--given", &cameras]);
    let certificates = folder.path("c");
    let run = verify(&["check", &certificates]);
    assert_eq!(run.code, 0, "{}", run.out);
    for line in [
        "4 certificates verified, 0 rejected",
        "2 distinct graphs",
        "1 projective not-finite-solvable",
        "1 calibrated solvable",
        "1 projective solvable, supposing known parts",
        "1 projective not-determined, supposing given cameras",
    ] {
        assert!(
            run.out.lines().any(|said| said == line),
            "{line}: {}",
            run.out
        );
    }
    // Each has to be what is expected, if anything is.
    let run = verify(&["check", &certificates, "--model", "calibrated"]);
    assert!(
        run.code == 1 && run.out.contains("1 certificate verified, 3 rejected"),
        "{}",
        run.out
    );
    let run = verify(&["check", &certificates, "--expect", "solvable"]);
    assert!(
        run.code == 1 && run.out.contains("0 certificates verified"),
        "{}",
        run.out
    );

    // A catalog: what the manifest does not name is refused.
    let catalog = Folder::new(&[]);
    let known = catalog.certify("known.json", &line, &["--given", &all]);
    let bytes = fs::read(&known).unwrap();
    let manifest = |contents: Value| {
        let hash = sha2_hex(&bytes);
        let entry = json!({"file": "known.json", "sha256": hash, "certificates": contents});
        let text = json!({"format": "viewcert manifest", "version": 1, "files": [entry]});
        catalog.write("manifest.json", &text.to_string());
        verify(&["check", catalog.0.path().to_str().unwrap()])
    };
    let plain = json!({"graphs": 1, "verdicts": {"solvable": 1}, "solutions": {"1": 1}});
    let run = manifest(plain.clone());
    assert!(run.code == 1 && run.out.contains("CHANGED"), "{}", run.out);
    assert!(run.out.contains("supposing known parts"), "{}", run.out);
    let with = |name: &str, value: Value| {
        let mut contents = plain.clone();
        contents["supposed"] = json!({"known parts": 1});
        contents[name] = value;
        contents
    };
    let run = manifest(with("models", json!({"projective": 1})));
    assert_eq!(run.code, 0, "{}", run.out);
    let run = manifest(with("models", json!({"calibrated": 1})));
    assert!(run.code == 1 && run.out.contains("CHANGED"), "{}", run.out);
}

fn sha2_hex(bytes: &[u8]) -> String {
    use sha2::{Digest, Sha256};
    Sha256::digest(bytes)
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect()
}

/// A line of blanks alone holds no certificate, and is counted as a line.
#[test]
#[ignore = "needs python3"]
fn blank_lines_are_skipped() {
    let folder = Folder::new(&[("square.txt", SQUARE)]);
    let certificate = folder.certify("c.json", &folder.path("square.txt"), &[]);
    let text = fs::read_to_string(certificate).unwrap();
    let text = text.replace('\n', " ");
    let list = folder.write(
        "list.jsonl",
        &format!("\n{text}\n \t\r\n\n{{}}\n{text}\n\n"),
    );
    let run = verify(&["check", &list]);
    assert!(
        run.code == 1 && run.out.contains("2 certificates verified, 1 rejected"),
        "{}",
        run.out
    );
    assert!(run.out.contains("list.jsonl:5: "), "{}", run.out);
    let run = second_checker(&["--list", &list]);
    assert!(
        run.code == 1 && run.out.contains("2 verified, 1 rejected"),
        "{}",
        run.out
    );
    assert!(run.out.contains("list.jsonl:5: "), "{}", run.out);
    let only = folder.write("only.jsonl", "\n  \n");
    assert_eq!(verify(&["check", &only]).code, 2);
    let long = verify(&["check", &list, "--max-bytes", "100"]);
    assert!(
        long.code == 3 && long.out.contains("UNDECIDED"),
        "{}{}",
        long.out,
        long.err
    );
}

/// What the prover writes its checkers verify: centres and cameras that primes do not tell apart, ranks without
/// proofs by counting.
#[test]
#[ignore = "needs python3"]
fn what_is_written_is_verified() {
    let (p, q) = ("2305843009213693951", "2147483647");
    let product = "4951760154835678088235319297"; // (2^61 - 1)(2^31 - 1)
    let folder = Folder::new(&[("square.txt", SQUARE), ("pentagon.txt", &cycle(5))]);
    let graph = folder.path("square.txt");
    for (k, given) in [
        format!("centre 0 0 0 0\ncentre 1 {p} 0 0\ncentre 2 0 {q} 0\ncentre 3 1 1 {product}\n"),
        format!("centre 0 {p} {q} {product}\ncentre 1 {p} {q} 0\ncentre 2 {product} 0 {p}\ncentre 3 0 0 {q}\n"),
        format!("centre 0 0 0 0\ncentre 1 {p} {p} {p}\ncentre 2 {p} 0 {p}\ncentre 3 0 {product} 0\n"),
        scaled(p, ["1", "2", "3"]),
        scaled(product, ["1", "2", "3"]),
        scaled(p, [p, "0", product]),
    ]
    .into_iter()
    .enumerate()
    {
        let given = folder.write(&format!("given{k}.txt"), &given);
        for model in ["projective", "calibrated"] {
            let name = format!("c{k}-{model}.json");
            let certificate = folder.certify(&name, &graph, &["--given", &given, "--model", model]);
            all_say(0, &[&certificate]);
            let run = verify(&["check", &certificate, &graph, "--given", &given, "--model", model]);
            assert_eq!(run.code, 0, "{}", run.err);
        }
    }
    let pentagon = folder.path("pentagon.txt");
    for (k, method) in ["ranks", "matrix"].into_iter().enumerate() {
        let name = format!("ranks{k}.json");
        let options = ["--model", "calibrated", "--method", method];
        let certificate = folder.certify(&name, &pentagon, &options);
        all_say(0, &[&certificate]);
        assert_eq!(first_checker(&[&certificate, "--proofs-only"]).code, 0);
    }
}

/// A camera c [I | t] at three other places.
fn scaled(c: &str, t: [&str; 3]) -> String {
    let camera = |name: &str, [x, y, z]: [&str; 3]| {
        format!("camera {name} {c} 0 0 {x} 0 {c} 0 {y} 0 0 {c} {z}\n")
    };
    camera("0", t)
        + &camera("1", ["0", "1", "7"])
        + &camera("2", ["5", "0", "1"])
        + &camera("3", ["1", "1", "4"])
}

/// A certificate of some kilobytes takes no years: what it asks for is refused, or counted.
#[test]
#[ignore = "needs python3"]
fn small_files_cost_little() {
    let tests = root().join("crates/check/tests");
    let read = |path: &str| -> Value {
        serde_json::from_str(&fs::read_to_string(Path::new(&tests).join(path)).unwrap()).unwrap()
    };
    let folder = Folder::new(&[]);
    let mut many = read("at_cameras/line.json");
    many["pieces"][0]["primes"] = json!(1_000_000_000_000_000_u64);
    let many = folder.write("primes.json", &many.to_string());
    all_say(1, &[&many]);
    assert!(first_checker(&[&many]).err.contains("are a proof"));
    // Reading a number takes the square of its length, and is counted.
    let mut long = read("at_cameras/matrices.json");
    long["cameras"][0][0] = json!(format!("1{}", "0".repeat(90_000)));
    let long = folder.write("long.json", &long.to_string());
    let run = first_checker(&[&long, "--max-operations", "1000000"]);
    assert!(
        run.code == 3 && run.err.contains("--max-operations"),
        "{}",
        run.err
    );
    // The centre is the same, however the matrix is scaled along an axis.
    let short = tests.join("at_cameras/matrices.json");
    let short = first_checker(&[short.to_str().unwrap()]);
    for checker in [verify_check, first_checker] {
        let run = checker(&[&long]);
        assert_eq!((run.code, &run.out), (0, &short.out), "{}", run.err);
    }
}

/// The database whose rows the checker's own tests have, and its certificate.
fn database_of_motions(folder: &Folder) -> [String; 2] {
    let kept = |name: &str| {
        let path = root().join("crates/check/tests/contradictions").join(name);
        fs::read_to_string(path).unwrap()
    };
    let certificate = folder.write("motions.json", &kept("certificate.json"));
    let path = folder.path("motions.db");
    let database = rusqlite::Connection::open(&path).unwrap();
    let tables: Value = serde_json::from_str(&kept("rows.json")).unwrap();
    for (table, columns) in [
        ("cameras", "camera_id, model, prior_focal_length, params"),
        ("images", "image_id, camera_id, name"),
        ("keypoints", "image_id, rows, cols, data"),
        (
            "two_view_geometries",
            "pair_id, rows, config, data, E, qvec, tvec",
        ),
    ] {
        let mut statements = format!("create table {table} ({columns});");
        for row in tables[table].as_array().unwrap() {
            let value = |value: &Value| match (value.as_str(), table) {
                (Some(name), "images") => format!("'{name}'"),
                (Some(blob), _) => format!("x'{blob}'"),
                _ => value.to_string(),
            };
            let values: Vec<String> = row.as_array().unwrap().iter().map(value).collect();
            statements += &format!("insert into {table} values ({});", values.join(", "));
        }
        database.execute_batch(&statements).unwrap();
    }
    [certificate, path]
}

/// What is written is one thing, and that a database has these numbers another.
#[test]
#[ignore = "needs python3"]
fn contradictions_are_bound_to_a_database() {
    let folder = Folder::new(&[("square.txt", SQUARE)]);
    let [certificate, database] = database_of_motions(&folder);
    all_say(0, &[&certificate]);
    for checker in CHECKERS {
        let run = checker(&[&certificate]);
        let claim =
            "contradictions: at least 1 of 10 pairs are off by more than 10 degrees (proof), ";
        assert!(
            run.out
                .contains(&format!("{claim}about the numbers written here\n"))
        );
        assert!(!run.out.contains("of this database"), "{}", run.out);
    }
    for checker in [verify_check, second_checker] {
        let run = checker(&[&certificate, &database]);
        assert_eq!(run.code, 0, "{}", run.err);
        assert!(!run.out.contains("written here"), "{}", run.out);
        assert_eq!(
            run.out.matches("of this database").count(),
            6,
            "{}",
            run.out
        );
        assert_eq!(checker(&[&certificate, &folder.path("square.txt")]).code, 2);
        assert_eq!(checker(&[&certificate, &folder.path("absent.db")]).code, 2);
    }
    let run = first_checker(&[&certificate, &database]);
    assert_eq!(run.code, 2);
    assert!(
        run.err.contains("this program reads no database"),
        "{}",
        run.err
    );
    // Another number of one pair, and nothing that a graph would show.
    let opened = rusqlite::Connection::open(&database).unwrap();
    let change = "update two_view_geometries set tvec = zeroblob(24) where pair_id = 2147483649";
    opened.execute_batch(change).unwrap();
    drop(opened);
    for checker in [verify_check, second_checker] {
        assert_eq!(checker(&[&certificate, &database]).code, 1);
    }
    let expected = verify_check(&[&certificate, "--expect", "solvable"]);
    assert!(
        expected.code == 1 && expected.err.contains("the verdict is contradictions"),
        "{}",
        expected.err
    );
}
