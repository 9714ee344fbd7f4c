//! Command lines with a word in the wrong place are answered by the line to type.

use crate::common::{data, verify, verify_with};
use clap::Command;
use std::fs;

const HOUSE: &str = "examples/house.txt";

/// The line to type in an answer, if one is enough.
fn line(said: &str) -> Option<Vec<String>> {
    let line = said
        .lines()
        .find_map(|line| line.strip_prefix("  verify"))?;
    Some(line.split_whitespace().map(str::to_owned).collect())
}

fn has(command: &Command, long: &str) -> bool {
    command.get_arguments().any(|arg| {
        arg.get_long() == Some(long) || arg.get_all_aliases().is_some_and(|all| all.contains(&long))
    })
}

/// Every option of every command, given to others.
#[test]
fn an_option_of_another_command_is_answered_by_its_line() {
    let tree = viewcert_cli::command();
    let commands: Vec<&Command> = std::iter::once(&tree)
        .chain(tree.get_subcommands())
        .collect();
    let (mut tried, mut lines) = (0, 0);
    for command in &commands {
        for arg in command
            .get_arguments()
            .filter(|arg| arg.get_long().is_some() && !arg.is_global_set())
        {
            let long = arg.get_long().unwrap();
            for (to, words) in [
                (0, &[HOUSE][..]),
                (2, &["advise", HOUSE]),
                (9, &["check", HOUSE]),
            ] {
                let name = words
                    .first()
                    .filter(|_| to > 0)
                    .copied()
                    .unwrap_or("verify");
                let other = commands.iter().find(|one| one.get_name() == name).unwrap();
                if has(other, long) {
                    continue;
                }
                let takes = arg.get_action().takes_values() && !arg.is_require_equals_set();
                let values = arg.get_possible_values();
                let value = values.first().map_or("1", |value| value.get_name());
                let option = format!("--{long}");
                let words = [words, &[&option], &[value][..usize::from(takes)]].concat();
                let run = verify(&words);
                assert_eq!(run.code, 2, "{words:?}: {}", run.err);
                assert!(
                    run.err
                        .contains(&format!("{option} is an option of `verify")),
                    "{words:?}: {}",
                    run.err
                );
                assert!(!run.err.contains("use '--"), "{}", run.err);
                tried += 1;
                let Some(typed) = line(&run.err) else {
                    continue;
                };
                lines += 1;
                assert!(
                    typed.iter().any(|word| word.starts_with(&option)),
                    "{words:?}: {typed:?}"
                );
                let to = commands
                    .iter()
                    .find(|one| typed.first().is_some_and(|first| first == one.get_name()));
                assert!(has(to.unwrap_or(&&tree), long), "{words:?}: {typed:?}");
            }
        }
    }
    assert!(tried > 100 && lines > 20, "{tried} {lines}");
}

/// The line that is answered runs, where it needs nothing else.
#[test]
fn the_line_to_type_can_be_typed() {
    let folder = tempfile::tempdir().unwrap();
    let graph = folder.path().join("a graph.txt");
    fs::write(&graph, "a b\nb c\na c\n").unwrap();
    let graph = graph.to_str().unwrap();
    let cases: [(&[&str], &[&str]); 7] = [
        (&[graph, "--suggest"], &["advise", graph, "--suggest"]),
        (
            &[graph, "--suggest", "3"],
            &["advise", graph, "--suggest=3"],
        ),
        (&["advise", graph, "--table=csv"], &[graph, "--table=csv"]),
        (
            &["models", graph, "--explain", "a"],
            &["advise", graph, "--explain", "a"],
        ),
        (&[graph, "--prime", "1000003"], &[graph, "--prime=1000003"]),
        (
            &[graph, "--solutions", "full"],
            &[graph, "--solutions=full"],
        ),
        (
            &["advise", graph, "--weak", "images"],
            &["advise", graph, "--weak=images"],
        ),
    ];
    for (words, expected) in cases {
        let run = verify(words);
        assert_eq!(run.code, 2, "{words:?}");
        let typed = format!(
            "\n  verify {}\n",
            expected.join(" ").replace(graph, &format!("'{graph}'"))
        );
        assert!(run.err.contains(&typed), "{words:?}: {}", run.err);
        assert_eq!(verify(expected).code, 0, "{expected:?}");
    }
    // What another command would write to is not taken for a graph, and no option is left out.
    for words in [
        &["export", graph, "parts", "--weak"][..],
        &["draw", graph, "a.svg", "--table"],
        &[graph, graph, "--full"],
        &["advise", graph, "--suggest", "--certificate", "c.json"],
    ] {
        let run = verify(words);
        assert!(run.err.contains(" is an option of `verify"), "{}", run.err);
        assert_eq!(line(&run.err), None, "{}", run.err);
    }
}

/// A value that may be left out is no database, where the database is the graph.
#[test]
#[ignore = "needs the published data"]
fn intrinsics_swallow_no_database() {
    let database = data().join("colmap/synthetic_sparse.db");
    let database = database.to_str().unwrap();
    let expected = verify(&[database, "--intrinsics", "--json"]);
    for words in [
        &["--intrinsics", database, "--json"][..],
        &["--json", "--intrinsics", database],
    ] {
        let run = verify(words);
        let of = |run: &crate::common::Run| run.json()[0]["intrinsics"].clone();
        assert_eq!(
            (run.code, of(&run)),
            (expected.code, of(&expected)),
            "{}",
            run.err
        );
    }
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("a.svg");
    let run = verify(&["draw", "--intrinsics", database, picture.to_str().unwrap()]);
    assert!(
        run.code == expected.code && picture.is_file(),
        "{}",
        run.err
    );
}

/// A filter that says nothing about an input is an error, in every command.
#[test]
fn filters_that_do_not_apply_are_errors() {
    let options: [&[&str]; 8] = [
        &["--min-inliers", "20"],
        &["--pipeline", "global"],
        &["--variable", "A"],
        &["--min-views", "2"],
        &["--max-spread", "3"],
        &["--no-rigs"],
        &["--min-weight", "2"],
        &["--columns", "1,2"],
    ];
    for option in options {
        for command in [
            &[][..],
            &["advise"],
            &["overview"],
            &["models"],
            &["convert"],
        ] {
            let run = verify_with(b"DFw\n", &[command, &["-"], option].concat());
            assert_eq!(run.code, 2, "{command:?} {option:?}: {}", run.out);
            assert!(
                run.err.contains(option[0]) && run.err.contains("leave it out"),
                "{}",
                run.err
            );
        }
    }
    let bundler = "# Bundle file v0.3\n0 0\n";
    for option in [
        &["--max-spread", "3"][..],
        &["--no-rigs"],
        &["--min-inliers", "3"],
        &["--columns", "1,2"],
    ] {
        let run = verify_with(bundler.as_bytes(), &[&["--tracks", "-"], option].concat());
        assert!(
            run.code == 2 && run.err.contains(option[0]),
            "{option:?}: {}",
            run.err
        );
    }
}
