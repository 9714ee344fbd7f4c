//! Whether pairs that have the form of an edge list can be pairs of cameras at all.
//!
//! In: the pairs in the order of the lines, first column first, and what the labels are. Out: why
//! they are none, or what is odd about them. What is looked at ends at the first line that speaks
//! for pairs, so a list of integers costs next to nothing.

use crate::edge_list::fields::is_number;
use crate::edge_list::is_image;
use crate::edge_list::nodes::Index;
use crate::error::Problem;
use viewcert::graph::Graph;

const ADVICE: &str = "write one pair a line: the names of two cameras; if other columns hold the pairs, name them \
     with --columns";

const DERIVED: &str = "on every line one name is the other with an addition, another ending or a folder \
     of masks: a table of copies, and no list of pairs";
const DERIVED_ADVICE: &str =
    "write the pairs of images that match; if these are pairs, say `--format edges`";

/// Words in the names of folders that hold something else for every image.
const BESIDE_IMAGES: [&str; 7] = ["mask", "depth", "label", "segm", "annot", "normal", "flow"];

/// Fewer lines say little about a column.
const FEW: usize = 3;

/// What a column holds.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Number,
    /// A date or a time of day.
    Time,
    Image,
    Other,
}

impl Kind {
    fn of(label: &str) -> Self {
        match () {
            () if is_number(label.as_bytes()) => Self::Number,
            () if is_time(label) => Self::Time,
            () if is_image(label) => Self::Image,
            () => Self::Other,
        }
    }
}

/// What is wrong with the pairs, if they are none.
pub(super) fn problem(pairs: &[(u32, u32)], names: Option<&Index>) -> Option<Problem> {
    let doubt = |what| {
        Some(Problem::Doubtful {
            what,
            advice: ADVICE,
        })
    };
    let first = *pairs.first()?;
    if pairs.len() >= FEW && pairs.iter().all(|&pair| pair == first) {
        return doubt("all lines have the same two fields: a table, and no list of pairs");
    }
    match names {
        Some(names) if are_derived(pairs, names) => Some(Problem::Doubtful {
            what: DERIVED,
            advice: DERIVED_ADVICE,
        }),
        Some(names) => unlike_columns(pairs, names).and_then(doubt),
        None if is_index(pairs) => doubt(
            "the first column counts the lines, and the second has other numbers: a table, and no list of \
             pairs",
        ),
        None => None,
    }
}

/// What tells that the two columns are not of the same kind, if they have no label in common.
fn unlike_columns(pairs: &[(u32, u32)], names: &Index) -> Option<&'static str> {
    // Most lists begin with a pair of one kind, and then nothing below can hold.
    let of = |node| names.nodes.iter().find(|(_, at)| **at == node);
    let [first, second] =
        [pairs[0].0, pairs[0].1].map(|node| of(node).map(|(label, _)| Kind::of(label)));
    if first == second && first != Some(Kind::Time) {
        return None;
    }
    let mut kinds = vec![Kind::Other; names.nodes.len()];
    for (label, &node) in &names.nodes {
        kinds[node as usize] = Kind::of(label);
    }
    let kind = |node: u32| kinds[node as usize];
    let (first, second) = (kind(pairs[0].0), kind(pairs[0].1));
    let all_first = |is| pairs.iter().all(|pair| kind(pair.0) == is);
    let all_second = |is| pairs.iter().all(|pair| kind(pair.1) == is);
    let none_first = |is| pairs.iter().all(|pair| kind(pair.0) != is);
    let none_second = |is| pairs.iter().all(|pair| kind(pair.1) != is);
    let number = Kind::Number;
    if first == number && second != number && all_first(number) && !all_second(number)
        || second == number && first != number && all_second(number) && !all_first(number)
    {
        let disjoint = none_first(number) || none_second(number) || !shared(pairs, kinds.len());
        return disjoint.then_some(
            "one of the first two columns holds numbers only, and the two have no name in common: a table, \
             and no list of pairs",
        );
    }
    if all_first(Kind::Time) || all_second(Kind::Time) {
        return Some(
            "one of the first two columns holds dates or times: a table, and no list of pairs",
        );
    }
    let image = Kind::Image;
    (all_first(image) && none_second(image) || all_second(image) && none_first(image)).then_some(
        "one of the first two columns holds names of images, and the other none: a table, and no list of \
         pairs",
    )
}

/// Whether no image is in two pairs, and on every line one name is made of the other in one way.
fn are_derived(pairs: &[(u32, u32)], names: &Index) -> bool {
    if pairs.len() < FEW || names.nodes.len() != 2 * pairs.len() {
        return false;
    }
    let mut labels = vec![""; names.nodes.len()];
    for (label, &node) in &names.nodes {
        labels[node as usize] = label;
    }
    let all = |first: fn(&(u32, u32)) -> u32, second: fn(&(u32, u32)) -> u32| {
        let made = |pair| made_of(labels[first(pair) as usize], labels[second(pair) as usize]);
        let way = made(&pairs[0]);
        way.is_some() && pairs.iter().all(|pair| made(pair) == way)
    };
    all(|pair| pair.0, |pair| pair.1) || all(|pair| pair.1, |pair| pair.0)
}

/// How the second name of an image is made of the first one, if it is.
#[derive(PartialEq, Eq)]
enum Made<'a> {
    /// By this behind its stem.
    Added(&'a str),
    /// By another ending.
    Ending(&'a str),
    /// By a folder for something else.
    Folder,
}

fn made_of<'a>(first: &'a str, second: &'a str) -> Option<Made<'a>> {
    let [
        (folder, stem, ending),
        (other_folder, other_stem, other_ending),
    ] = [first, second].map(parts);
    if !is_image(first) || !is_image(second) {
        return None;
    }
    if stem == other_stem {
        let beside = |folder: &str| {
            let folder = folder.to_ascii_lowercase();
            BESIDE_IMAGES.iter().any(|word| folder.contains(word))
        };
        return match () {
            () if beside(other_folder) && !beside(folder) => Some(Made::Folder),
            () if !ending.eq_ignore_ascii_case(other_ending) => Some(Made::Ending(other_ending)),
            () => None,
        };
    }
    let added = other_stem.strip_prefix(stem)?;
    let is_word = !added.starts_with(|c: char| c.is_alphanumeric())
        && added.contains(|c: char| c.is_alphabetic())
        && !added.contains(|c: char| c.is_ascii_digit());
    is_word.then_some(Made::Added(added))
}

/// The folder, the stem and the ending of a name.
fn parts(name: &str) -> (&str, &str, &str) {
    let (folder, file) = name.rsplit_once(['/', '\\']).unwrap_or(("", name));
    let (stem, ending) = file.rsplit_once('.').unwrap_or((file, ""));
    (folder, stem, ending)
}

/// Whether this is a date like 2011-09-26 or a time like 13:02:25.5.
fn is_time(label: &str) -> bool {
    let digits = |text: &&str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    let parts = |mark| -> Vec<&str> { label.split(mark).collect() };
    match (&parts('-')[..], &parts(':')[..]) {
        ([year, month, day], _) => year.len() == 4 && [year, month, day].into_iter().all(digits),
        (_, [hour, minute, second]) => {
            digits(hour) && digits(minute) && is_number(second.as_bytes())
        }
        _ => false,
    }
}

/// Whether some label stands in both columns.
fn shared(pairs: &[(u32, u32)], nodes: usize) -> bool {
    let mut first = vec![false; nodes];
    for pair in pairs {
        first[pair.0 as usize] = true;
    }
    pairs.iter().any(|pair| first[pair.1 as usize])
}

/// Whether the first of two integers counts the lines from 0 or 1, and the second is none of these
/// numbers nor goes on with them, as the other side of a bipartite graph or the middle of a star does.
fn is_index(pairs: &[(u32, u32)]) -> bool {
    let start = pairs[0].0;
    let behind = start as usize + pairs.len();
    pairs.len() >= FEW
        && start <= 1
        && pairs
            .iter()
            .zip(start..)
            .all(|(&(a, b), at)| a == at && b as usize > behind)
}

/// What is odd about a graph, in words.
pub(super) fn note(graph: &Graph, has_names: bool) -> Option<String> {
    let (nodes, edges) = (graph.nodes(), graph.edges());
    // A connected graph has a node more than pairs at most.
    if nodes <= edges.len() + 1 {
        return None;
    }
    let mut degree = vec![0u8; nodes];
    for &(a, b) in edges {
        for node in [a, b] {
            degree[node as usize] = degree[node as usize].saturating_add(1);
        }
    }
    let alone = |&&(a, b): &&(u32, u32)| degree[a as usize] == 1 && degree[b as usize] == 1;
    let single = edges.iter().filter(alone).count();
    // Two pairs of numbers are an example of two pairs.
    let few = if has_names { FEW - 1 } else { FEW };
    if single == edges.len() && single >= few {
        return Some(format!(
            "no camera is in two of the {single} pairs: is this a list of pairs?"
        ));
    }
    // Every other component has two nodes at least, or is a camera without pairs.
    let others = components(nodes, edges) - single;
    (single >= FEW && single > others).then(|| {
        format!(
            "{single} of {} connected parts are single pairs: is this a list of pairs?",
            single + others
        )
    })
}

/// What is odd about pairs of integers, or about names, in words: the first column counts the lines and
/// the second goes beyond and does not; or every camera of the second column is in one pair, and none of
/// the first is there. (A single star may well be written so.)
pub(super) fn odd_columns(pairs: &[(u32, u32)], names: Option<&Index>) -> Option<String> {
    let start = pairs.first()?.0;
    let behind = start as usize + pairs.len();
    let counts = || pairs.iter().zip(start..).all(|(pair, at)| pair.0 == at);
    let beyond = |&(_, b): &(u32, u32)| b as usize >= behind;
    if names.is_none()
        && pairs.len() > FEW
        && start <= 1
        && counts()
        && pairs.iter().any(beyond)
        && !pairs.iter().all(beyond)
    {
        return Some("the first column counts the lines: is this a list of pairs?".to_owned());
    }
    let stars = stars(pairs, names?.nodes.len())?;
    (stars > 1 && pairs.len() >= FEW).then(|| {
        "every camera of the second column is in one pair, and none is in the first column: is this a \
         list of pairs?"
            .to_owned()
    })
}

/// Whether three pairs or more have the same first camera.
pub(super) fn is_one_star(pairs: &[(u32, u32)]) -> bool {
    pairs.len() >= FEW && pairs.iter().all(|pair| pair.0 == pairs[0].0)
}

/// How many stars there are, with two pairs or more one of them, if the second column has all leaves.
fn stars(pairs: &[(u32, u32)], nodes: usize) -> Option<usize> {
    let (mut centre, mut leaf) = (vec![false; nodes], vec![false; nodes]);
    let mut count = 0;
    for &(a, b) in pairs {
        if leaf[a as usize] || centre[b as usize] || leaf[b as usize] {
            return None;
        }
        count += usize::from(!centre[a as usize]);
        centre[a as usize] = true;
        leaf[b as usize] = true;
    }
    Some(count).filter(|&count| count < pairs.len())
}

/// How many connected parts a graph has. Nearly linear.
fn components(nodes: usize, pairs: &[(u32, u32)]) -> usize {
    let mut parent: Vec<u32> = (0..nodes as u32).collect();
    fn root(parent: &mut [u32], mut node: u32) -> u32 {
        while parent[node as usize] != node {
            parent[node as usize] = parent[parent[node as usize] as usize];
            node = parent[node as usize];
        }
        node
    }
    let mut parts = nodes;
    for &(a, b) in pairs {
        let (a, b) = (root(&mut parent, a), root(&mut parent, b));
        if a != b {
            parent[a as usize] = b;
            parts -= 1;
        }
    }
    parts
}

/// Whether two pairs or more, of so many nodes in all, are one connected part.
pub(super) fn hang_together(pairs: &[(u32, u32)], nodes: usize) -> bool {
    let mut in_pairs = vec![false; nodes];
    for &(a, b) in pairs {
        in_pairs[a as usize] = true;
        in_pairs[b as usize] = true;
    }
    let alone = in_pairs.iter().filter(|is_in| !**is_in).count();
    pairs.len() > 1 && components(nodes, pairs) == alone + 1
}

#[cfg(test)]
mod tests {
    use crate::edge_list::{Reading, read};

    fn refusal(text: &str) -> Option<String> {
        let found = read(text.as_bytes(), Reading::Strict);
        found.err().map(|fault| fault.in_file("list").to_string())
    }

    #[test]
    fn tables_are_no_pairs() {
        for text in [
            "a.jpg 17\nb.jpg 18\n",
            "17 a.jpg\n",
            "cam0 1 0.5\ncam1 2 0.5\n",
            "a.jpg day\nb.jpg day\nc.jpg night\n",
            "640 480\n640 480\n640 480\n",
            "0 1305\n1 1306\n2 1307\n",
            "1403.5 a.png\n1404.5 b.png\n",
            "2011-09-26 13:02:25.1\n2011-09-26 13:02:25.2\n",
        ] {
            let refusal = refusal(text).unwrap_or_default();
            assert!(
                refusal.contains("a table, and no list of pairs"),
                "{text}: {refusal}"
            );
        }
        for text in [
            // Stars, paths, bipartite graphs, single pairs.
            "hub a\nhub b\nhub c\n",
            "1 0\n2 0\n3 0\n4 0\n",
            "0 4\n1 4\n2 4\n3 4\n",
            "0 1\n1 2\n2 3\n3 4\n",
            "0 3\n1 4\n2 5\n",
            "0 4\n1 5\n2 6\n3 7\n0 5\n",
            "q1.jpg d1.jpg\nq2.jpg d1.jpg\n",
            "a b\nc d\n",
            "1 a\na 2\n2 b\n",
            "640 480\n640 480\n",
        ] {
            assert_eq!(refusal(text), None, "{text}");
        }
    }

    #[test]
    fn copies_and_masks_are_no_pairs() {
        for text in [
            "1.jpg 1_mask.png\n2.jpg 2_mask.png\n3.jpg 3_mask.png\n",
            "1.mask.png 1.png\n2.mask.png 2.png\n3.mask.png 3.png\n",
            "1.CR2.tif 1.CR2.jpg\n2.CR2.tif 2.CR2.jpg\n3.CR2.tif 3.CR2.jpg\n",
            "i/1.png masks/1.png\ni/2.png masks/2.png\ni/3.png masks/3.png\n",
        ] {
            let refusal = refusal(text).unwrap_or_default();
            assert!(refusal.contains("a table of copies"), "{text}: {refusal}");
        }
        for text in [
            // Stereo, numbers that go on, one way a line, one camera in two pairs, two lines.
            "left/1.png right/1.png\nleft/2.png right/2.png\nleft/3.png right/3.png\n",
            "1.jpg 1_2.jpg\n2.jpg 2_2.jpg\n3.jpg 3_2.jpg\n",
            "1.jpg 1_a.jpg\n2.jpg 2_b.jpg\n3.jpg 3_c.jpg\n",
            "1.jpg 1_m.jpg\n2.jpg 2_m.jpg\n3.jpg 3_m.jpg\n3.jpg 1.jpg\n",
            "1.jpg 1_m.jpg\n2.jpg 2_m.jpg\n",
            "c1 c1_m\nc2 c2_m\nc3 c3_m\n",
        ] {
            assert_eq!(refusal(text), None, "{text}");
        }
    }

    #[test]
    fn single_pairs_are_noted() {
        let notes = |text: &str| read(text.as_bytes(), Reading::Strict).unwrap().notes;
        assert_eq!(
            notes("a b\nc d\ne f\n"),
            ["no camera is in two of the 3 pairs: is this a list of pairs?"]
        );
        assert_eq!(
            notes("a b\nc d\ne f\ng h\nh i\n"),
            ["3 of 4 connected parts are single pairs: is this a list of pairs?"]
        );
        assert_eq!(notes("a b\nc d\n").len(), 1);
        assert!(notes("0 1\n2 3\n").is_empty() && notes("a b\n").is_empty());
        assert!(notes("a b\nc d\ne f\ng h\nh i\nj k\nk l\nm n\nn o\n").is_empty());
    }
}
