use super::*;
use viewcert::Graph;
use viewcert::graph::Labels;

fn graph() -> NamedGraph {
    let names = ["a", "b c", "d", "e"];
    let graph = Graph::new(4, [(0, 1), (1, 2), (2, 3)]).unwrap();
    NamedGraph::new("path", graph, Labels::Names(names.map(Into::into).into()))
}

fn classes(text: &str) -> Result<(Vec<Class>, Vec<String>), String> {
    let found = read(text.as_bytes(), &graph());
    let found = found.map_err(|fault| fault.in_file("classes.txt").to_string())?;
    Ok((found.classes, found.notes))
}

#[test]
fn classes_names_and_defaults() {
    use Class::{Focal, FocalAndPoint, Known, Unknown};
    let (found, notes) =
        classes("# rig\nknown a \"b c\"\nfocal+point d % zoom\ndefault focal\n").unwrap();
    assert_eq!(found, [Known, Known, FocalAndPoint, Focal]);
    assert_eq!(notes, [""; 0]);
    let (found, notes) = classes("focal e\nfocal d e d\n").unwrap();
    assert_eq!(found, [Unknown, Unknown, Focal, Focal]);
    assert_eq!(
        notes,
        [
            "2 cameras of no class: taken for unknown (a line `default known` or the like says otherwise)",
            "2 cameras named again in its class (first in line 2)"
        ]
    );
    assert_eq!(
        classes("default unknown\n").unwrap(),
        (vec![Unknown; 4], vec![])
    );
}

#[test]
fn what_is_no_class_is_refused_with_its_line() {
    for (text, place, why) in [
        ("", "classes.txt:", "says nothing"),
        ("# none\n\n", "classes.txt:", "says nothing"),
        ("known a\nzoom d\n", "classes.txt:2:", "`zoom` is no class"),
        ("known f\n", "classes.txt:1:", "`f`"),
        ("known\n", "classes.txt:1:", "names no camera"),
        ("default\n", "classes.txt:1:", "one default"),
        ("default known focal\n", "classes.txt:1:", "one default"),
        (
            "default known\ndefault focal\n",
            "classes.txt:2:",
            "one default",
        ),
        (
            "known a\nfocal d a\n",
            "classes.txt:2:",
            "`a` is of another class in line 1",
        ),
    ] {
        let said = classes(text).unwrap_err();
        assert!(
            said.starts_with(place) && said.contains(why),
            "{text:?}: {said}"
        );
    }
}
