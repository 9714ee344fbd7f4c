//! Lists of feature matches as COLMAP imports them (`matches_importer`, types `raw` and `inliers`):
//! blocks of a line with the names of two images and lines with the numbers of two features.
//!
//! A blank line ends a block; lists that lack them are read too. A pair of images is an edge if it
//! has a match.

use crate::documents::collected::Collected;
use crate::edge_list::columns::ListOptions;
use crate::edge_list::fields::integer;
use crate::edge_list::names::is_image;
use crate::error::{Fault, Place};
use crate::read_as::Parsed;
use viewcert::wording::counted;

/// A line of such a list.
enum Line<'a> {
    Blank,
    Names([&'a str; 2]),
    Match,
}

fn line(text: &str) -> Option<Line<'_>> {
    let mut words = text.split_ascii_whitespace();
    let (first, second) = (words.next(), words.next());
    match (first, second, words.next()) {
        (None, ..) => Some(Line::Blank),
        (Some(a), Some(b), None) => match (integer(a), integer(b)) {
            (Some(_), Some(_)) => Some(Line::Match),
            (None, None) => Some(Line::Names([a, b])),
            _ => None,
        },
        _ => None,
    }
}

/// Whether a text that begins like this has both kinds of lines and nothing else, begins with names, and
/// is sure to be such a list: all names are those of images, or every block but the last ends with a blank
/// line and none has one within.
pub(super) fn is_raw(head: &str, whole: bool) -> bool {
    let end = if whole {
        Some(head.len())
    } else {
        head.rfind('\n')
    };
    let (mut names, mut matches) = (0, 0);
    let (mut images, mut blocks, mut after_blank) = (true, true, true);
    for text in head[..end.unwrap_or(0)].lines() {
        match line(text) {
            None => return false,
            Some(Line::Blank) => after_blank = true,
            Some(Line::Names([a, b])) => {
                let are_images = is_image(a) && is_image(b);
                // A single pair above integers is a head, unless it is one of images.
                names += 1 + usize::from(are_images);
                images &= are_images;
                blocks &= std::mem::take(&mut after_blank);
            }
            Some(Line::Match) if names == 0 => return false,
            Some(Line::Match) => {
                matches += 1;
                blocks &= !after_blank;
            }
        }
    }
    names > 1 && matches > 0 && (images || blocks)
}

/// Reads the pairs of images with a match, or with as many as are asked for.
pub(super) fn read(text: &str, options: &ListOptions) -> Result<Parsed, Fault> {
    let mut blocks: Vec<(u64, [&str; 2], u64)> = Vec::new();
    for (text, number) in text.lines().zip(1..) {
        let wrong = |what| Place::Line(number).fault(super::malformed("raw matches", what));
        match line(text) {
            Some(Line::Blank) => {}
            Some(Line::Names(names)) => blocks.push((number, names, 0)),
            Some(Line::Match) => match blocks.last_mut() {
                Some((.., matches)) => *matches += 1,
                None => return Err(wrong("a match stands before the first two names")),
            },
            None => return Err(wrong("a line has two names or the numbers of two features")),
        }
    }
    let mut collected = Collected::new(options);
    let (mut without, mut light, mut all) = (0, 0, 0);
    for (number, [a, b], matches) in blocks {
        let fault = |problem| Place::Line(number).fault(problem);
        all += matches;
        if matches == 0 {
            without += 1;
        } else if options.weighs_less(matches) {
            light += 1;
        } else {
            let ends = collected.node(a).and_then(|a| Ok((a, collected.node(b)?)));
            let pair = ends.and_then(|(a, b)| collected.pair(a, b));
            pair.map_err(fault)?;
        }
    }
    let mut parsed = collected.finish()?;
    let matches = if all == 1 { "match" } else { "matches" };
    parsed.read.taken = Some(format!("one pair per block, {all} {matches} of features"));
    if without > 0 {
        let pairs = counted(without, "pair");
        parsed.read.ignored.push(format!("{pairs} without matches"));
        let note = format!("{pairs} without matches: no edges");
        parsed.notes.push(note);
    }
    if let Some(least) = options.min_weight.as_ref().filter(|_| light > 0) {
        let pairs = counted(light, "pair");
        let few = format!("{pairs} of fewer than {least} matches");
        parsed.read.ignored.push(few);
    }
    Ok(parsed)
}
