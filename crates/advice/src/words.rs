//! What was found, in words.

use crate::named::Names;
use crate::{How, Near, Reason, Why};
use viewcert::Model;
use viewcert::wording::counted;

/// How two components touch; the first `cameras` nodes of a camera-point graph are cameras.
pub(crate) fn how(how: &How, cameras: Option<u32>) -> String {
    let mut words = Vec::new();
    match (how.shared, cameras) {
        (Some(_), None) => words.push("a shared image".to_owned()),
        (Some(v), Some(c)) if v < c => words.push("a shared camera".to_owned()),
        (Some(_), Some(_)) => words.push("a shared point".to_owned()),
        (None, _) => {}
    }
    // Two cameras are no observation, but images of a frame.
    let is_frame = |&&(a, b): &&(u32, u32)| cameras.is_some_and(|c| a < c && b < c);
    let frames = how.pairs.iter().filter(is_frame).count();
    match (how.pairs.len() - frames, cameras) {
        (0, _) => {}
        (1, None) => words.push("one pair".to_owned()),
        (n, None) => words.push(format!("{n} pairs of different images")),
        (n, Some(_)) => words.push(counted(n, "observation")),
    }
    if frames > 0 {
        words.push(counted(frames, "frame"));
    }
    let through = how.through.iter();
    let points = cameras.map_or(0, |c| through.filter(|by| by[1] >= c).count());
    if points > 0 {
        words.push(counted(points, "track"));
    }
    let others = how.through.len() - points;
    if others > 0 {
        let thing = if cameras.is_some() { "camera" } else { "image" };
        words.push(format!("{} with a pair to each", counted(others, thing)));
    }
    words.join(" and ")
}

/// What is known of scales where two components touch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Scales {
    /// Nothing, or that of one of the two.
    Free,
    /// Those of both, by the base lines in them.
    Both,
    /// Both would follow from a base line between the two.
    Between,
}

/// What a joint leaves free.
pub(crate) fn meaning(model: Model, freedom: usize, scales: Scales) -> String {
    match (model, freedom) {
        (Model::Calibrated, _) if scales == Scales::Both => counted(freedom, "translation"),
        (Model::Calibrated, 1) if scales == Scales::Between => "one scale".to_owned(),
        (Model::Calibrated, 2) if scales == Scales::Between => "the scale of each".to_owned(),
        (Model::Calibrated, _) if scales == Scales::Between => {
            format!("{freedom} degrees of freedom of scales and translations")
        }
        (Model::Calibrated, 1) => "relative scale".to_owned(),
        (Model::Calibrated, 2) => "relative scale and one translation".to_owned(),
        (Model::Calibrated, 3) => "relative scale and two translations".to_owned(),
        (Model::Calibrated, _) => format!("{freedom} of 4 degrees of freedom"),
        (Model::Affine, _) => {
            format!("{freedom} of the 12 degrees of freedom between two affine frames")
        }
        (Model::Projective, _) => {
            format!("{freedom} of the 15 degrees of freedom between two projective frames")
        }
    }
}

/// Why two images are worth matching.
pub(crate) fn reason(reason: Reason, names: &Names) -> String {
    match reason {
        Reason::Near(Near::Name(1)) => "next to each other by name".to_owned(),
        Reason::Near(Near::Name(steps)) => format!("{steps} apart by name"),
        Reason::Near(Near::Twin(0)) => "the same number in two sequences of names".to_owned(),
        Reason::Near(Near::Twin(steps)) => {
            format!("numbers {steps} apart in two sequences of names")
        }
        Reason::Near(Near::Position(1)) => "nearest by position".to_owned(),
        Reason::Near(Near::Position(rank)) => format!("number {rank} of the nearest by position"),
        Reason::Common(third) => format!("both match {}", names.of(third)),
        Reason::Beside(a, b) => format!("beside {} and {}", names.of(a), names.of(b)),
        Reason::Any => "a guess: nothing speaks for these two".to_owned(),
    }
}

/// Why something is weak.
pub(crate) fn why(why: Why, names: &Names) -> String {
    match why {
        Why::Hangs(image) => {
            format!("{} would have one {} left", names.of(image), names.edge())
        }
        Why::Decided => "decided without it".to_owned(),
        Why::Counted((a, b)) => {
            format!("in the place of {} {} in a count", names.of(a), names.of(b))
        }
    }
}
