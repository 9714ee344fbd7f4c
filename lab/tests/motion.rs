//! `viewcert-lab motion`: what moves at given cameras, as a picture.

use crate::common::{Run, root};

fn motion(arguments: &[&str]) -> Run {
    crate::common::run("viewcert-lab", &[&["motion"], arguments].concat())
}

/// A quadrangle in a plane, by hand: the pair a b is held still, c goes along b c by (1, 3), d along a d by
/// (-1, 2) 17/13, and their difference along c d.
#[test]
fn what_moves_is_drawn() {
    let example = |name: &str| {
        let path = root().join("examples/degenerate").join(name);
        path.display().to_string()
    };
    let folder = tempfile::tempdir().unwrap();
    let svg = folder.path().join("motion.svg");
    let file = svg.to_str().unwrap();
    let (pairs, cameras) = (example("square-pairs.txt"), example("square-cameras.txt"));
    let calibrated = ["--model", "calibrated"];
    let run = motion(&[&[&pairs, &cameras, file], &calibrated[..]].concat());
    assert_eq!(run.code, 0, "{}", run.err);
    let svg = std::fs::read_to_string(svg).unwrap();
    assert!(svg.contains("motion 1 of 1: 2 centres move"), "{svg}");
    let arrows: Vec<[f64; 2]> = svg
        .lines()
        .filter(|line| line.starts_with("<line") && line.contains("stroke:#222"))
        .map(|line| {
            let number = |name: &str| {
                let from = line.find(&format!("{name}=\"")).unwrap() + name.len() + 2;
                let text = &line[from..];
                text[..text.find('"').unwrap()].parse::<f64>().unwrap()
            };
            // Up is up.
            [number("x2") - number("x1"), number("y1") - number("y2")]
        })
        .collect();
    let [c, d] = arrows[..] else {
        panic!("{arrows:?}")
    };
    assert!(
        (c[1] / c[0] - 3.0).abs() < 0.05 && (d[1] / d[0] + 2.0).abs() < 0.05,
        "{arrows:?}"
    );
    assert!(
        (d[1] / c[1] - 2.0 * 17.0 / (13.0 * 3.0)).abs() < 0.02,
        "{arrows:?}"
    );
    // At cameras that hold, and in the affine model, there is nothing to draw, and no file.
    let held = folder.path().join("held.txt");
    std::fs::write(
        &held,
        "centre a 0 0 0\ncentre b 4 0 1\ncentre c 5 3 0\ncentre d -1 2 3\n",
    )
    .unwrap();
    let none = folder.path().join("none.svg");
    let affine = (
        example("desargues-pairs.txt"),
        example("desargues-cameras.txt"),
    );
    for (pairs, cameras, model) in [
        (&*pairs, held.to_str().unwrap(), "calibrated"),
        (&*affine.0, &*affine.1, "affine"),
    ] {
        let run = motion(&[pairs, cameras, none.to_str().unwrap(), "--model", model]);
        assert_eq!(run.code, 2, "{}", run.err);
        assert!(run.err.contains("nothing to draw"), "{}", run.err);
        assert!(!none.exists());
    }
}
