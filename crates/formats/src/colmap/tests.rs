use super::pairs::of_cameras;
use super::summary::{bins, guesses};
use crate::{
    Format, Matching, NamedGraph, OtherPair, ReadError, ReadOptions, open_database, read_graphs,
};
use rusqlite::Connection;
use viewcert::graph::Labels;

/// A database with the images c, a, b (1, 2, 3) and the rows that are given.
fn read(rows: &str) -> Result<NamedGraph, ReadError> {
    let folder = tempfile::tempdir().unwrap();
    // A name that has to be escaped for SQLite.
    let path = folder.path().join("a %41?#.db");
    let connection = Connection::open(&path).unwrap();
    let tables = "
        create table images (image_id integer primary key, name text);
        insert into images values (1, 'c'), (2, 'a'), (3, 'b');
        create table matches (pair_id integer primary key, rows integer);
        create table two_view_geometries (pair_id integer primary key, rows integer,
            cols integer, data blob, config integer);";
    connection.execute_batch(tables).unwrap();
    connection.execute_batch(rows).unwrap();
    drop(connection);
    let mut graphs = read_graphs(path.to_str().unwrap(), &ReadOptions::default());
    let graph = graphs.next().unwrap();
    assert!(graphs.next().is_none());
    graph
}

#[test]
fn pairs_that_are_no_edges_keep_what_is_known_of_them() {
    let graph = read(
        "insert into two_view_geometries values
            (2147483647 * 1 + 2, 40, 2, null, 2), (2147483647 * 2 + 3, 7, 2, null, 2);
         insert into matches values
            (2147483647 * 1 + 2, 90), (2147483647 * 2 + 3, 50), (2147483647 * 1 + 3, 12);",
    );
    let graph = graph.unwrap();
    assert_eq!(
        graph.labels,
        Labels::Names(["a", "b", "c"].map(Into::into).into())
    );
    // c and a are the nodes 2 and 0.
    assert_eq!(graph.graph.edges(), [(0, 2)]);
    let other = |images, inliers, matches| OtherPair {
        images,
        inliers,
        matches: Some(matches),
        verified: inliers > 0,
        used: false,
    };
    let matching = Matching {
        inliers: vec![40],
        others: vec![other((0, 1), 7, 50), other((1, 2), 0, 12)],
        positions: Vec::new(),
    };
    assert_eq!(graph.matching, Some(matching));
}

#[test]
fn a_pair_that_is_only_matched_is_not_verified() {
    let error = read("insert into matches values (2147483647 * 1 + 2, 90)").unwrap_err();
    let text = error.to_string();
    assert!(
        text.contains("1 pair is matched, but none is verified"),
        "{text}"
    );
}

#[test]
fn bins_hold_every_number_once() {
    let numbers = [0, 1, 14, 15, 29, 30, 959, 960, u32::MAX];
    let found = bins(numbers.into_iter());
    let found: Vec<_> = found
        .iter()
        .map(|bin| (bin.from, bin.to, bin.pairs))
        .collect();
    assert_eq!(
        found,
        [
            (0, Some(0), 1),
            (1, Some(14), 2),
            (15, Some(29), 2),
            (30, Some(59), 1),
            (480, Some(959), 1),
            (960, None, 2)
        ]
    );
}

/// Images 0 and 1 are one camera, image 2 is the other.
#[test]
fn cameras_have_the_pairs_and_positions_of_their_images() {
    let pair = |images, inliers| OtherPair {
        images,
        inliers,
        matches: None,
        verified: true,
        used: true,
    };
    let matching = Matching {
        others: vec![pair((0, 1), 50), pair((0, 2), 7), pair((1, 2), 9)],
        positions: vec![None, Some([1.0, 2.0, 3.0]), Some([4.0, 5.0, 6.0])],
        ..Matching::default()
    };
    let found = of_cameras(matching, |image| [0, 0, 1][image as usize]);
    assert_eq!(found.others, [pair((0, 1), 9)]);
    let positions = [Some([1.0, 2.0, 3.0]), Some([4.0, 5.0, 6.0])];
    assert_eq!(found.positions, positions);
}

/// A database with two images and a pair, at a path.
fn written(path: &std::path::Path) -> Connection {
    let connection = Connection::open(path).unwrap();
    let tables = "
        create table images (image_id integer primary key, name text);
        insert into images values (1, 'a'), (2, 'b');
        create table matches (pair_id integer primary key, rows integer);
        create table two_view_geometries (pair_id integer primary key, rows integer,
            cols integer, data blob, config integer);
        insert into two_view_geometries values (2147483647 * 1 + 2, 40, 2, null, 2);";
    connection.execute_batch(tables).unwrap();
    connection
}

/// Writers wait while something is read, and do not while nothing is; what they wrote is found out.
#[test]
fn who_wants_to_write_waits_only_while_something_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.db");
    let writer = written(&path);
    writer.busy_timeout(std::time::Duration::ZERO).unwrap();
    let write = || writer.execute_batch("insert into images values (3, 'c')");
    let opened = || {
        let opened = open_database(&path, &ReadOptions::default());
        opened.unwrap().unwrap()
    };
    let database = opened();
    assert_eq!(database.pairs().graph.edges(), [(0, 1)]);
    assert!(write().is_err(), "it is locked");
    database.rest().unwrap();
    assert!(database.views().is_ok(), "nobody has written");
    assert!(write().is_err(), "it is locked again");
    database.rest().unwrap();
    write().unwrap();
    let error = database.views().err().unwrap().to_string();
    assert!(
        error.contains("was written to while it was read"),
        "{error}"
    );
    assert_eq!(opened().pairs().graph.nodes(), 3);
}

/// What is no database, or is to be read as something else, is not opened.
#[test]
fn only_databases_are_opened() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.db");
    drop(written(&path));
    let edges = ReadOptions {
        format: Some(Format::Edges),
        ..ReadOptions::default()
    };
    assert!(open_database(&path, &edges).is_none());
    let list = folder.path().join("list.txt");
    std::fs::write(&list, "a b\n").unwrap();
    assert!(open_database(&list, &ReadOptions::default()).is_none());
}

/// Focal lengths that are guesses, of cameras that one image has or two; three images of a camera tell its
/// focal length, and a known one is no guess.
#[test]
fn focal_lengths_of_few_images_that_are_guesses_are_said() {
    let folder = tempfile::tempdir().unwrap();
    let said = |number: usize, prior: i64, cameras: &[i64]| {
        let connection = Connection::open(folder.path().join(format!("{number}.db"))).unwrap();
        let tables = format!(
            "create table images (image_id integer primary key, name text, camera_id integer);
             create table cameras (camera_id integer primary key, prior_focal_length integer);
             insert into cameras values (1, {prior}), (2, {prior}), (3, 1);"
        );
        connection.execute_batch(&tables).unwrap();
        for camera in cameras {
            let image = "insert into images (name, camera_id) values ('x', ?)";
            connection.execute(image, [camera]).unwrap();
        }
        let nodes = (1..=cameras.len() as i64).zip(0..).collect();
        let paired = (0..cameras.len() as u32).collect();
        guesses(&connection, &nodes, &paired).unwrap()
    };
    assert_eq!(said(0, 0, &[1, 1, 2, 3]), [3, 0, 3]);
    assert_eq!(said(1, 0, &[1, 1, 1, 2, 3]), [1, 1, 4]);
    assert_eq!(said(2, 0, &[1, 1, 1, 3]), [0, 1, 3]);
    assert_eq!(said(3, 1, &[1, 2, 3]), [0, 0, 0]);
    // Older databases may not have the column.
    let old = Connection::open_in_memory().unwrap();
    old.execute_batch("create table images (image_id integer, name text)")
        .unwrap();
    let found = guesses(&old, &[(1, 0)].into(), &[0].into()).unwrap();
    assert_eq!(found, [0; 3]);
}
