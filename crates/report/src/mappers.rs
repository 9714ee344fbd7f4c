//! What mappers will probably do, on the first lines of the overview.
//!
//! In: a simulation ([`Foreseen`]), which no verdict depends on. Out: a line or two for each mapper.

use super::counted;
use serde::Serialize;
use std::io::{self, Write};
use viewcert_advice::mapper::{Beginning, Foreseen, GlobalModel, Models, Sees, Thresholds};

/// How many models, and how many pairs to begin with, are shown.
const SHOWN: usize = 8;
const BEGINNINGS: usize = 3;

/// Writes what each mapper will do; what is said to be determined is so under `condition`. `wrapped` takes a
/// title and words.
///
/// # Errors
/// Those of the writer.
pub(crate) fn write<W: Write>(
    out: &mut W,
    foreseen: &Foreseen,
    condition: &str,
    wrapped: impl Fn(&mut W, &str, &str) -> io::Result<()>,
) -> io::Result<()> {
    wrapped(out, "global", &global(foreseen, condition))?;
    wrapped(out, "incremental", &incremental(foreseen))?;
    let models = &foreseen.incremental;
    if models.refused {
        return Ok(());
    }
    if models.models.is_empty() || models.starts.iter().any(|start| start.unfit.is_some()) {
        for words in beginnings(models) {
            wrapped(out, "begins at", &words)?;
        }
    }
    Ok(())
}

/// "one model of 15 of 16 images, all determined if every pair is right (COLMAP 4.2)".
fn global(foreseen: &Foreseen, condition: &str) -> String {
    let of = foreseen.global.of;
    let images = |model: &GlobalModel| all_of(model.images.len(), of) + &in_frames(model.frames);
    let words = match &foreseen.global.models[..] {
        [] => "no model: no three images have a connected part, base lines and a track that counts"
            .to_owned(),
        [model] => format!(
            "one model of {}{}",
            images(model),
            determined(model, condition)
        ),
        models => {
            let sizes: Vec<usize> = models.iter().map(|model| model.images.len()).collect();
            let several = format!(
                "{} models of {} images, one for each connected part",
                models.len(),
                several(&sizes, " + ")
            );
            let is_whole = |model: &GlobalModel| {
                model
                    .parts
                    .iter()
                    .any(|part| part.len() == model.images.len())
            };
            let mut broken = models.iter().filter(|model| !is_whole(model));
            match (broken.next(), broken.count()) {
                (None, _) => several + &determined(&models[0], condition),
                (Some(model), more) => {
                    let of_one = format!(
                        "{several}; in the one of {}{}",
                        images(model),
                        determined(model, condition)
                    );
                    match more {
                        0 => of_one,
                        more => format!("{of_one}; {more} more are broken (--json)"),
                    }
                }
            }
        }
    };
    format!("{words} (COLMAP {})", foreseen.colmap)
}

/// How much of a model the tracks determine, under a condition.
fn determined(model: &GlobalModel, condition: &str) -> String {
    let sizes: Vec<usize> = model.parts.iter().map(Vec::len).collect();
    match sizes[..] {
        [size, ..] if size == model.images.len() => format!(", all determined {condition}"),
        [] => ", and the tracks determine no two of them".to_owned(),
        [size] => format!(", of which the tracks determine {size} {condition}"),
        _ => format!(
            ", in which {} parts ({}) are not determined against each other: they may be silently misplaced",
            sizes.len(),
            several(&sizes, ", ")
        ),
    }
}

/// "likely 8 + 4 + 4, stops at DSC_0434 (sees 17 of the 30 points it needs)".
fn incremental(foreseen: &Foreseen) -> String {
    let models = &foreseen.incremental;
    if models.refused {
        return "no model: it has to know the poses of all sensors in their rigs (map without rigs first, \
                and derive the poses from that model)"
            .to_owned();
    }
    let simulated = match unfit(models) {
        None => format!("(simulated for COLMAP {}, not proved)", foreseen.colmap),
        Some(unfit) => format!(
            "(simulated for COLMAP {}, not proved; uncertain, as {unfit} of {} pairs to begin with are unfit)",
            foreseen.colmap,
            models.starts.len()
        ),
    };
    let sizes: Vec<usize> = models
        .models
        .iter()
        .map(|model| model.images.len())
        .collect();
    let mut words = match sizes[..] {
        [] => return format!("likely no model: no pair is fit to begin with {simulated}"),
        [size] => format!(
            "likely one model of {}{} {simulated}",
            all_of(size, foreseen.global.of),
            in_frames(models.models[0].frames)
        ),
        _ => format!("likely {} images {simulated}", several(&sizes, " + ")),
    };
    if let Some(stop) = stop(models) {
        words += &format!(
            ", stops at {} (sees {} of the {} points it needs)",
            stop.image, stop.sees, stop.needs
        );
    }
    let dropped = models.models.iter().filter(|model| !model.kept).count();
    if dropped > 0 {
        words += &format!(
            "; COLMAP drops {dropped} of them (--Mapper.min_model_size {})",
            models.kept_from
        );
    }
    words
}

/// How many pairs to begin with are unfit by their geometry, if these are nearly all: COLMAP estimates
/// each anew, and what passes then is chance.
fn unfit(models: &Models) -> Option<usize> {
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

/// The pairs that were looked at first, and what disqualifies them.
fn beginnings(models: &Models) -> Vec<String> {
    if models.starts.is_empty() {
        let least = models.thresholds.init_min_num_inliers >> Thresholds::RELAXATIONS;
        return vec![format!("no pair: none has {least} inliers")];
    }
    // Where a model begins nevertheless, one line is enough.
    let shown = if models.models.is_empty() {
        BEGINNINGS
    } else {
        1
    };
    let mut words: Vec<String> = models.starts.iter().take(shown).map(beginning).collect();
    if let (Some(last), more @ 1..) = (words.last_mut(), models.starts.len().saturating_sub(shown))
    {
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

/// A part whose images no pairs with a base line hold together.
#[derive(Serialize)]
pub struct WithoutBaseLine {
    /// The part, from 1.
    pub(crate) part: usize,
    /// The images that such pairs connect, larger groups first.
    pub(crate) groups: Vec<Vec<String>>,
    /// How many pairs lead from one group to another.
    pub(crate) pairs: usize,
    /// Their configurations.
    pub(crate) configurations: Vec<&'static str>,
}

impl WithoutBaseLine {
    /// What that means.
    pub(crate) fn words(&self) -> String {
        let sizes: Vec<usize> = self.groups.iter().map(Vec::len).collect();
        let [pairs, images] =
            [(self.pairs, "pair"), (sizes.iter().sum(), "image")].map(|(n, of)| counted(n, of));
        let configurations = self.configurations.join(", ");
        let part = self.part;
        let (between, nothing) = match sizes[0] {
            1 => (String::new(), "where the cameras are"),
            _ => (
                format!("between groups of {} images ", several(&sizes, " + ")),
                "how the groups lie to each other",
            ),
        };
        format!(
            "part {part}, {images}: {between}no pair has a base line that shows ({pairs}: {configurations}), \
             so none has a fundamental matrix, and nothing says {nothing}"
        )
    }
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

fn several(sizes: &[usize], between: &str) -> String {
    let mut shown: Vec<String> = sizes.iter().take(SHOWN).map(usize::to_string).collect();
    if sizes.len() > SHOWN {
        shown.push(format!("{} more", sizes.len() - SHOWN));
    }
    shown.join(between)
}
