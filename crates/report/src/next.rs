//! What to do next about an overview, and what to expect of it.

use crate::mappers::{all_of, unfit};
use crate::overview::{Do, Next, Overview};
use viewcert::wording::counted;
use viewcert_advice::export::{has_global_mapper, shell};
use viewcert_formats::colmap::DatabaseFacts;
use viewcert_formats::{ReadOptions, TrackOptions};

/// A file, and how it was read.
pub struct File<'a> {
    /// Its path.
    pub path: &'a str,
    /// The options of its tracks, or of its pairs.
    pub options: &'a ReadOptions,
    /// Whether it is a model of COLMAP, which `split` takes apart.
    pub is_model: bool,
}

/// The list of pairs to match.
const LIST: &str = "pairs.txt";

/// What to do about a file of which this was found.
pub fn next(file: &File, found: &Overview) -> Next {
    if let (Some(_), Some(model)) = (found.facts(), whole_model(found)) {
        return model;
    }
    match found.facts() {
        None if !found.beside.is_empty() && found.is_one_part() => of_models(file, found),
        Some(facts) if facts.pairs_used == 0 => without_pairs(file, found, facts),
        Some(facts) if facts.images_without_keypoints > 0 && found.no_model().is_some() => Next {
            commands: {
                let (images, why) = (["--image_path", "images"], "extracts features");
                let matched = "matches them, as matches of now name others";
                vec![
                    file.colmap("feature_extractor", &images, why),
                    file.colmap("exhaustive_matcher", &[], matched),
                ]
            },
            expect: "features and matches that belong together; then ask again".to_owned(),
            by_hand: None,
        },
        Some(facts) if 2 * facts.focal_guessed > facts.images => guessed(),
        Some(_) => to_match(file, found).unwrap_or_else(|| map(file, found)),
        None => to_match(file, found).unwrap_or_else(|| of_no_database(file, found)),
    }
}

/// The command that forecasts what mappers make of a database that was read in this way.
pub fn overview_of(path: &str, options: &ReadOptions) -> String {
    let file = File {
        path,
        options,
        is_model: false,
    };
    written(&file.verify("overview", &[], "").command)
}

/// A command as it is typed in a POSIX shell.
pub(crate) fn written(command: &[String]) -> String {
    let words: Vec<String> = command.iter().map(|word| shell(word)).collect();
    words.join(" ")
}

/// A command, and why.
fn doing(words: &[impl ToString], why: &str) -> Do {
    Do {
        command: words.iter().map(ToString::to_string).collect(),
        why: why.into(),
    }
}

impl File<'_> {
    /// A command of ours about the file.
    fn verify(&self, verb: &str, after: &[&str], why: &str) -> Do {
        let words = ["verify", verb, self.path];
        let words = words.iter().chain(after).map(ToString::to_string);
        doing(&Vec::from_iter(words.chain(options_of(self.options))), why)
    }

    /// A command of COLMAP about the database.
    fn colmap(&self, verb: &str, more: &[&str], why: &str) -> Do {
        let words = ["colmap", verb, "--database_path", self.path];
        doing(&[&words[..], more].concat(), why)
    }
}

/// No pair has the inliers that are asked for.
fn without_pairs(file: &File, found: &Overview, facts: &DatabaseFacts) -> Next {
    if let Some(enough) = found.weak_pairs() {
        let count = &*enough.to_string();
        let mapping = ["--image_path", "images", "--output_path", "sparse"];
        let weaker = [&mapping[..], &["--GlobalMapper.min_num_matches", count]].concat();
        let file = File {
            options: &ReadOptions {
                min_inliers: Some(enough),
                ..file.options.clone()
            },
            ..*file
        };
        return Next {
            commands: vec![
                file.verify("overview", &[], "forecasts with such pairs"),
                file.colmap("global_mapper", &weaker, "maps with such pairs"),
            ],
            expect: format!(
                "all that was verified hangs together with {count} inliers, and pairs of so few are often wrong"
            ),
            by_hand: None,
        };
    }
    let all = facts.images * facts.images.saturating_sub(1) / 2;
    match facts.pairs < all {
        true => Next {
            commands: vec![file.colmap("exhaustive_matcher", &[], "matches all pairs")],
            expect: format!(
                "the other {} matched; if none gets {} inliers, photographs overlap too little",
                counted(all - facts.pairs, "pair"),
                facts.min_inliers
            ),
            by_hand: None,
        },
        false => Next {
            by_hand: Some(
                "take photographs that overlap more, or match with other features".into(),
            ),
            expect: "nothing of these matches: every pair was tried".to_owned(),
            commands: Vec::new(),
        },
    }
}

/// Focal lengths are guesses, each for an image of its own.
fn guessed() -> Next {
    let new = ["--database_path", "shared.db"];
    let extract = ["--image_path", "images", "--ImageReader.single_camera", "1"];
    let extract = [&["colmap", "feature_extractor"][..], &new, &extract].concat();
    let matches = [&["colmap", "exhaustive_matcher"][..], &new].concat();
    Next {
        commands: vec![
            doing(&extract, "extracts features with one camera for all images"),
            doing(&matches, "matches them"),
        ],
        expect: "one focal length for all, which mappers find, if one camera took them at one zoom"
            .to_owned(),
        by_hand: None,
    }
}

/// Pairs that are left to match.
fn to_match(file: &File, found: &Overview) -> Option<Next> {
    let suggested = found.joints.suggestions.iter().flatten();
    let open = suggested.filter(|one| !one.open.is_empty());
    let most = open.map(|one| one.images).max()?;
    let mut options = match found.tracks {
        Some(_) => vec!["--tracks"],
        None => vec!["--model", "calibrated"],
    };
    options.extend(["--suggest=30", "--write", LIST]);
    let why = "writes the pairs to match, the most promising first";
    let mut commands = vec![file.verify("advise", &options, why)];
    if found.facts().is_some() {
        let list = ["--match_list_path", LIST];
        commands.push(file.colmap(
            "matches_importer",
            &list,
            "matches and verifies these pairs",
        ));
    }
    let of = found.wanted.of;
    let parts = match most == of {
        true => format!("{} in one part if they overlap", all_of(most, of)),
        false => format!("{} in the largest part if they overlap", all_of(most, of)),
    };
    let now = most_of(found).filter(|(_, images, _)| *images < of);
    let now = now.map(|(mapper, images, _)| format!("; now {images} ({mapper} mapping)"));
    let elsewhere = "photograph what lies between the parts, or match again with more features (Meshroom: Describer Density \
                     high; ODM: --min-num-features 20000; OpenMVG: -p HIGH)";
    Some(Next {
        commands,
        expect: parts + &now.unwrap_or_default(),
        by_hand: found.pairs.is_none().then(|| elsewhere.to_owned()),
    })
}

/// The mapper that makes most of a database, how many images its first model has, and the command of COLMAP.
fn most_of(found: &Overview) -> Option<(&'static str, usize, &'static str)> {
    let foreseen = found
        .mappers
        .as_ref()
        .filter(|_| found.no_model().is_none())?;
    let first = foreseen.global.models.first();
    let of_global = first.map_or(0, |model| model.images.len());
    let first = foreseen.incremental.models.first();
    let of_incremental = first.map_or(0, |model| model.images.len());
    let has_global = has_global_mapper(found.facts()?.version);
    // Where chance decides whether a model begins, the mapper that needs no beginning is the better one.
    let is_uncertain = unfit(&foreseen.incremental).is_some();
    let is_more = of_global > of_incremental || is_uncertain && of_global == of_incremental;
    let most = match is_more && has_global {
        true => ("global", of_global, "global_mapper"),
        false => ("incremental", of_incremental, "mapper"),
    };
    (most.1 > 0).then_some(most)
}

/// Nothing is left to match: which mapper makes most of it.
fn map(file: &File, found: &Overview) -> Next {
    if found.mappers.is_none() {
        return of_no_database(file, found);
    }
    if found
        .contradictions
        .as_ref()
        .is_some_and(|off| !off.is_good())
    {
        let words = ["verify", "contradictions", file.path].map(str::to_owned);
        let why = "names the pairs to look at, and maps neighbours alone";
        return Next {
            commands: vec![doing(&words, why)],
            by_hand: by_hand(found),
            expect: "pairs to look at, and commands that map neighbours alone; a mapper may believe the wrong pairs"
                .to_owned(),
        };
    }
    let most = most_of(found).filter(|_| found.without_base_line.is_empty());
    let Some((name, images, mapper)) = most else {
        let other = "take photographs from other places: step aside, and do not turn on the spot";
        return Next {
            commands: Vec::new(),
            by_hand: Some(by_hand(found).unwrap_or_else(|| other.into())),
            expect: "no model to be trusted before that, of either mapper".to_owned(),
        };
    };
    let mapping = ["--image_path", "images", "--output_path", "sparse"];
    let after = match () {
        () if found.doubts().iter().any(|doubt| doubt.refutes) => "the warning holds for it",
        () if !found.determined() => "what is outside stays outside",
        () => "does a wall stand twice? Match neighbours only",
    };
    let why = format!("{name} mapping makes most of these matches");
    let images = all_of(images, found.wanted.of);
    Next {
        commands: vec![file.colmap(mapper, &mapping, &why)],
        by_hand: by_hand(found),
        expect: format!("likely {images} in one model; {after}"),
    }
}

/// Where a photograph is missing.
fn by_hand(found: &Overview) -> Option<String> {
    let [one, other] = &found.joints.photograph.as_ref()?.between;
    Some(format!(
        "all was matched: photograph what lies between {one} and {other}, or extract more features"
    ))
}

/// A model beside the database that has all images already.
fn whole_model(found: &Overview) -> Option<Next> {
    let (path, images) = found.beside.first()?;
    let is_whole = *images == found.wanted.of && found.determined();
    is_whole.then(|| Next {
        commands: Vec::new(),
        by_hand: Some(format!("take the model {}: it has all images", shell(path))),
        expect: "nothing to match or map; programs that read sparse/0 alone need this path"
            .to_owned(),
    })
}

/// The models of a folder.
fn of_models(file: &File, found: &Overview) -> Next {
    let why = "says whether what two models share fixes one against the other";
    Next {
        commands: vec![file.verify("merge", &[&found.beside[0].0], why)],
        expect: "how the two are merged, or why not; COLMAP merges only models of one database"
            .to_owned(),
        by_hand: None,
    }
}

/// Lists of pairs, models, and files of other pipelines.
fn of_no_database(file: &File, found: &Overview) -> Next {
    let by_hand = by_hand(found);
    let images = "writes the images of each part";
    let (command, expect) = match (&found.tracks, found.is_one_part()) {
        (Some(_), true) => {
            let expect = "nothing to mend: its tracks hold all images together";
            (None, expect)
        }
        (Some(_), false) if file.is_model => {
            let why = "writes each part as a model of its own";
            let expect = "models each of which is what its tracks determine";
            (Some(file.verify("split", &["parts/"], why)), expect)
        }
        (Some(_), false) => {
            let expect = "lists of images, each of which a mapper places right by itself";
            let command = file.verify("export", &["parts/", "--tracks"], images);
            (Some(command), expect)
        }
        (None, true) => {
            let why = "says without which pairs something falls apart";
            let expect =
                "the pairs that everything hangs on: match their images with more neighbours";
            let command = file.verify("advise", &["--model", "calibrated", "--weak"], why);
            (Some(command), expect)
        }
        (None, false) => {
            let expect = "lists of images, each of which is determined by itself";
            let command = file.verify("export", &["parts/", "--model", "calibrated"], images);
            (Some(command), expect)
        }
    };
    Next {
        commands: Vec::from_iter(command),
        by_hand,
        expect: expect.to_owned(),
    }
}

/// The options by which a file was read, as they are written.
fn options_of(read: &ReadOptions) -> Vec<String> {
    let mut words = Vec::new();
    let mut say = |option: &str, value: Option<String>| {
        if let Some(value) = value {
            words.extend([option.to_owned(), value]);
        }
    };
    say("--format", read.format.map(|format| format.to_string()));
    say("--variable", read.variable.clone());
    let pipeline = read.pipeline.map(|pipeline| pipeline.to_string());
    say("--pipeline", pipeline);
    let least = read.min_inliers.map(|count| count.to_string());
    say("--min-inliers", least);
    let list = &read.list;
    say("--columns", list.columns.as_ref().map(ToString::to_string));
    let least = list.min_weight.as_ref().map(ToString::to_string);
    say("--min-weight", least);
    let default = TrackOptions::default();
    let tracks = read.tracks.unwrap_or_default();
    let other = |value: u32, usual: u32| (value != usual).then(|| value.to_string());
    say("--min-views", other(tracks.min_views, default.min_views));
    say("--max-spread", other(tracks.max_spread, default.max_spread));
    let flags = [
        ("--skip-loops", list.skip_loops),
        ("--no-rigs", !tracks.rigs),
    ];
    let flags = flags.iter().filter(|(_, is_said)| *is_said);
    words.extend(flags.map(|(option, _)| (*option).to_owned()));
    words
}
