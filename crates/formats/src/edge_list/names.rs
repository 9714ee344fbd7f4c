//! What columns and images are called.

/// Names of two columns with the ends of a pair, as [`plain`] writes them.
const PAIRS: &str = "source-target src-dst src-tgt from-to sourceid-targetid sourcenode-targetnode fromid-toid \
                     fromnode-tonode fromnodeid-tonodeid startid-endid queryimage-mapimage query-reference \
                     query-db i-j image-neighbour photo-neighbour";

/// Words for an image or a node: with two marks they name the ends of a pair, as `image1,image2`.
const WORDS: &str = "image img im imageid imgid imagename imgname imagepath photo picture view viewid node nodeid \
                     vertex camera cam cameraid camid frame frameid keyframe";

/// The marks.
const MARKS: [[&str; 2]; 6] = [
    ["1", "2"],
    ["0", "1"],
    ["a", "b"],
    ["i", "j"],
    ["left", "right"],
    ["first", "second"],
];

/// Names of columns with weights.
const WEIGHTS: &str = "weight weights score matches nummatches nmatches inliers numinliers ninliers count overlap \
                       similarity";

/// Endings of the names of images.
const IMAGES: &str = "jpg jpeg png tif tiff bmp ppm pgm webp heic dng exr";

/// Whether a word is among others.
fn is_among(word: &str, words: &str) -> bool {
    words.split(' ').any(|one| one.eq_ignore_ascii_case(word))
}

/// A name of a column without what people write differently.
fn plain(name: &str) -> String {
    let kept = name.chars().filter(|c| !" _-.#:\t".contains(*c));
    kept.flat_map(char::to_lowercase).collect()
}

/// The word that two names have around two marks.
fn word(first: &str, second: &str) -> Option<String> {
    let without = |[one, two]: [&str; 2]| {
        first.match_indices(one).find_map(|(at, _)| {
            let (start, end) = (&first[..at], &first[at + one.len()..]);
            let other = second.strip_prefix(start)?.strip_prefix(two)?;
            (other == end).then(|| format!("{start}{end}"))
        })
    };
    MARKS.into_iter().find_map(without)
}

/// Whether these name two columns with the ends of pairs.
pub(super) fn is_pair(first: &str, second: &str) -> bool {
    let [first, second] = [first, second].map(plain);
    is_among(&format!("{first}-{second}"), PAIRS)
        || word(&first, &second).is_some_and(|word| is_among(&word, WORDS))
}

/// Whether a name of a pair says nothing of images or nodes: files are copied from a source to a target.
pub(super) fn is_general(first: &str) -> bool {
    ["source", "src", "from", "i"].contains(&&*plain(first))
}

/// All two columns whose names are those of a pair.
pub(super) fn pairs_among<S: AsRef<str>>(names: &[S]) -> Vec<[usize; 2]> {
    // Wider tables are none that people make lists of pairs in.
    const MOST: usize = 64;
    let columns = 0..names.len().min(MOST);
    let pairs = columns
        .clone()
        .flat_map(|first| columns.clone().map(move |second| [first, second]));
    pairs
        .filter(|&[first, second]| is_pair(names[first].as_ref(), names[second].as_ref()))
        .collect()
}

/// Whether a column of this name holds weights.
pub(super) fn is_weight(name: &str) -> bool {
    is_among(&plain(name), WEIGHTS)
}

/// Whether a label ends like the name of an image.
pub(crate) fn is_image(label: &str) -> bool {
    label
        .rsplit_once('.')
        .is_some_and(|(_, ending)| is_among(ending, IMAGES))
}

/// A label with every run of digits replaced by one, and a single letter by another.
pub(super) fn shape(label: &str) -> String {
    let mut shape = String::new();
    for c in label.chars() {
        match c.is_ascii_digit() {
            true if shape.ends_with('0') => {}
            true => shape.push('0'),
            false => shape.push(c),
        }
    }
    match shape.len() {
        1 => "x".to_owned(),
        _ => shape,
    }
}

/// Whether two names of images are in one folder and end alike.
pub(super) fn are_alike(first: &str, second: &str) -> bool {
    let folder_and_ending = |path: &'_ str| {
        let (folder, file) = path.rsplit_once(['/', '\\']).unwrap_or(("", path));
        [
            folder,
            file.rsplit_once('.').map_or("", |(_, ending)| ending),
        ]
        .map(str::to_owned)
    };
    folder_and_ending(first) == folder_and_ending(second)
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
            ["node_1", "node_2"],
            ["Image 1", "Image 2"],
            ["#query_image", "map_image"],
            ["view_id_a", "view_id_b"],
            [":START_ID", ":END_ID"],
        ] {
            assert!(is_pair(a, b), "{a} {b}");
        }
        for [a, b] in [
            ["image", "width"],
            ["camera", "point"],
            ["image_id", "track_id"],
            ["x1", "x2"],
            ["u", "v"],
            ["0", "1"],
            ["a.jpg", "b.jpg"],
            ["img2", "img1"],
            ["target", "source"],
        ] {
            assert!(!is_pair(a, b), "{a} {b}");
        }
        assert_eq!(pairs_among(&["id", "source", "w", "target"]), [[1, 3]]);
        let several = ["image1", "image2", "source", "target"];
        assert_eq!(pairs_among(&several).len(), 2);
    }

    #[test]
    fn names_of_images() {
        assert!(is_image("a/b.JPG") && !is_image("jpg") && !is_image("a.txt"));
        assert!(are_alike("a/l.png", "a/r.png") && !are_alike("a/l.png", "b/r.png"));
        assert_eq!(shape("cam12_3"), "cam0_0");
        assert_eq!(shape("a"), shape("b"));
    }
}
