//! Golden files: what the programs print and write today, word for word.
//!
//! A transcript in `tests/golden/` is a list of commands, each with the exit code (if it is not 0),
//! standard output (`|`) and standard error (`!`) that it had; `+` goes on with an object of JSON, a
//! line for each member. Words like `cat` and `hash` show files that were written. The commands of one
//! transcript run one after another in one folder of their own, which holds the examples, the files of
//! `tests/golden/input/`, some of `tests/foreign/` and a database that is made here.
//!
//! These are pins of behaviour, not proofs that it is right: what a verdict, a number or a message has
//! to be, other tests hold against the paper, independent computation or a calculation by hand. A
//! golden file says that a change elsewhere changed nothing here.
//!
//! To change one on purpose: change the code, run `VIEWCERT_GOLDEN=write cargo test --test all golden::`, and
//! read `git diff tests/golden` as you would read code. A new case is a new line `$ command` in a
//! transcript; the same run fills in the rest. Lines that begin with `#` are kept.

use crate::common::samples;
use flate2::read::MultiGzDecoder;
use regex::Regex;
use rusqlite::{Connection, params};
use sha2::{Digest, Sha256};
use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::LazyLock;

/// Files of other programs that transcripts read.
const FOREIGN: [&str; 7] = [
    "bundle.out",
    "graph.graphml",
    "head.csv",
    "mat-plain.mat",
    "model.nvm",
    "point-line.txt",
    "problem.bal",
];

/// All that is not compared: what differs between two runs, or two releases, of one program.
static UNSTABLE: LazyLock<[(Regex, &str); 8]> = LazyLock::new(|| {
    let rules = [
        // Times in JSON.
        (r#""((?:[a-z]+_)?seconds)":[0-9.e+-]+"#, r#""$1":<time>"#),
        // Times in reports, with what aligns them.
        (r" +[0-9.]+ (?:µs|ms|s|min|h)\b", " <time>"),
        // Seconds in tables, which alone have four decimals.
        (r"([ ,]) *[0-9]+\.[0-9]{4}\b", "$1<time>"),
        // Seconds in tables, behind a count, at the end of a row or before a number and a name.
        (
            r"(?m)([0-9]) +[0-9]+\.[0-9]{1,2}( +[0-9]+ +\S+)?$",
            "$1 <time>$2",
        ),
        // Noise of floating point about zero.
        (r"-?[0-9.]+e-[0-9]{2,}|-?[0-9.]+ decades", "<noise>"),
        // The version.
        (
            r#"("program":\{"name":"verify","version":")[0-9.]+"#,
            "$1<version>",
        ),
        (
            r"\b(verify|viewcert|viewcert-check) [0-9]+\.[0-9]+\.[0-9]+",
            "$1 <version>",
        ),
        // Files that are only half written.
        (r#""[^"]*/\.viewcert-[A-Za-z0-9]+""#, "<temporary>"),
    ];
    rules.map(|(pattern, stands_for)| (Regex::new(pattern).unwrap(), stands_for))
});

fn stable(text: &str) -> String {
    let rules = UNSTABLE.iter();
    rules.fold(text.to_owned(), |text, (pattern, stands_for)| {
        pattern.replace_all(&text, *stands_for).into_owned()
    })
}

/// A command and what came of it.
struct Case {
    /// Comments and blank lines before it.
    head: Vec<String>,
    command: String,
    outcome: Vec<String>,
}

/// The cases of a transcript.
fn parse(text: &str) -> Vec<Case> {
    let (mut cases, mut head) = (Vec::<Case>::new(), Vec::new());
    for line in text.lines() {
        match line.strip_prefix("$ ") {
            Some(command) => cases.push(Case {
                head: std::mem::take(&mut head),
                command: command.to_owned(),
                outcome: Vec::new(),
            }),
            None if line.is_empty() || line.starts_with('#') => head.push(line.to_owned()),
            None => cases
                .last_mut()
                .expect("a command first")
                .outcome
                .push(line.to_owned()),
        }
    }
    assert!(
        head.iter().all(String::is_empty),
        "comments stand before commands"
    );
    cases
}

/// The words of a command; `'` quotes.
fn words(command: &str) -> Vec<String> {
    let (mut words, mut quoted) = (vec![String::new()], false);
    for c in command.chars() {
        match c {
            '\'' => quoted = !quoted,
            ' ' if !quoted => words.push(String::new()),
            c => words.last_mut().unwrap().push(c),
        }
    }
    assert!(!quoted, "{command}");
    words
}

/// Runs one command in a folder: a program (`< FILE` is standard input), or one of the words that
/// show what was written.
fn outcome(folder: &Path, command: &str) -> Vec<String> {
    let words = words(command);
    let path = |k: usize| folder.join(&words[k]);
    match &*words[0] {
        "verify" => program(env!("CARGO_BIN_EXE_verify"), folder, &words[1..]),
        "viewcert-check" => program(env!("CARGO_BIN_EXE_viewcert-check"), folder, &words[1..]),
        "digest" => digest(&outcome(folder, &command["digest ".len()..])),
        "cat" => prefixed("|", &fs::read(path(1)).unwrap()),
        "hash" => files(&path(1))
            .iter()
            .map(|file| hash(folder, file))
            .collect(),
        "mkdir" => fs::create_dir(path(1)).map(|()| Vec::new()).unwrap(),
        "cp" => fs::copy(path(1), path(2)).map(|_| Vec::new()).unwrap(),
        "rm" => fs::remove_file(path(1)).map(|()| Vec::new()).unwrap(),
        other => panic!("{other}: no such word"),
    }
}

fn program(program: &str, folder: &Path, arguments: &[String]) -> Vec<String> {
    let (arguments, input) = match arguments {
        [arguments @ .., sign, file] if sign == "<" => (arguments, Some(folder.join(file))),
        _ => (arguments, None),
    };
    let input = input.map_or(Stdio::null(), |file| fs::File::open(file).unwrap().into());
    let mut run = Command::new(program);
    let run = run
        .args(arguments)
        .current_dir(folder)
        .stdin(input)
        .output();
    let run = run.unwrap();
    let code = run.status.code().expect("not killed");
    let mut lines = match code {
        0 => Vec::new(),
        _ => vec![format!("exit {code}")],
    };
    lines.extend(prefixed("|", &run.stdout));
    lines.extend(prefixed("!", &run.stderr));
    lines
}

/// The lines of a text; objects of JSON folded, so that differences can be read.
fn prefixed(prefix: &str, text: &[u8]) -> Vec<String> {
    let text = stable(&String::from_utf8_lossy(text));
    let mut lines = Vec::new();
    for line in text.lines() {
        for (k, part) in folded(line).into_iter().enumerate() {
            let prefix = if k == 0 { prefix } else { "+" };
            lines.push(format!("{prefix} {part}").trim_end().to_owned());
        }
    }
    if !text.is_empty() && !text.ends_with('\n') {
        lines.push("(no end of line)".to_owned());
    }
    lines
}

/// An object of JSON with a line for each member; any other line as it is.
fn folded(line: &str) -> Vec<&str> {
    if !(line.starts_with('{') && line.ends_with('}')) {
        return vec![line];
    }
    let (mut parts, mut start) = (Vec::new(), 0);
    let (mut depth, mut quoted, mut escaped) = (0, false, false);
    for (at, c) in line.char_indices() {
        match c {
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            '"' => quoted = !quoted,
            _ if quoted => (),
            '{' | '[' => depth += 1,
            '}' | ']' => depth -= 1,
            ',' if depth == 1 => {
                parts.push(&line[start..=at]);
                start = at + 1;
            }
            _ => (),
        }
    }
    parts.push(&line[start..]);
    parts
}

/// A file, or all below a folder, in order.
fn files(path: &Path) -> Vec<PathBuf> {
    if !path.is_dir() {
        return vec![path.to_owned()];
    }
    let entries = fs::read_dir(path).unwrap();
    let mut entries: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    entries.sort();
    entries.iter().flat_map(|entry| files(entry)).collect()
}

/// What came of a command that says much, shortly.
fn digest(outcome: &[String]) -> Vec<String> {
    let lines = outcome.len();
    vec![format!(
        "| {} of {lines} lines",
        sha256(outcome.join("\n").as_bytes())
    )]
}

fn sha256(bytes: &[u8]) -> String {
    let digest = Sha256::digest(bytes);
    digest.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// SHA-256 and name of a file, without what differs between two runs.
fn hash(folder: &Path, file: &Path) -> String {
    let bytes = fs::read(file).unwrap();
    let bytes = if file.extension().is_some_and(|is| is == "gz") {
        let mut text = Vec::new();
        let mut unpacked = MultiGzDecoder::new(&*bytes);
        unpacked.read_to_end(&mut text).unwrap();
        text
    } else {
        bytes
    };
    let bytes = String::from_utf8(bytes).map_or_else(|e| e.into_bytes(), |t| stable(&t).into());
    let name = file.strip_prefix(folder).unwrap().display();
    format!("| {} {name}", sha256(&bytes))
}

/// A folder with all that transcripts read.
fn stage() -> tempfile::TempDir {
    let staged = tempfile::tempdir().unwrap();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let copy = |file: &Path| {
        let name = file.file_name().unwrap();
        fs::copy(file, staged.path().join(name)).unwrap();
    };
    for folder in ["examples", "tests/golden/input"] {
        let mut all = files(&root.join(folder));
        all.retain(|file| file.extension().is_none_or(|is| is != "rs"));
        all.iter().for_each(|file| copy(file));
    }
    for name in FOREIGN {
        copy(&root.join("tests/foreign").join(name));
    }
    walk(&staged.path().join("walk.db"));
    staged
}

/// A database of two clusters of four images each, all of whose pairs match, with tracks through
/// all four images; the clusters share one pair that is used, one with too few inliers, and one that
/// is not verified.
fn walk(path: &Path) {
    const TABLES: &str = "
        create table images (image_id integer primary key, name text not null unique);
        create table matches (pair_id integer primary key, rows integer, cols integer, data blob);
        create table two_view_geometries (pair_id integer primary key, rows integer, cols integer,
            data blob, config integer, F blob, E blob, H blob, qvec blob, tvec blob);";
    const CALIBRATED: i64 = 2;
    const DEGENERATE: i64 = 1;
    let database = Connection::open(path).unwrap();
    database.execute_batch(TABLES).unwrap();
    for (id, name) in (1..).zip(["a1", "a2", "a3", "a4", "b1", "b2", "b3", "b4"]) {
        let insert = "insert into images values (?, ? || '.jpg')";
        database.execute(insert, params![id, name]).unwrap();
    }
    let pair = |a: i64, b: i64, features: std::ops::Range<u32>, config: i64| {
        let of_both = features.clone().flat_map(|feature| [feature, feature]);
        let bytes: Vec<u8> = of_both.flat_map(u32::to_le_bytes).collect();
        let (pair, rows) = (2_147_483_647 * a + b, features.len() as i64);
        let insert = "insert into two_view_geometries (pair_id, rows, cols, data, config)
                      values (?, ?, 2, ?, ?)";
        let values = params![pair, rows, bytes, config];
        database.execute(insert, values).unwrap();
        let insert = "insert into matches values (?, ?, 2, ?)";
        database
            .execute(insert, params![pair, rows, bytes])
            .unwrap();
    };
    for first in [1, 5] {
        for (a, b) in [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)] {
            pair(
                first + a,
                first + b,
                0..20 + a as u32 + b as u32,
                CALIBRATED,
            );
        }
    }
    pair(4, 5, 100..116, CALIBRATED);
    pair(3, 6, 200..209, CALIBRATED);
    pair(2, 7, 300..330, DEGENERATE);
}

/// Runs a transcript in a folder, and compares; or writes it anew.
fn hold(name: &str, folder: &Path) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden");
    let path = root.join(format!("{name}.txt"));
    let cases = parse(&fs::read_to_string(&path).unwrap());
    assert!(!cases.is_empty(), "{name}");
    let write = std::env::var_os("VIEWCERT_GOLDEN").is_some_and(|how| how == "write");
    let (mut text, mut differences) = (String::new(), String::new());
    for case in &cases {
        let found = outcome(folder, &case.command);
        let lines = case.head.iter().map(|line| line.clone() + "\n");
        text.extend(lines);
        text += &format!("$ {}\n", case.command);
        text.extend(found.iter().map(|line| line.clone() + "\n"));
        if found != case.outcome {
            differences += &difference(case, &found);
        }
    }
    if write {
        fs::write(path, text).unwrap();
    } else {
        assert!(
            differences.is_empty(),
            "tests/golden/{name}.txt, where - is what it says:\n{differences}\nIf this is on purpose: \
             VIEWCERT_GOLDEN=write cargo test --test all golden::, and read the diff"
        );
    }
}

/// Where an outcome differs from what is written.
fn difference(case: &Case, found: &[String]) -> String {
    let expected = &case.outcome;
    let same = |(a, b): &(&String, &String)| a == b;
    let start = expected.iter().zip(found).take_while(same).count();
    let (rest, found) = (&expected[start..], &found[start..]);
    let end = rest
        .iter()
        .rev()
        .zip(found.iter().rev())
        .take_while(same)
        .count();
    let gone = rest[..rest.len() - end]
        .iter()
        .map(|line| format!("- {line}\n"));
    let come = found[..found.len() - end]
        .iter()
        .map(|line| format!("+ {line}\n"));
    format!(
        "$ {}\n{}",
        case.command,
        gone.chain(come).collect::<String>()
    )
}

macro_rules! transcripts {
    ($($name:ident)*) => {$(
        #[test]
        fn $name() {
            hold(stringify!($name), stage().path());
        }
    )*};
}

transcripts! { help verdicts advice given database certificates commands catalog refusals reading checker colmap_models }

/// How nodes are placed is floating point, and differs between platforms in the last digit.
#[test]
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
fn drawings() {
    hold("drawings", stage().path());
}

/// Databases of others, where they are; nothing is written there.
#[test]
#[ignore = "needs samples"]
fn databases_of_others() {
    let colmap = samples();
    hold("databases_of_others", &colmap);
}
