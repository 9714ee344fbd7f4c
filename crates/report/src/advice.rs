//! What was found, in a few lines for people.

use crate::shown::{SHOWN, rest, row, some_names};
use std::io::{self, Write};
use viewcert::wording::counted;
use viewcert_advice::named::{
    Advice, Enough, Explain, Export, Joint, Photograph, Suggestion, ToMatch, Weak,
};

/// Writes what was found.
///
/// # Errors
/// Those of the writer.
pub fn write(out: &mut impl Write, advice: &Advice) -> io::Result<()> {
    joints(out, advice)?;
    if let Some(found) = &advice.weak {
        weak(out, found, advice.single_pairs_only)?;
    }
    if let Some(found) = &advice.suggestions {
        let joined = "if these images really overlap, matching them joins components: proved";
        let count = match advice.is_whole {
            true => "nothing is to be joined: one component holds everything".to_owned(),
            false => some(found.len(), joined),
        };
        writeln!(out, "  suggested   {count}")?;
        suggestions(out, found)?;
        hints(out, found)?;
    }
    if let Some(found) = &advice.photograph {
        writeln!(out, "  photograph  {}", photograph(found))?;
    }
    if let Some(found) = &advice.to_match {
        to_match(out, found)?;
    }
    if let Some(found) = &advice.explain {
        explain(out, found, advice.of_tracks)?;
    }
    if let Some(found) = &advice.export {
        export(out, found)?;
    }
    Ok(())
}

fn some(count: usize, what: &str) -> String {
    match count {
        0 => "none found".to_owned(),
        _ => format!("{count} ({what})"),
    }
}

/// Writes the joints.
///
/// # Errors
/// Those of the writer.
pub fn joints(out: &mut impl Write, advice: &Advice) -> io::Result<()> {
    if advice.joints.is_empty() || advice.single_pairs_only {
        return Ok(());
    }
    let count = advice.joints.len();
    let complete = advice.joints_complete;
    let more = if complete { "" } else { " and more" };
    row(out, "joints", format!("{count}{more}"))?;
    for joint in advice.joints.iter().take(SHOWN) {
        let ([one, other], how, free) = (joint.between, touching(joint), &joint.meaning);
        let bound = match joint.strength {
            "proof" => "",
            _ => " (error bound)",
        };
        writeln!(
            out,
            "    components {one} and {other}: {how}; free: {free}{bound}"
        )?;
    }
    rest(out, count, "--json lists them")
}

/// How two components touch, and where.
fn touching(joint: &Joint) -> String {
    let pairs = joint.pairs.iter().map(|[a, b]| format!("{a} {b}"));
    let images = joint.images.iter().filter(|_| joint.pairs.is_empty());
    let at = pairs.chain(images.cloned()).take(SHOWN);
    let at = at.collect::<Vec<_>>().join(", ");
    let inliers = joint.inliers.as_deref().map(list);
    let inliers = inliers.map_or_else(String::new, |all| format!(" (inliers: {all})"));
    format!("{}, {at}{inliers}", joint.how)
}

fn list(numbers: &[impl ToString]) -> String {
    let numbers: Vec<String> = numbers.iter().map(ToString::to_string).collect();
    numbers.join(", ")
}

fn weak(out: &mut impl Write, found: &Weak, single_pairs_only: bool) -> io::Result<()> {
    if single_pairs_only {
        let nothing = "nothing to fall apart: no component is more than a pair";
        return row(out, "weak", nothing);
    }
    let of = found.of;
    let what = format!("without any one of these {of} a component falls apart");
    row(out, "weak", some(found.items.len(), &what))?;
    for item in found.items.iter().take(SHOWN) {
        let (name, component, why) = (item.what.join(" "), item.component, &item.why);
        writeln!(out, "    {name} (component {component}): {why}")?;
    }
    rest(out, found.items.len(), "--json lists them")?;
    if found.kept != "solvable" {
        // Corollary 19.5 of the theory; the loss of pairs shows no such thing.
        let words = match found.of == "images" && found.items.is_empty() {
            true => {
                "each component of three images or more is solvable: no image's loss breaks it (proved)"
            }
            false => "without any other one it stays finite solvable, if not unique",
        };
        writeln!(out, "    {words}")?;
    }
    if found.single_pairs > 0 {
        let thing = match found.of {
            "pairs" | "images" => "single pair",
            _ => "single observation",
        };
        let pairs = counted(found.single_pairs, thing);
        let words = "on which no larger component rests";
        writeln!(out, "    not among them: {pairs}, {words}")?;
    }
    Ok(())
}

pub(crate) fn suggestions<'a>(
    out: &mut impl Write,
    found: impl IntoIterator<Item = &'a Suggestion>,
) -> io::Result<()> {
    for one in found {
        let pairs = one.pairs.iter().zip(&one.why);
        let pairs = pairs.map(|([a, b], why)| match one.pairs.len() {
            1 => format!("{a} {b}"),
            _ => format!("{a} {b} ({why})"),
        });
        let pairs: Vec<String> = pairs.collect();
        let (enough, reason) = match &one.why[..] {
            [why] => ("", Some(why.clone())),
            _ => (" (all of them: enough, perhaps not the fewest)", None),
        };
        let inliers = one.inliers.as_deref().map(list);
        let inliers = inliers.map(|known| format!("inliers now: {known}"));
        let matches = one.matches.as_deref().map(list);
        let matches = matches.map(|known| format!("matches: {known}"));
        let tried = one.tried.as_deref().and_then(tried);
        let known = inliers.into_iter().chain(matches).chain(tried);
        let known: Vec<String> = reason.into_iter().chain(known).collect();
        let known = match known.len() {
            0 => String::new(),
            _ => format!(" [{}]", known.join("; ")),
        };
        let (pairs, joins) = (pairs.join(", "), joins(one));
        let images = counted(one.images, "image");
        writeln!(
            out,
            "    {pairs}{enough}: {joins}, {images} together{known}"
        )?;
        if let Some(enough) = &one.enough {
            writeln!(out, "      enough: {}", sufficient(enough))?;
        }
        if !one.also.is_empty() {
            let also = one.also.join(", ");
            writeln!(
                out,
                "      at the same places, to be matched as well: {also}"
            )?;
        }
    }
    Ok(())
}

/// What has become of matching the pairs, by the worst of them.
fn tried(all: &[&str]) -> Option<String> {
    let has = |word: &str| all.contains(&word);
    let words = match () {
        () if has("used") => return None,
        () if has("not-tried") => "not matched yet",
        () if has("not-verified") => "matched, not verified yet",
        () => "enough for a mapper, left out for another reason",
    };
    Some(words.to_owned())
}

/// What to expect of the suggestions, where images are matched.
fn hints(out: &mut impl Write, found: &[Suggestion]) -> io::Result<()> {
    let Some(needs) = found.first().and_then(|one| one.needs) else {
        return Ok(());
    };
    writeln!(
        out,
        "    a mapper needs more than this: {} inliers for a pair, and {} points with a place in an image that it \
         registers (COLMAP's defaults)",
        needs.inliers, needs.points
    )
}

/// Where a photograph would help.
pub(crate) fn photograph(found: &Photograph) -> String {
    let group = |images: &[String]| match images {
        [first, .., last] => format!("{first} to {last} ({})", counted(images.len(), "image")),
        _ => images.join(""),
    };
    let [one, other] = found.groups.each_ref().map(|images| group(images));
    let [a, b] = &found.between;
    format!(
        "take one between {one} and {other}; nearest to each other are {a} and {b}: all pairs that could join \
         something were matched, and gave too little"
    )
}

/// The list of pairs, and the command that takes it.
fn to_match(out: &mut impl Write, found: &ToMatch) -> io::Result<()> {
    let file = &found.file;
    let Some(command) = &found.command else {
        let nothing = format!("no pair to {file}: none is left to match");
        return row(out, "written", nothing);
    };
    let pairs = counted(found.pairs, "pair");
    let words = "the most promising first; match and verify, then ask again";
    row(
        out,
        "written",
        format!("{pairs} to {file}, {words}:\n    {command}"),
    )
}

/// How much has to come of matching two images.
fn sufficient(enough: &Enough) -> String {
    let seen = enough.observations.iter().map(|one| {
        let points = counted(one.points, "more point");
        format!("{} sees {points} of component {}", one.image, one.component)
    });
    let mut words = seen.collect::<Vec<_>>().join(" and ");
    if enough.matched {
        words += "; they are matched, but in tracks that are too short: match both with further \
                  images of the other's component";
    }
    words
}

fn joins(one: &Suggestion) -> String {
    let shown = list(&one.joins[..one.joins.len().min(SHOWN)]);
    let parts = match one.joins.len() {
        0 => String::new(),
        1 => format!("component {shown}"),
        count if count <= SHOWN => format!("components {shown}"),
        count => format!("components {shown} and {} more", count - SHOWN),
    };
    let single = match one.enough {
        None => "single pair",
        Some(_) => "single observation",
    };
    let others = [(one.single_pairs, single), (one.frames, "frame")];
    let others = others.into_iter().filter(|(count, _)| *count > 0);
    let all = others.map(|(count, what)| counted(count, what));
    let parts = Some(parts).filter(|parts| !parts.is_empty());
    let all: Vec<String> = parts.into_iter().chain(all).collect();
    let all = all.join(" and ");
    match one.joins.len() + one.single_pairs + one.frames {
        1 => format!("adds {} to {all}", counted(one.gain, "image")),
        _ => format!("joins {all}"),
    }
}

fn explain(out: &mut impl Write, found: &Explain, of_tracks: bool) -> io::Result<()> {
    if of_tracks {
        explain_observations(out, found)?;
    } else {
        explain_pairs(out, found)?;
    }
    for pair in &found.unused {
        let matches = pair.matches.map(|count| format!(", {count} matches"));
        let (image, matches) = (&pair.image, matches.unwrap_or_default());
        let inliers = counted(pair.inliers as usize, "inlier");
        writeln!(out, "    not used: {image} with {inliers}{matches}")?;
    }
    if !found.suggestions.is_empty() {
        writeln!(out, "    it would help to match:")?;
        suggestions(out, &found.suggestions)?;
    }
    Ok(())
}

/// A camera, and the points that it sees.
fn explain_observations(out: &mut impl Write, found: &Explain) -> io::Result<()> {
    let nothing = "sees no track that counts";
    place(
        out,
        found,
        [nothing, "is in no component of two cameras or more"],
    )?;
    if found.pairs_inside > 0 {
        let points = counted(found.pairs_inside, "point");
        writeln!(out, "    it sees {points} inside")?;
    }
    for sees in found.sees.iter().flatten().take(SHOWN) {
        let (component, needs) = (sees.component, sees.needs);
        let points = format!("{} of component {component}", counted(sees.points, "point"));
        writeln!(
            out,
            "    sees {points}; an incremental mapper wants {needs}"
        )?;
    }
    for seen in found.pairs_outside.iter().take(SHOWN) {
        let reaches = match (&seen.reaches[..], list(&seen.reaches)) {
            ([], _) => "is in no such component either".to_owned(),
            (_, parts) => {
                format!("is in component {parts}, for which one observation is not enough")
            }
        };
        writeln!(out, "    it sees {}, which {reaches}", seen.image)?;
    }
    rest(out, found.pairs_outside.len(), "--json lists them")
}

/// In which components an image is, with words for one that sees nothing and one that is in none.
fn place(out: &mut impl Write, found: &Explain, none: [&str; 2]) -> io::Result<()> {
    let place = match &found.components[..] {
        [] => none[usize::from(!found.pairs_outside.is_empty())].to_owned(),
        [one] => format!("is in component {one}"),
        many => format!("is in components {}, which it hinges", list(many)),
    };
    row(out, "image", format!("{} {place}", found.image))
}

/// An image, and its pairs.
fn explain_pairs(out: &mut impl Write, found: &Explain) -> io::Result<()> {
    place(
        out,
        found,
        ["has no pair", "is in no component larger than a pair"],
    )?;
    if found.pairs_inside > 0 {
        let pairs = counted(found.pairs_inside, "pair");
        writeln!(out, "    {pairs} inside")?;
    }
    for pair in found.pairs_outside.iter().take(SHOWN) {
        let inliers = pair.inliers.map(|count| format!(" ({count} inliers)"));
        let reaches = match (&pair.reaches[..], list(&pair.reaches)) {
            ([], _) => "leads to an image in no larger component either".to_owned(),
            (_, parts) => format!("leads to component {parts}, for which one pair is not enough"),
        };
        let other = pair.image.clone() + &inliers.unwrap_or_default();
        writeln!(
            out,
            "    pair with {other} is in no larger component: {reaches}"
        )?;
    }
    rest(out, found.pairs_outside.len(), "--json lists them")
}

fn export(out: &mut impl Write, found: &Export) -> io::Result<()> {
    let parts = counted(found.components, "component");
    row(out, "exported", format!("{parts} to {}", found.folder))?;
    if !found.shared_images.is_empty() {
        let images = counted(found.shared_images.len(), "image");
        let names = some_names(&found.shared_images);
        writeln!(out, "    {images} in several components: {names}")?;
    }
    if found.outside > 0 {
        let images = counted(found.outside, "image");
        let words = "in no component that is exported (images.tsv lists them)";
        writeln!(out, "    {images} {words}")?;
    }
    if let Some(commands) = found.commands.first() {
        writeln!(
            out,
            "  next        for the first component (the others by their numbers; `images` is the \
             folder of the photographs):"
        )?;
        for command in commands {
            writeln!(out, "    {command}")?;
        }
    }
    Ok(())
}
