//! Files that this program writes and that are no graphs, given where one is expected.
//!
//! In: the first bytes of a file. Out: its name, and the command that reads it.

use crate::error::Problem;

const CHECK: &str = "`verify check FILE` verifies it; if the graph is in a file of its own, \
                     `verify check FILE GRAPH`";
const MANIFEST: &str =
    "`verify check FOLDER`, with the folder that it lies in, checks what it lists";
const REPORT: &str = "give the graph that it is about; `verify check` reads certificates \
                      (`verify GRAPH --certificate FILE`)";
const TABLE: &str = "its graphs are in the first column: cut -f1 FILE | tail -n +2 | verify -";
const WITNESS: &str =
    "give the graph that it is about; the cameras are for `check.py` and the like";

/// The names of formats in JSON: the first member of a file.
const FORMATS: [(&str, &str, &str); 3] = [
    ("viewcert certificate", "a certificate", CHECK),
    (
        "viewcert manifest",
        "the manifest of a folder of certificates",
        MANIFEST,
    ),
    (
        "viewcert witness",
        "a witness: two sets of cameras",
        WITNESS,
    ),
];

/// The first columns of tables.
const HEADS: [(&str, &str, &str); 2] = [
    ("graph6\tverdict\t", "a table of graphs", TABLE),
    ("graph6\tdegrees\t", "a table of graphs", TABLE),
];

/// A file of what is given besides a graph (`verify help given`), where a graph is expected: every line
/// begins with one of three words.
pub(super) fn given(head: &[u8]) -> Option<Problem> {
    let text = String::from_utf8_lossy(head);
    let lines = text.lines().map(str::trim_start);
    let mut lines = lines.filter(|line| !line.is_empty() && !line.starts_with(['#', '%']));
    let mut words = lines
        .by_ref()
        .map(|line| line.split_ascii_whitespace().next());
    let is_given = |word| matches!(word, Some("part" | "displacement" | "position"));
    let first = words.next()?;
    let mut rest: Vec<_> = words.collect();
    // What was looked at may end within a line.
    if !text.ends_with('\n') {
        rest.pop();
    }
    (is_given(first) && rest.into_iter().all(is_given)).then(|| {
        Problem::foreign(
            "a file of what is given besides a graph",
            "give it with the graph: verify GRAPH --given FILE; if its lines are pairs all the same, \
             write the line `source target` above them",
        )
    })
}

/// What a file is that begins like this, if this program has written it.
pub(super) fn known(head: &[u8]) -> Option<Problem> {
    let text = String::from_utf8_lossy(head);
    let text = text.trim_start();
    let own = |what: &str, advice: &'static str| {
        let what = format!("this is {what} that this program has written, and it is not read here");
        Some(Problem::new(what, advice))
    };
    if text.starts_with('{') {
        let member = |name: &str| {
            let behind = text.split_once(&format!("\"{name}\""))?.1.trim_start();
            Some(behind.strip_prefix(':')?.trim_start())
        };
        if let Some(format) = member("format").and_then(|value| value.strip_prefix('"')) {
            let known = FORMATS.iter().find(|(name, ..)| format.starts_with(name));
            if let Some((_, what, advice)) = known {
                return own(what, advice);
            }
        }
        let own_program = ["{\"name\":\"verify\"", "\"viewcert"];
        let report = member("program")
            .is_some_and(|value| own_program.iter().any(|own| value.starts_with(own)));
        return if report {
            own("a report", REPORT)
        } else {
            None
        };
    }
    let (_, what, advice) = HEADS.iter().find(|(head, ..)| text.starts_with(head))?;
    own(what, advice)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_others_are_not_ours() {
        for text in [
            "{\"nodes\": [{\"id\": 1}], \"links\": [], \"graph\": {}}",
            "{\"format\": \"another\", \"notes\": []}",
            "{\"graph\": {\"nodes\": 3}, \"notes\": []}",
            "{\"name\":\"mine\",\"notes\":[],\"nodes\":[],\"links\":[]}",
            "<svg xmlns=\"http://www.w3.org/2000/svg\"></svg>",
            "<!DOCTYPE html><html></html>",
            "graph6 verdict\n",
            "a b\n  graph       c\n",
        ] {
            assert!(known(text.as_bytes()).is_none(), "{text}");
        }
    }
}
