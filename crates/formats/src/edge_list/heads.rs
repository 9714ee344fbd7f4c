//! Names of columns: which two of them are a pair, and which are none.

use crate::edge_list::marks;

/// Names of two columns with the ends of a pair, in lower case and without `_`, `-`, `.` and blanks.
const PAIRS: [[&str; 2]; 13] = [
    ["source", "target"],
    ["from", "to"],
    ["src", "dst"],
    ["src", "tgt"],
    ["src", "dest"],
    ["source", "destination"],
    ["fromnodeid", "tonodeid"],
    ["fromnode", "tonode"],
    ["fromid", "toid"],
    ["sourceid", "targetid"],
    ["sourcenode", "targetnode"],
    ["queryimage", "mapimage"],
    ["startid", "endid"],
];

/// The same, which could be names of cameras as well.
const PERHAPS: [[&str; 2]; 25] = [
    ["start", "end"],
    ["head", "tail"],
    ["tail", "head"],
    ["parent", "child"],
    ["left", "right"],
    ["first", "second"],
    ["query", "reference"],
    ["query", "ref"],
    ["query", "db"],
    ["query", "database"],
    ["query", "map"],
    ["query", "retrieved"],
    ["query", "match"],
    ["reference", "query"],
    ["reference", "target"],
    ["ref", "target"],
    ["anchor", "positive"],
    ["base", "match"],
    ["master", "slave"],
    ["parent", "node"],
    ["qname", "dbname"],
    ["ref", "src"],
    ["i", "j"],
    ["u", "v"],
    ["a", "b"],
];

/// What cameras are called in heads.
const CAMERAS: [&str; 30] = [
    "image",
    "img",
    "im",
    "imageid",
    "imagename",
    "imgname",
    "photo",
    "picture",
    "pic",
    "view",
    "node",
    "vertex",
    "cam",
    "camera",
    "frame",
    "file",
    "filename",
    "name",
    "id",
    "path",
    "imagepath",
    "imgpath",
    "filepath",
    "viewid",
    "camid",
    "cameraid",
    "nodeid",
    "keyframe",
    "kf",
    "bild",
];

/// What the other end is called then.
const NEIGHBOURS: [&str; 9] = [
    "neighbour",
    "neighbor",
    "neighbourid",
    "neighborid",
    "match",
    "matched",
    "matchedimage",
    "other",
    "partner",
];

/// Names of columns that hold no cameras.
const OTHERS: [&str; 71] = [
    "width",
    "height",
    "w",
    "h",
    "x",
    "y",
    "z",
    "x1",
    "y1",
    "x2",
    "y2",
    "xmin",
    "ymin",
    "xmax",
    "ymax",
    "tx",
    "ty",
    "tz",
    "qw",
    "qx",
    "qy",
    "qz",
    "lat",
    "lon",
    "lng",
    "long",
    "latitude",
    "longitude",
    "alt",
    "altitude",
    "elevation",
    "time",
    "timestamp",
    "date",
    "focal",
    "focallength",
    "fx",
    "fy",
    "cx",
    "cy",
    "k1",
    "k2",
    "omega",
    "phi",
    "kappa",
    "roll",
    "pitch",
    "yaw",
    "heading",
    "accuracy",
    "label",
    "class",
    "category",
    "type",
    "score",
    "weight",
    "size",
    "degree",
    "community",
    "cluster",
    "group",
    "color",
    "model",
    "cameramodel",
    "params",
    "make",
    "iso",
    "exposure",
    "value",
    "count",
    "split",
];

/// Names of columns with weights.
const WEIGHTS: [&str; 16] = [
    "weight",
    "weights",
    "score",
    "matches",
    "nummatches",
    "nmatches",
    "inliers",
    "numinliers",
    "ninliers",
    "count",
    "overlap",
    "similarity",
    "distance",
    "w",
    "value",
    "covisibility",
];

/// A name of a column without what people write differently.
fn plain(name: &str) -> String {
    let kept = name.chars().filter(|c| !" _-.#:\t".contains(*c));
    kept.flat_map(char::to_lowercase).collect()
}

/// Whether these are names of two columns that hold the ends of pairs.
pub(super) fn is_pair(first: &str, second: &str) -> bool {
    let (first, second) = (&*plain(first), &*plain(second));
    if PAIRS.contains(&[first, second]) || CAMERAS.contains(&first) && NEIGHBOURS.contains(&second)
    {
        return true;
    }
    marks::word(first, second).is_some_and(|word| CAMERAS.contains(&&*word))
}

/// Whether these may be such names.
pub(super) fn may_be_pair(first: &str, second: &str) -> bool {
    let plain = [&*plain(first), &*plain(second)];
    // `image0` may well be an image.
    let zero = || marks::word_from_zero(plain[0], plain[1]);
    is_pair(first, second)
        || PERHAPS.contains(&plain)
        || zero().is_some_and(|word| CAMERAS.contains(&&*word))
}

/// Whether the first two of some labels may be names of columns if nothing below is like them: they
/// are known, or one word with two marks, or two letters one after the other.
pub(super) fn could_be_pair(first: &str, second: &str) -> bool {
    let [a, b] = [plain(first), plain(second)];
    may_be_pair(first, second)
        || [marks::word(&a, &b), marks::word_from_zero(&a, &b)]
            .into_iter()
            .flatten()
            .any(|word| word.chars().all(char::is_alphabetic))
}

/// Whether names of three columns are those of a pair and of its weight, as far as names can tell:
/// `id1,id2,id3` are none.
pub(super) fn name_weights(names: &[Box<str>]) -> bool {
    let [first, second, third, ..] = names else {
        return false;
    };
    let alike = shape(first) == shape(third) || shape(second) == shape(third);
    is_weight(third) || is_pair(first, second) && !alike
}

/// Whether a column of this name holds no cameras.
pub(super) fn is_no_camera(name: &str) -> bool {
    let name = plain(name);
    let name = name.split(['[', '(']).next().unwrap_or_default();
    OTHERS.contains(&name)
}

/// Whether a column of this name holds weights.
pub(super) fn is_weight(name: &str) -> bool {
    WEIGHTS.contains(&&*plain(name))
}

/// The first two columns, in this order, whose names are those of a pair, or may be if it is `sure`
/// that these are names of columns.
pub(super) fn pair_among(names: &[&str], sure: bool) -> Option<[usize; 2]> {
    // Wider tables are none that people make lists of pairs in.
    const MOST: usize = 64;
    let columns = 0..names.len().min(MOST);
    columns
        .clone()
        .flat_map(|first| columns.clone().map(move |second| [first, second]))
        .filter(|[first, second]| first < second)
        .find(|&[first, second]| {
            let [first, second] = [names[first], names[second]];
            // Letters are names of columns of all kinds.
            let words = first.len() > 1;
            is_pair(first, second) || sure && words && may_be_pair(first, second)
        })
}

/// Features that names of cameras have, and heads lack.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Feature {
    Number,
    Ending,
    Folder,
    Digit,
}

fn has(feature: Feature, label: &str) -> bool {
    match feature {
        Feature::Number => super::fields::is_number(label.as_bytes()),
        Feature::Ending => has_ending(label),
        Feature::Folder => label.contains(['/', '\\']),
        Feature::Digit => label.bytes().any(|b| b.is_ascii_digit()),
    }
}

/// Whether a name ends like that of a file: a point and two to four letters or digits, a letter first.
pub(super) fn has_ending(label: &str) -> bool {
    let Some((stem, ending)) = label.rsplit_once('.') else {
        return false;
    };
    let bytes = ending.as_bytes();
    !stem.is_empty()
        && (2..=4).contains(&bytes.len())
        && bytes[0].is_ascii_alphabetic()
        && bytes.iter().all(u8::is_ascii_alphanumeric)
}

/// Whether two labels of a first line, which are those of no other line, are names of columns by what
/// stands below: nothing there looks like them, and it hangs together.
pub(super) fn stand_apart<'a>(
    labels: [&str; 2],
    mut others: impl Iterator<Item = &'a str>,
    hangs_together: impl FnOnce() -> bool,
) -> bool {
    let shapes = labels.map(shape);
    let letters = labels.iter().all(|label| label.chars().count() == 1);
    let like =
        |other: &str| shapes.contains(&shape(other)) || letters && other.chars().count() == 1;
    could_be_pair(labels[0], labels[1]) && !others.any(like) && hangs_together()
}

/// Whether two labels of a first line look unlike all others, so that they name columns. `columns`
/// are the labels below each.
pub(super) fn look_unlike<'a, I>(labels: [&str; 2], columns: [I; 2]) -> bool
where
    I: Iterator<Item = &'a str> + Clone,
{
    let [first, second] = labels;
    let (named, perhaps) = (is_pair(first, second), may_be_pair(first, second));
    if columns.iter().all(|column| column.clone().next().is_none()) {
        return named;
    }
    let shapes = labels.map(shape);
    let alike = |column: &I| column.clone().any(|other| shapes.contains(&shape(other)));
    // The marks of `img1` and `img2` are none of the names.
    let stems = labels.map(|label| {
        if perhaps {
            label.trim_end_matches(['0', '1', '2'])
        } else {
            label
        }
    });
    let clear = [Feature::Number, Feature::Ending, Feature::Folder];
    let lacks = |at: usize, feature: Feature| {
        !has(feature, stems[at]) && columns[at].clone().all(|other| has(feature, other))
    };
    let mut clearly = [0, 1].map(|at| clear.iter().any(|&feature| lacks(at, feature)));
    // One column of several lines is enough, if the other name is no name of a camera either.
    let names = !labels
        .iter()
        .any(|label| clear.iter().any(|&feature| has(feature, label)));
    if names && columns[0].clone().nth(1).is_some() && clearly.contains(&true) {
        clearly = [true; 2];
    }
    if clearly == [true; 2] {
        return true;
    }
    // Rooms without and with numbers are rooms.
    let words = perhaps && (0..2).all(|at| lacks(at, Feature::Digit));
    (named || words) && !columns.iter().any(alike)
}

/// A label with every run of digits replaced.
pub(super) fn shape(label: &str) -> String {
    let mut shape = String::new();
    for c in label.chars() {
        match c.is_ascii_digit() {
            true if shape.ends_with('0') => {}
            true => shape.push('0'),
            false => shape.push(c),
        }
    }
    shape
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_columns() {
        for [a, b] in [
            ["source", "Target"],
            ["img1", "img2"],
            ["Image_ID1", "IMAGE_ID2"],
            ["ImageA", "ImageB"],
            ["left_img", "right_img"],
            ["photo", "neighbour"],
            ["image_name1", "image_name2"],
            ["id1", "id2"],
            ["node_1", "node_2"],
            ["Image 1", "Image 2"],
            ["name_a", "name_b"],
            ["#query_image", "map_image"],
            ["first_image", "second_image"],
            ["imageA_path", "imageB_path"],
            ["view_id_a", "view_id_b"],
            [":START_ID", ":END_ID"],
            ["image_gauche", "image_droite"],
        ] {
            assert!(is_pair(a, b), "{a} {b}");
        }
        for [a, b] in [
            ["image", "width"],
            ["x1", "x2"],
            ["a.jpg", "b.jpg"],
            ["image", "image"],
            ["img2", "img1"],
            ["target", "label"],
        ] {
            assert!(!is_pair(a, b), "{a} {b}");
        }
        assert_eq!(
            pair_among(&["id", "source", "w", "target"], false),
            Some([1, 3])
        );
        assert_eq!(pair_among(&["image", "width", "height"], true), None);
        assert!(is_no_camera("Latitude [deg]") && !is_no_camera("image"));
    }

    #[test]
    fn looks() {
        let unlike = |labels, others: &[&str; 2]| {
            look_unlike(
                labels,
                [&others[..1], &others[1..]].map(|column| column.iter().copied()),
            )
        };
        assert!(unlike(["name", "degree"], &["a.jpg", "3"]));
        assert!(!unlike(["foo", "class"], &["a.jpg", "day"]));
        assert!(!unlike(["hub", "a.jpg"], &["b.jpg", "c.jpg"]));
        let images = ["a.jpg", "b.jpg"].iter().copied();
        let words = ["day", "night"].iter().copied();
        assert!(look_unlike(["foo", "class"], [images, words]));
        assert!(unlike(["img1", "img2"], &["a.jpg", "b.jpg"]));
        assert!(unlike(["foo", "bar"], &["a.jpg", "b.jpg"]));
        assert!(unlike(["i", "j"], &["1", "2"]));
        assert!(unlike(["photo", "neighbour"], &["alice", "bob"]));
        assert!(unlike(["query", "db"], &["q1", "d2"]));
        for [a, b, c, d] in [
            ["node1", "node2", "node3", "node4"],
            ["image1", "image2", "image3", "extra"],
            ["hall", "kitchen", "room1", "room2"],
            ["foo", "bar", "alice", "bob"],
            ["a", "b", "c", "d"],
            ["left", "right", "top", "bottom"],
        ] {
            assert!(!unlike([a, b], &[c, d]), "{a} {b}");
        }
    }

    #[test]
    fn names_of_columns_stand_apart() {
        let apart =
            |labels, others: &[&str], hangs| stand_apart(labels, others.iter().copied(), || hangs);
        for labels in [
            ["V1", "V2"],
            ["A", "B"],
            ["u", "v"],
            ["name0", "name1"],
            ["start", "end"],
        ] {
            assert!(apart(labels, &["alpha", "beta"], true), "{labels:?}");
            assert!(!apart(labels, &["alpha", "beta"], false), "{labels:?}");
        }
        assert!(!apart(["a", "b"], &["c", "d"], true));
        assert!(!apart(["node1", "node2"], &["node3", "hub"], true));
        assert!(!apart(["hall", "kitchen"], &["roof", "cellar"], true));
    }
}
