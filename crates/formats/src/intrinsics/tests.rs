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
    let classes = (0..4).map(|v| found.sensors.class_of_node(v)).collect();
    Ok((classes, found.notes))
}

/// The sensors that are shared: class, nodes.
fn shared(text: &str) -> (Vec<(Class, Vec<u32>)>, Vec<String>) {
    let found = read(text.as_bytes(), &graph()).unwrap();
    let sensors = found.sensors.shared().into_iter();
    let sensors = sensors.map(|(sensor, nodes)| (found.sensors.class(sensor), nodes));
    (sensors.collect(), found.notes)
}

#[test]
fn lines_that_share_a_sensor() {
    use Class::{Focal, FocalAndPoint, Unknown};
    let (found, notes) = shared("shared focal a d a\nshared focal \"b c\" e\n");
    assert_eq!(found, [(Focal, vec![0, 2]), (Focal, vec![1, 3])]);
    assert!(notes.is_empty(), "{notes:?}");
    let (found, notes) = shared("known a\ndefault shared unknown\n");
    assert_eq!((found, notes), (vec![(Unknown, vec![1, 2, 3])], vec![]));
    let (found, _) = shared("shared focal+point a\nfocal+point d e\ndefault focal\n");
    assert_eq!(found, []);
    // What is known needs no sharing.
    assert_eq!(shared("shared known a d\ndefault shared known\n").0, []);
    assert_eq!(
        shared("default shared focal+point\n").0,
        [(FocalAndPoint, vec![0, 1, 2, 3])]
    );
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
            "2 cameras of no class: taken for unknown (a line `default known` or the like says otherwise)"
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
            "`a` is of another class or sensor in line 1",
        ),
        (
            "shared focal a d\nshared focal a e\n",
            "classes.txt:2:",
            "`a` is of another class or sensor in line 1",
        ),
        (
            "shared focal a d\nfocal d\n",
            "classes.txt:2:",
            "`d` is of another class or sensor in line 1",
        ),
        ("shared\n", "classes.txt:1:", "`shared` is no class"),
        ("shared a d\n", "classes.txt:1:", "`a` is no class"),
        ("shared focal\n", "classes.txt:1:", "names no camera"),
        (
            "default shared focal\ndefault focal\n",
            "classes.txt:2:",
            "one default",
        ),
    ] {
        let said = classes(text).unwrap_err();
        assert!(
            said.starts_with(place) && said.contains(why),
            "{text:?}: {said}"
        );
    }
}
