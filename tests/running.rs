//! Long runs: limits of time and memory, signals, and what a terminal shows.
#![cfg(unix)]

use crate::common::{Run, verify};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use viewcert::decide;
use viewcert::decide::{Arithmetic, Options, Question, VerdictError};
use viewcert::graph::Graph;
use viewcert::watch::{Limits, Observer, Reason, Stage, Step, Watch};
use viewcert_formats::{ReadOptions, read_graphs};

/// Half a second for what does not ask whether it may go on, and patience with busy machines.
const LATE: Duration = Duration::from_secs(4);

/// The union of two Hamiltonian cycles on random orders of the nodes: four pairs a camera, but
/// where the cycles share one. Contraction can do next to nothing with it.
fn two_cycles(folder: &Path, nodes: usize) -> String {
    let mut state = 1u64;
    let mut below = |bound: usize| {
        // Knuth's MMIX generator; its upper bits are good enough to shuffle with.
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % bound
    };
    let mut order: Vec<usize> = (0..nodes).collect();
    let mut list = String::new();
    for _ in 0..2 {
        for k in (1..nodes).rev() {
            order.swap(k, below(k + 1));
        }
        for k in 0..nodes {
            list += &format!("{} {}\n", order[k], order[(k + 1) % nodes]);
        }
    }
    let path = folder.join(format!("two-cycles-{nodes}.txt"));
    fs::write(&path, list).unwrap();
    path.to_str().unwrap().to_owned()
}

fn timed(arguments: &[&str]) -> (Run, Duration) {
    let start = Instant::now();
    let run = verify(arguments);
    (run, start.elapsed())
}

fn house() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/house.txt");
    path.to_str().unwrap().to_owned()
}

#[test]
fn a_time_limit_is_for_each_graph_and_says_where() {
    let folder = tempfile::tempdir().unwrap();
    let graph = two_cycles(folder.path(), 14_000);
    let (run, time) = timed(&[&graph, "--time-limit", "1s"]);
    assert_eq!((run.code, &*run.out), (3, ""), "{}", run.err);
    assert!(time >= Duration::from_secs(1) && time < LATE, "{time:?}");
    // What comes before and behind a graph that takes too long is decided, alone and side by side.
    let house = house();
    let others = [&house, &graph, &house, &house, &graph, &house].map(String::as_str);
    let run = verify(&[&others[..], &["--json", "--time-limit", "1s"]].concat());
    let records: Vec<serde_json::Value> = run
        .out
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    let names: Vec<&str> = records
        .iter()
        .map(|record| record["graph"]["name"].as_str().unwrap())
        .collect();
    assert_eq!((run.code, names), (3, others.to_vec()), "{}", run.err);
    for (record, path) in records.iter().zip(others) {
        let why = record["error"].as_str().unwrap_or_default();
        assert_eq!(
            why.starts_with("the time limit was reached at the core of "),
            *path == graph,
            "{record}"
        );
        assert_eq!(record["verdict"].is_string(), *path != graph, "{record}");
    }
    let run = verify(&[&graph, "--time-limit", "1s"]);
    assert_eq!(run.err.lines().count(), 1, "{}", run.err);
    assert!(run.err.contains(&graph), "{}", run.err);
    assert!(
        run.err
            .contains("the time limit was reached at the core of "),
        "{}",
        run.err
    );
}

#[test]
fn limits_that_are_kept_change_nothing() {
    let free = verify(&[&house(), "--components"]);
    let bound = ["--time-limit", "1h", "--memory-limit", "1G"];
    let kept = verify(&[&[&house(), "--components"][..], &bound].concat());
    let stable = |run: &Run| -> Vec<String> {
        let lines = run.out.lines();
        let lines = lines.filter(|line| !line.starts_with("  time"));
        lines.map(str::to_owned).collect()
    };
    assert_eq!((free.code, stable(&free)), (1, stable(&kept)));
    assert_eq!((kept.code, kept.err.as_str()), (1, ""));
}

#[test]
fn limits_that_mean_nothing_are_refused() {
    for (option, value) in [
        ("--time-limit", "0"),
        ("--time-limit", "soon"),
        ("--memory-limit", "0"),
        ("--memory-limit", "2X"),
    ] {
        let run = verify(&[&house(), option, value]);
        assert_eq!(run.code, 2, "{option} {value}");
        assert!(run.err.contains("whole number"), "{}", run.err);
    }
}

/// What Lambda takes is known before anything is eliminated, and the other graphs are decided.
#[test]
fn a_memory_limit_is_predicted() {
    let folder = tempfile::tempdir().unwrap();
    let graph = two_cycles(folder.path(), 30_000);
    // It has six triangles. Nine more cameras on one of it, each paired with the two before: ten that are one body.
    let mut text = std::fs::read_to_string(&graph).unwrap();
    text.extend((30_000..30_009).map(|v| format!("{} {v}\n", v - 1)));
    text.extend((30_001..30_009).map(|v| format!("{} {v}\n", v - 2)));
    std::fs::write(&graph, text).unwrap();
    let (run, time) = timed(&[&graph, &house(), "--memory-limit", "1G"]);
    assert_eq!(run.code, 3, "{}", run.err);
    assert!(time < LATE, "{time:?}");
    assert!(run.out.contains("5 cameras, 6 pairs"), "{}", run.out);
    assert_eq!(run.err.lines().count(), 1, "{}", run.err);
    let so_far =
        "so far: 7 parts of three cameras and more finite solvable (proved), the largest of 10";
    for part in [&graph, "core of ", "Lambda (", "the limit is 1 GiB", so_far] {
        assert!(run.err.contains(part), "{part}: {}", run.err);
    }
    // 13.4 GiB for Lambda, and 6.7 GiB for its flows.
    let (run, time) = timed(&[&graph, "--memory-limit", "16G"]);
    assert!(run.code == 3 && time < LATE, "{time:?} {}", run.err);
    let flows = "7503 flows beside Lambda would take";
    assert!(run.err.contains(flows), "{}", run.err);
}

/// N of the calibrated model has no size that is known beforehand.
#[test]
#[cfg(target_os = "linux")]
fn memory_is_watched_while_it_grows() {
    let folder = tempfile::tempdir().unwrap();
    let graph = two_cycles(folder.path(), 6000);
    let arguments = [&graph, "--model", "calibrated", "--memory-limit", "60M"];
    let run = verify(&arguments);
    assert_eq!(run.code, 3, "{}", run.err);
    assert!(
        run.err
            .contains("the memory limit of 60 MiB was reached at the core of "),
        "{}",
        run.err
    );
}

/// What the account does not know, the system does.
#[test]
#[cfg(target_os = "linux")]
fn the_memory_of_the_process_counts() {
    let (run, time) = timed(&["catalog", "--nodes", "12", "--memory-limit", "30M"]);
    assert_eq!(run.code, 3, "{}", run.err);
    assert!(time < LATE, "{time:?}");
    assert!(
        run.err.contains("the memory limit of 30 MiB was reached"),
        "{}",
        run.err
    );
}

/// Commands that compute in ways of their own are ended all the same.
#[test]
fn limits_are_for_all_commands() {
    let folder = tempfile::tempdir().unwrap();
    let graph = two_cycles(folder.path(), 3000);
    let limit = ["--time-limit", "700ms"];
    for command in [&["audit", &graph][..], &["catalog", "--nodes", "12"]] {
        let (run, time) = timed(&[command, &limit].concat());
        assert_eq!(run.code, 3, "{command:?}: {}", run.err);
        assert!(time < LATE, "{command:?}: {time:?}");
        assert_eq!(run.out, "", "{command:?}");
        assert!(run.err.contains("the time limit "), "{}", run.err);
    }
}

fn start(arguments: &[&str]) -> Child {
    Command::new(env!("CARGO_BIN_EXE_verify"))
        .args(arguments)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

/// Sends a signal; returns the exit code, standard error, and the time to the end.
fn signalled(child: Child, signal: &str) -> (Option<i32>, String, Duration) {
    let start = Instant::now();
    let sent = Command::new("sh")
        .args(["-c", &format!("kill {signal} {}", child.id())])
        .status();
    assert!(sent.unwrap().success());
    let output = child.wait_with_output().unwrap();
    let errors = String::from_utf8(output.stderr).unwrap();
    (output.status.code(), errors, start.elapsed())
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .unwrap()
        .map(|file| file.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn a_signal_ends_the_run_and_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let graph = two_cycles(folder.path(), 14_000);
    let target = tempfile::tempdir().unwrap();
    let certificate = target.path().join("certificate.json");
    for (signal, code) in [("-INT", 130), ("-TERM", 143)] {
        let child = start(&[&graph, "--certificate", certificate.to_str().unwrap()]);
        std::thread::sleep(Duration::from_millis(700));
        let (found, errors, time) = signalled(child, signal);
        assert_eq!(found, Some(code), "{errors}");
        assert!(time < LATE, "{time:?}");
        assert!(errors.contains("interrupted at the "), "{errors}");
        assert_eq!(errors.lines().count(), 1, "{errors}");
        assert_eq!(names(target.path()), [""; 0]);
    }
}

/// Nothing asks while standard input is waited for.
#[test]
fn a_signal_ends_a_run_that_waits() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_verify"))
        .arg("-")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let kept_open = child.stdin.take();
    std::thread::sleep(Duration::from_millis(300));
    let (code, errors, time) = signalled(child, "-INT");
    drop(kept_open);
    assert_eq!(code, Some(130), "{errors}");
    assert!(time < LATE, "{time:?}");
    assert_eq!(errors, "verify: interrupted while reading standard input\n");
}

#[test]
fn without_a_terminal_nothing_is_shown() {
    let folder = tempfile::tempdir().unwrap();
    let graph = two_cycles(folder.path(), 1500);
    let (run, time) = timed(&[&graph]);
    assert_eq!(run.code, 0, "{}", run.err);
    assert_eq!(run.err, "", "after {time:?}");
}

/// Needs `script` of util-linux, which gives a program a terminal.
#[test]
#[ignore = "needs script"]
fn on_a_terminal_the_stage_is_shown() {
    let folder = tempfile::tempdir().unwrap();
    let graph = two_cycles(folder.path(), 14_000);
    let command = format!(
        "stty cols 100; {} {graph} --time-limit 4s",
        env!("CARGO_BIN_EXE_verify")
    );
    let shown = Command::new("script")
        .args(["-qec", &command, "/dev/null"])
        .stdin(Stdio::null())
        .output();
    let shown = shown.expect("`script` is installed");
    let text = String::from_utf8_lossy(&shown.stdout);
    assert_eq!(shown.status.code(), Some(3), "{text}");
    let bar = |line: &&str| line.contains("core of ") && line.contains(" %");
    let drawn = text.split(['\r', '\n']).filter(bar).count();
    assert!(drawn > 5, "{text}");
    // The bar is off the terminal before the message.
    assert!(
        text.contains("\x1b[2Kverify: ") || text.contains("\nverify: "),
        "{text}"
    );
    assert!(
        text.contains("the time limit was reached at the core of "),
        "{text}"
    );
}

fn graph(path: &str) -> Graph {
    let mut graphs = read_graphs(path, &ReadOptions::default());
    graphs.next().unwrap().unwrap().graph
}

/// Graphs and options that together take every step but an error bound.
fn every_step(folder: &Path) -> Vec<(Graph, Options)> {
    let rational = Question {
        arithmetic: Arithmetic::Rational {
            numerator: 9,
            denominator: 4,
        },
        ..Question::default()
    };
    let cycle: String = crate::common::cycle(12);
    let path = folder.join("cycle.txt");
    fs::write(&path, cycle).unwrap();
    let cycle = graph(path.to_str().unwrap());
    let whole = Options::default().question(rational);
    vec![
        (graph(&two_cycles(folder, 300)), Options::default()),
        (cycle.clone(), Options::default()),
        (cycle, whole),
    ]
}

/// A stage that has begun.
#[derive(Debug)]
struct Begun {
    stage: Stage,
    total: u64,
    done: u64,
    ended: bool,
}

/// Every stage that begins, by its number.
#[derive(Debug, Default)]
struct Record(Mutex<BTreeMap<u64, Begun>>);

impl Observer for Record {
    fn begin(&self, work: u64, stage: Stage, total: u64, _later: Option<u64>) {
        let begun = Begun {
            stage,
            total,
            done: 0,
            ended: false,
        };
        let before = self.0.lock().unwrap().insert(work, begun);
        assert!(before.is_none(), "a number is used twice");
    }

    fn done(&self, work: u64, units: u64) {
        let mut works = self.0.lock().unwrap();
        let found = works.get_mut(&work).unwrap();
        assert!(!found.ended, "done after its end");
        found.done += units;
    }

    fn end(&self, work: u64) {
        let mut works = self.0.lock().unwrap();
        let found = works.get_mut(&work).unwrap();
        assert!(!std::mem::replace(&mut found.ended, true), "ended twice");
    }
}

#[test]
fn an_observer_sees_every_stage_and_changes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let mut seen = Vec::new();
    for (graph, options) in every_step(folder.path()) {
        let record = Arc::new(Record::default());
        let watch = Watch::new(Limits::default()).observed(record.clone());
        let observed = options.clone().watch(watch);
        let verdict = decide::decide(&graph, &observed).unwrap();
        let alone = decide::decide(&graph, &options).unwrap();
        assert_eq!(
            (verdict.value, verdict.rank, verdict.components.len()),
            (alone.value, alone.rank, alone.components.len())
        );
        assert_eq!(verdict.pieces, alone.pieces);
        for begun in record.0.lock().unwrap().values() {
            assert!(begun.ended, "{begun:?}");
            assert!(begun.total == 0 || begun.done <= begun.total, "{begun:?}");
            seen.push(begun.stage.step);
        }
    }
    for step in STEPS {
        assert!(seen.contains(&step), "{step:?}");
    }
}

/// The steps that the cases go through between them.
const STEPS: [Step; 7] = [
    Step::Contraction,
    Step::WholeMatrix,
    Step::Flows,
    Step::Lambda,
    Step::Elimination,
    Step::Components,
    Step::Counting,
];

/// Interrupts as soon as a step begins.
#[derive(Debug)]
struct Interrupter(Watch, Step);

impl Observer for Interrupter {
    fn begin(&self, _: u64, stage: Stage, _: u64, _: Option<u64>) {
        if stage.step == self.1 {
            self.0.interrupt();
        }
    }

    fn done(&self, _: u64, _: u64) {}

    fn end(&self, _: u64) {}
}

/// A run is a value: one is stopped, and another in the same process knows nothing of it.
#[test]
fn stopping_a_run_leaves_others_alone() {
    let folder = tempfile::tempdir().unwrap();
    for (graph, options) in every_step(folder.path()) {
        let [one, other] = [0, 1].map(|_| Watch::new(Limits::default()));
        let decided = |watch| decide::decide(&graph, &options.clone().watch(watch));
        one.interrupt();
        let stopped = decided(one.clone());
        assert!(matches!(stopped, Err(VerdictError::Stopped(_))));
        assert!(decided(other.clone()).is_ok() && other.stopped().is_none());
        assert_eq!(one.stopped(), Some(Reason::Interrupted));
    }
}

#[test]
fn every_step_can_be_stopped() {
    let folder = tempfile::tempdir().unwrap();
    let cases = every_step(folder.path());
    for step in STEPS {
        let mut stopped = 0;
        for (graph, options) in &cases {
            let watch = Watch::new(Limits::default());
            let interrupter = Arc::new(Interrupter(watch.clone(), step));
            let options = options.clone().watch(watch.observed(interrupter));
            match decide::decide(graph, &options) {
                Err(VerdictError::Stopped(found)) => {
                    assert_eq!(found.reason, Reason::Interrupted);
                    stopped += 1;
                }
                // A graph that does not take this step.
                done => assert!(done.is_ok() && watch.stopped().is_none(), "{step:?}"),
            }
        }
        assert!(stopped > 0, "{step:?}");
    }
}
