//! What mappers will probably do, on the first lines of the overview.
//!
//! In: a simulation ([`Foreseen`]), which no verdict depends on. Out: a line or two for each mapper.

use super::counted;
use std::io::{self, Write};
use viewcert_advice::mapper::{Beginning, Foreseen, Models, Sees, Thresholds};

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

/// "one model of 15 of 16 images, all determined if every pair is right".
fn global(foreseen: &Foreseen, condition: &str) -> String {
    let global = &foreseen.global;
    let size = global.images.len();
    if size == 0 {
        return "no model: no image sees a track that counts".to_owned();
    }
    let images = all_of(size, global.of) + &in_frames(global.frames);
    let whole = global.parts.iter().any(|part| part.len() == size);
    if whole {
        return format!("one model of {images}, all determined {condition}");
    }
    let sizes: Vec<usize> = global.parts.iter().map(Vec::len).collect();
    match sizes.len() {
        0 => format!("one model of {images}, and the tracks determine no two of them"),
        1 => format!(
            "one model of {images}, of which the tracks determine {} {condition}",
            sizes[0]
        ),
        count => format!(
            "one model of {images}, in which {count} parts ({}) are not determined against each \
             other: they may be silently misplaced",
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
        None => "(simulated, not proved)".to_owned(),
        Some(unfit) => format!(
            "(simulated, not proved; uncertain, as {unfit} of {} pairs to begin with are unfit)",
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
