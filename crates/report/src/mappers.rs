//! What mappers will probably do, in words.
//!
//! In: a simulation ([`Foreseen`]), which no verdict depends on. Out: a sentence for each mapper.

use super::counted;
use crate::shown::several;
use viewcert_advice::mapper::{Beginning, Foreseen, GlobalModel, Models, Sees, Thresholds};

/// How many pairs to begin with are shown.
const BEGINNINGS: usize = 3;

/// Of how many parts the sizes are shown.
const LARGEST: usize = 3;

/// "one model of 15 of 16 images (COLMAP 4.2)".
pub(crate) fn global(foreseen: &Foreseen) -> String {
    let of = foreseen.global.of;
    let images = |model: &GlobalModel| all_of(model.images.len(), of) + &in_frames(model.frames);
    let words = match &foreseen.global.models[..] {
        [] => "no model: no three images are connected and have base lines and a track that counts"
            .to_owned(),
        [model] => format!("one model of {}{}", images(model), apart(model)),
        models => {
            let sizes: Vec<usize> = models.iter().map(|model| model.images.len()).collect();
            let broken = models.iter().find(|model| !apart(model).is_empty());
            let broken =
                broken.map(|model| format!("; the one of {}{}", images(model), apart(model)));
            format!(
                "{} models of {} images{}",
                models.len(),
                several(&sizes, " + "),
                broken.unwrap_or_default()
            )
        }
    };
    format!("{words} (COLMAP {})", foreseen.colmap)
}

/// What of a model the tracks leave apart.
fn apart(model: &GlobalModel) -> String {
    let sizes: Vec<usize> = model.parts.iter().map(Vec::len).collect();
    match sizes[..] {
        [size, ..] if size == model.images.len() => String::new(),
        [] => ", of which the tracks determine no two".to_owned(),
        [size] => format!(", of which the tracks determine {size}"),
        _ => format!(
            "; {} in it may be silently misplaced",
            counted(sizes.len(), "part")
        ),
    }
}

/// "likely 8 + 4 + 4 images, 2 dropped; DSC_0434 sees 17 points, needs 30 (simulated)".
pub(crate) fn incremental(foreseen: &Foreseen) -> String {
    let models = &foreseen.incremental;
    if models.refused {
        return "no model: it needs the poses of all sensors in their rigs; map without rigs first, and derive \
                them from that model"
            .to_owned();
    }
    let simulated = match unfit(models) {
        None => "(simulated)".to_owned(),
        Some(unfit) => format!(
            "(simulated, uncertain: COLMAP can hardly begin with {unfit} of {} pairs)",
            models.starts.len()
        ),
    };
    let made = models.models.iter();
    let sizes: Vec<usize> = made.map(|model| model.images.len()).collect();
    let mut words = match sizes[..] {
        [] => return "likely no model: no pair is fit to begin with (simulated)".to_owned(),
        [size] => {
            let images = all_of(size, foreseen.global.of);
            format!(
                "likely one model of {images}{}",
                in_frames(models.models[0].frames)
            )
        }
        _ => format!("likely {} images", several(&sizes, " + ")),
    };
    let dropped = models.models.iter().filter(|model| !model.kept).count();
    if dropped > 0 {
        words += &format!(", {dropped} dropped");
    }
    if let Some(stop) = stop(models) {
        let Sees { image, sees, needs } = stop;
        words += &format!("; {image} sees {sees} points, needs {needs}");
    }
    format!("{words} {simulated}")
}

/// "6, 6", "3, 3, 3, ..".
pub(crate) fn largest(sizes: &[usize]) -> String {
    let shown = sizes.iter().take(LARGEST).map(usize::to_string);
    let more = (sizes.len() > LARGEST).then(|| "..".to_owned());
    Vec::from_iter(shown.chain(more)).join(", ")
}

/// How many pairs to begin with are unfit by their geometry, if these are nearly all: COLMAP estimates
/// each anew, and what passes then is chance.
pub(crate) fn unfit(models: &Models) -> Option<usize> {
    let unfit = models.starts.iter().filter(|start| start.unfit.is_some());
    let unfit = unfit.count();
    (unfit >= 10 && 10 * unfit >= 9 * models.starts.len()).then_some(unfit)
}

/// The image that the models come nearest to: one that is in none, or else in another.
fn stop(models: &Models) -> Option<&Sees> {
    let outside = models.outside.first().filter(|sees| sees.sees > 0);
    let several = models.models.len() > 1;
    outside.or_else(|| models.models.first().filter(|_| several)?.stop.as_ref())
}

/// Where no model begins, the pairs that were looked at first, and what disqualifies them.
pub(crate) fn beginnings(models: &Models) -> Vec<String> {
    if models.refused || !models.models.is_empty() {
        return Vec::new();
    }
    if models.starts.is_empty() {
        let least = models.thresholds.init_min_num_inliers >> Thresholds::RELAXATIONS;
        return vec![format!("no pair: none has {least} inliers")];
    }
    let first = models.starts.iter().take(BEGINNINGS);
    let mut words: Vec<String> = first.map(beginning).collect();
    let more = models.starts.len().saturating_sub(BEGINNINGS);
    if let (Some(last), 1..) = (words.last_mut(), more) {
        *last += &format!("; {more} more looked at (--json)");
    }
    words
}

fn beginning(start: &Beginning) -> String {
    let [one, other] = &start.images;
    let mut numbers = vec![counted(start.inliers as usize, "inlier")];
    numbers.extend(start.angle.map(|angle| format!("{angle:.1} degrees")));
    numbers.extend(
        start
            .forward
            .map(|forward| format!("{:.0} % forward", 100.0 * forward)),
    );
    let verdict = match start.unfit {
        None => "fit".to_owned(),
        Some("points") => format!(
            "unfit: {} seen by a third image",
            counted(start.points, "point")
        ),
        Some(unfit) => format!("unfit: {unfit}"),
    };
    format!("{one} {other} ({}): {verdict}", numbers.join(", "))
}

/// " (10 frames)", where frames have several images.
fn in_frames(frames: Option<usize>) -> String {
    frames.map_or(String::new(), |count| {
        format!(" ({})", counted(count, "frame"))
    })
}

/// "all 15 images", "15 of 16 images".
pub(crate) fn all_of(size: usize, of: usize) -> String {
    if size == of {
        format!("all {}", counted(of, "image"))
    } else {
        format!("{size} of {}", counted(of, "image"))
    }
}
