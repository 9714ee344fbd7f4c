//! The commands that lead on from an overview.

use crate::overview::{Next, Overview};
use std::path::Path;
use viewcert_advice::export::shell;
use viewcert_formats::{ReadOptions, TrackOptions};

/// Commands that lead on from here, about a file that was read in this way.
pub fn next(options: &ReadOptions, path: &Path, found: &Overview) -> Vec<Next> {
    let with_tracks = found.tracks.is_some();
    let (graph, tracks) = match options.tracks {
        Some(tracks) if with_tracks => (" --tracks", words_of_tracks(tracks)),
        _ => (" --model calibrated", String::new()),
    };
    let read = options_of(options);
    let file = shell(&path.display().to_string());
    let command = |verb: &str, graph: &str, what: &str, purpose: &'static str| Next {
        command: format!("verify {verb} {file}{graph}{read}{what}"),
        purpose,
    };
    let advise = |graph: &str, what: &str, purpose| command("advise", graph, what, purpose);
    let decided = format!("{graph}{tracks}");
    // What tracks hang on does not tell kept promises from broken ones.
    let few = "pairs without which parts fall apart";
    let weak = (!with_tracks).then(|| advise(&decided, " --weak", few));
    if found.determined() {
        return Vec::from_iter(weak);
    }
    let mut next = Vec::new();
    if found.facts().is_some_and(|facts| facts.pairs_used == 0) {
        return found
            .weak_pairs()
            .map_or_else(Vec::new, |enough| weaker(&file, enough, options).into());
    }
    // These are about one graph, and a path may hold several.
    let single = found.name == path.display().to_string();
    if single && found.has_parts() && !found.is_one_part() {
        next.push(command(
            "export",
            &format!(" DIR{decided}"),
            "",
            "the images of every part, as lists for the mappers",
        ));
    }
    if found.has_suggestions() {
        next.push(advise(
            &decided,
            " --suggest",
            if with_tracks {
                "images to match that would join parts, and how much has to come of it"
            } else {
                "pairs to match that would join parts"
            },
        ));
    }
    let untried = found.has_suggestions() || found.is_one_part();
    if untried && with_tracks && found.averaging().is_some_and(|parts| !parts.whole) {
        next.push(advise(
            " --model calibrated",
            " --suggest",
            "pairs to match that would join parts of the pairs",
        ));
    }
    if let Some(image) = found.outside().filter(|_| single) {
        next.push(advise(
            &decided,
            &format!(" --explain {}", shell(&image)),
            "an image outside the largest part, and what it would need",
        ));
    }
    next.extend(weak);
    next
}

/// What to do where no pair has the inliers that are asked for, and so many would be enough.
fn weaker(file: &str, enough: u32, options: &ReadOptions) -> [Next; 2] {
    let weaker = ReadOptions {
        min_inliers: Some(enough),
        ..options.clone()
    };
    [
        Next {
            command: format!("verify overview {file}{}", options_of(&weaker)),
            purpose: "the same, with pairs of so few inliers",
        },
        Next {
            command: format!(
                "colmap global_mapper --database_path {file} --image_path images --output_path sparse \
                 --GlobalMapper.min_num_matches {enough}"
            ),
            purpose: "global mapping with such pairs; incremental mapping asks for more points besides",
        },
    ]
}

/// The options that say which tracks count, as they are written.
fn words_of_tracks(read: TrackOptions) -> String {
    let (default, mut text) = (TrackOptions::default(), String::new());
    if read.min_views != default.min_views {
        text += &format!(" --min-views {}", read.min_views);
    }
    if read.max_spread != default.max_spread {
        text += &format!(" --max-spread {}", read.max_spread);
    }
    if !read.rigs {
        text += " --no-rigs";
    }
    text
}

/// The options by which graphs were read, as they are written.
fn options_of(read: &ReadOptions) -> String {
    let mut text = String::new();
    if let Some(format) = read.format {
        text += &format!(" --format {format}");
    }
    if let Some(variable) = &read.variable {
        text += &format!(" --variable {}", shell(variable));
    }
    if let Some(pipeline) = read.pipeline {
        text += &format!(" --pipeline {pipeline}");
    }
    if let Some(count) = read.min_inliers {
        text += &format!(" --min-inliers {count}");
    }
    let list = &read.list;
    if let Some(columns) = &list.columns {
        text += &format!(" --columns {}", shell(&columns.to_string()));
    }
    if let Some(least) = &list.min_weight {
        text += &format!(" --min-weight {least}");
    }
    if list.skip_loops {
        text += " --skip-loops";
    }
    text
}
