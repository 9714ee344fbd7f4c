//! `verify watch`: a database is followed while another program writes it.

use crate::colmap::{Made, TABLES, same};
use crate::common::verify;
use std::io::{BufRead, BufReader, Lines};
use std::process::{Child, ChildStdout, Command, Stdio};

struct Watch {
    child: Child,
    lines: Lines<BufReader<ChildStdout>>,
}

impl Watch {
    fn new(made: &Made, options: &[&str]) -> Self {
        let mut child = Command::new(env!("CARGO_BIN_EXE_verify"))
            .arg("watch")
            .arg(made.path())
            .args(options)
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let lines = BufReader::new(child.stdout.take().unwrap()).lines();
        Self { child, lines }
    }

    /// The next line; waits until there is one.
    fn line(&mut self) -> String {
        self.lines.next().unwrap().unwrap()
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        self.child.kill().unwrap();
        self.child.wait().unwrap();
    }
}

const IMAGES: [(i64, &str); 6] = [
    (1, "a1.jpg"),
    (2, "a2.jpg"),
    (3, "a3.jpg"),
    (4, "b1.jpg"),
    (5, "b2.jpg"),
    (6, "b3.jpg"),
];

#[test]
fn what_joins_has_a_line() {
    let made = Made::new(TABLES, &IMAGES);
    made.pair(1, 2, &same(20), 2);
    let mut watch = Watch::new(&made, &[]);
    let begins = "begins      6 images and 1 pair: 0 components with three images and more";
    assert_eq!(watch.line(), begins);
    assert_eq!(
        watch.line(),
        "verdict     solvable (proof), of the 2 images with a pair"
    );
    // A pair with too few inliers changes nothing.
    made.pair(1, 4, &same(14), 2);
    made.execute("begin");
    made.pair(2, 3, &same(20), 2);
    made.pair(1, 3, &same(20), 2);
    made.pair(4, 5, &same(20), 2);
    made.execute("commit");
    assert_eq!(watch.line(), "new         3 images (a1.jpg, ...)");
    assert_eq!(
        watch.line(),
        "verdict     not-finite-solvable (proof), of the 5 images with a pair"
    );
    made.execute("begin");
    made.pair(5, 6, &same(20), 2);
    made.pair(4, 6, &same(20), 2);
    made.execute("commit");
    assert_eq!(watch.line(), "new         3 images (b1.jpg, ...)");
    // Two pairs leave the one part free against the other.
    made.execute("begin");
    made.pair(1, 5, &same(20), 2);
    made.pair(2, 6, &same(20), 2);
    made.pair(3, 6, &same(20), 2);
    made.execute("commit");
    let joins = "joins       3 images (a1.jpg, ...) and 3 images (b1.jpg, ...) are one: 6 images (a1.jpg, ...)";
    assert_eq!(watch.line(), joins);
    assert_eq!(
        watch.line(),
        "verdict     solvable (proof), of all 6 images"
    );
    // Pairs that go are no growth: all is told anew.
    made.execute("delete from two_view_geometries where pair_id / 2147483647 < 3 and pair_id % 2147483647 > 3");
    assert_eq!(
        watch.line(),
        "begins      6 images and 7 pairs: 2 components with three images and more"
    );
}

#[test]
fn only_databases_are_followed() {
    let folder = tempfile::tempdir().unwrap();
    let list = folder.path().join("pairs.txt");
    std::fs::write(&list, "0 1\n1 2\n").unwrap();
    let run = verify(&["watch", list.to_str().unwrap()]);
    assert_eq!(run.code, 2);
    assert!(
        run.err.contains("this is no database of COLMAP"),
        "{}",
        run.err
    );
    let made = Made::new("create table images (image_id integer, title text)", &[]);
    let run = verify(&["watch", made.path().to_str().unwrap()]);
    assert_eq!(run.code, 2, "{}", run.err);
}
