use super::*;

/// Groups 0-1-2-3 and 4-5 of seven nodes.
fn vectors(of_first: [Vector; 3], of_second: Vector) -> Checked<Vectors> {
    let big = |vector: &Vector| vector.map(Big);
    let lists = [of_first.iter().map(big).collect(), vec![big(&of_second)]];
    check_vectors(&lists, Some(&[vec![0, 1, 2, 3], vec![4, 5]]), 7)
}

#[test]
fn which_vectors_are_well_formed() {
    let (x, y, z) = ([1, 0, 0], [0, 1, 0], [0, 0, 1]);
    assert!(vectors([x, y, z], x).is_ok());
    for (first, second, why) in [
        ([x, y, [0; 3]], x, "two nodes are at one place"),
        ([x, y, y], x, "two nodes are at one place"),
        ([x, y, z], [0; 3], "two nodes are at one place"),
        ([x, y, [10i128.pow(30), 0, 0]], x, "more than 30 digits"),
        ([[2, 0, 0], [0, 4, 0], [0, 0, 6]], [8, 0, 0], "divisor 2"),
    ] {
        let error = vectors(first, second).err().unwrap().to_string();
        assert!(error.contains(why), "{error}");
    }
    let big = vec![x.map(Big)];
    let error = check_vectors(&[big], Some(&[vec![0, 1, 2]]), 3);
    assert!(error.err().unwrap().to_string().contains("not one vector"));
    let error = check_vectors(&[], Some(&[vec![0, 1]]), 3);
    assert!(error.err().unwrap().to_string().contains("not one list"));
}

#[test]
fn what_is_independent() {
    let on_a_line = vectors([[1, 0, 0], [2, 0, 0], [0, 1, 0]], [3, 0, 0]).unwrap();
    for (nodes, expected) in [
        (&[0, 1, 2][..], false),
        (&[0, 1, 3], true),
        (&[0, 1, 6], true),
        (&[0, 1, 2, 3], false),
        (&[0, 1, 4, 5], false),
        (&[0, 3, 4, 5], true),
        (&[0, 4, 6], true),
    ] {
        assert_eq!(on_a_line.are_independent(nodes), expected, "{nodes:?}");
    }
}

#[test]
fn what_agrees() {
    let known = vectors([[1, 0, 0], [0, 2, 0], [0, 1, 0]], [0, 1, 0]).unwrap();
    let agree = |members: &[&[u32]]| known.agree(members.iter().copied());
    // 1 to 3 is not what 4 to 5 is, 0 to 3 and 3 to 2 are.
    assert!(!agree(&[&[1, 4], &[3, 5]]));
    assert!(agree(&[&[0, 4], &[3, 5]]));
    assert!(agree(&[&[3, 4], &[2, 5]]));
    assert!(agree(&[&[0, 4, 6], &[3, 5]]));
    assert!(!agree(&[&[0, 4, 6], &[3, 6]]));
    assert!(!agree(&[&[0, 3]]));
}

/// By Python's hashlib, from the page.
#[test]
fn the_hash_is_that_of_the_page() {
    let lists = [vec![[3, 0, -2].map(Big)], vec![[0, 0, 20].map(Big)]];
    let groups = [vec![1, 4], vec![2, 3]];
    assert_eq!(
        crate::graph::hex(&crate::displacements::digest(&groups, Some(&lists))),
        "ef905f274b7c7f9c2b348a53e07546bf10011b1bc2a214baa895914e61549475"
    );
}
