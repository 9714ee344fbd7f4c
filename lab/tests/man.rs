//! Completion scripts and manual pages, through the binary.

use crate::common::{Run, verify};

fn workshop(arguments: &[&str]) -> Run {
    crate::common::run("viewcert-lab", arguments)
}

/// The commands that the help lists, and some options of the program itself.
fn commands() -> Vec<String> {
    let help = verify(&["--help"]).out;
    let (_, list) = help.split_once("Commands:\n").unwrap();
    let (list, _) = list.split_once("\n\n").unwrap();
    // Descriptions that take a second line are further in.
    let names = list.lines().filter_map(|line| line.strip_prefix("  "));
    let names = names.filter(|line| !line.starts_with(' '));
    let names = names.map(|line| line.split(' ').next().unwrap().to_owned());
    let names: Vec<String> = names.filter(|name| name != "help").collect();
    assert!(names.len() >= 6, "{names:?}");
    assert!(names.iter().any(|name| name == "check"));
    names
}

#[test]
fn every_shell_completes_every_command() {
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let run = workshop(&["completions", shell]);
        assert_eq!((run.code, run.err.as_str()), (0, ""), "{shell}");
        for name in commands() {
            assert!(run.out.contains(&name), "{shell}: {name}");
        }
        // Flags have a name of their own in fish.
        assert!(run.out.contains("certificate"), "{shell}");
    }
    let run = workshop(&["completions", "cmd"]);
    assert_eq!(run.code, 2);
    assert!(run.err.contains("possible values: bash"), "{}", run.err);
}

#[test]
fn the_manual_names_every_command_and_each_has_its_page() {
    let run = workshop(&["manpage"]);
    assert_eq!((run.code, run.err.as_str()), (0, ""));
    assert!(run.out.contains(".TH verify 1"), "{}", run.out);
    assert!(run.out.contains("\\-\\-certificate"));
    for name in commands() {
        assert!(run.out.contains(&format!("verify\\-{name}(1)")), "{name}");
        let run = workshop(&["manpage", &name]);
        assert_eq!((run.code, run.err.as_str()), (0, ""), "{name}");
        assert!(run.out.contains(&format!(".TH verify-{name} 1")), "{name}");
    }
    // The catalog by the million, and with it `catalog merge`, is the lab's alone.
    let page = workshop(&["manpage", "catalog"]);
    assert!(
        page.out.contains(".TH verify-catalog 1"),
        "{}{}",
        page.out,
        page.err
    );
    let merge = workshop(&["manpage", "catalog", "merge"]);
    assert_eq!((merge.code, merge.out.as_str()), (2, ""));
    assert!(
        merge.err.contains("manpage: catalog has no commands"),
        "{}",
        merge.err
    );
    let wrong = workshop(&["manpage", "chekc"]);
    assert_eq!((wrong.code, wrong.out.as_str()), (2, ""));
    assert!(
        wrong
            .err
            .contains("chekc is not a command of verify; its commands are overview, advise, ")
    );
}
