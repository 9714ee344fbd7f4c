use super::*;

fn path() -> Graph {
    Graph::new(4, [(0, 1), (1, 2), (2, 3)]).unwrap()
}

fn given(file: &str) -> Result<Graph, String> {
    let graph = path().with_given(file.as_bytes());
    graph.map_err(|error| error.to_string())
}

#[test]
fn files_of_known_parts() {
    let parts = given("# parts\npart 3 1\r\npart\t2\t0 1").unwrap().parts;
    assert_eq!(parts, [vec![0, 1, 2], vec![1, 3]]);
    let no_part = "a line is `part` and two node numbers or more";
    for (file, reason) in [
        ("", "the file gives nothing"),
        ("# none\n", "the file gives nothing"),
        ("part 0 1\npart 2\n", no_part),
        ("part 0 1\n\n", no_part),
        ("0 1\n", no_part),
        ("part\n", no_part),
        ("part0 1\n", no_part),
        ("part  0 1\n", no_part),
        ("part 0  1\n", no_part),
        ("part 0 a\n", no_part),
        ("part 0 1 # all\n", no_part),
        ("part 0 1 4\n", "line 1: the graph has no node 4"),
        ("part 0 1 0\n", "line 1: a node is named twice"),
        (
            "part 0 1 2\npart 0 1\npart 2 0 1\n",
            "a known part occurs twice",
        ),
    ] {
        let found = given(file).unwrap_err();
        assert!(found.contains(reason), "{file}: {found}");
    }
}

#[test]
fn files_of_displacements() {
    let hash = "0123456789ABCDEF".repeat(4);
    let graph = given(&format!("# rigs\ndisplacements {hash}\n")).unwrap();
    assert_eq!(graph.displacements, Some(hash.to_lowercase()));
    let no_hash = "line 1: behind `displacements` stands a hash";
    for (file, reason) in [
        ("displacements\n".to_owned(), no_hash),
        (format!("displacements{hash}"), no_hash),
        (format!("displacements  {hash}"), no_hash),
        (format!("displacements {}", &hash[1..]), no_hash),
        (format!("displacements {}g", &hash[1..]), no_hash),
        (
            format!("displacements {hash}\npart 0 1"),
            "something stands beside",
        ),
        (
            format!("part 0 1\ndisplacements {hash}"),
            "line 2: a line is `part`",
        ),
    ] {
        let found = given(&file).unwrap_err();
        assert!(found.contains(reason), "{file}: {found}");
    }
}

#[test]
fn files_with_frames() {
    let (hash, other) = ("0123456789ABCDEF".repeat(4), "f".repeat(64));
    let graph = given(&format!("# rigs\nframes\t{hash}")).unwrap();
    assert_eq!(graph.frames, Some(hash.to_lowercase()));
    assert_eq!((graph.displacements, graph.parts.len()), (None, 0));
    let graph = given(&format!("displacements {other}\nframes {hash}\n")).unwrap();
    assert_eq!(graph.frames, Some(hash.to_lowercase()));
    assert_eq!(graph.displacements, Some(other.clone()));
    let graph = given(&format!("part 2 0\nframes {hash}\n")).unwrap();
    assert_eq!(graph.frames, Some(hash.to_lowercase()));
    assert_eq!(graph.parts, [vec![0, 2]]);
    for (file, reason) in [
        ("frames\n".to_owned(), "line 1: behind `displacements`"),
        (format!("frames {}", &hash[1..]), "line 1: behind"),
        (
            format!("frames {hash}\npart 0 1"),
            "line 1: a line is `part`",
        ),
        (format!("frames {hash}\nframes {hash}"), "line 1: a line is"),
        (
            format!("displacements {hash}\ndisplacements {hash}\nframes {hash}"),
            "something stands beside",
        ),
    ] {
        let found = given(&file).unwrap_err();
        assert!(found.contains(reason), "{file}: {found}");
    }
}

/// What is not read from a file need not be in order.
#[test]
fn parts_in_canonical_form() {
    let given = path().with_parts([vec![3, 2, 1], vec![1, 0], vec![2], vec![0, 1, 1], vec![]]);
    assert_eq!(given.unwrap().parts, [vec![0, 1], vec![1, 2, 3]]);
    assert!(path().with_parts([vec![0, 4]]).is_err());
}
