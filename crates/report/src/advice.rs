//! What was found, in a few lines for people.

use crate::shown::{SHOWN, rest};
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
    let more = if advice.joints_complete {
        ""
    } else {
        " and more"
    };
    writeln!(out, "  joints      {count}{more}")?;
    for joint in advice.joints.iter().take(SHOWN) {
        let [one, other] = joint.between;
        writeln!(
            out,
            "    components {one} and {other}: {}; free: {}{}",
            touching(joint),
            joint.meaning,
            if joint.strength == "proof" {
                ""
            } else {
                " (error bound)"
            },
        )?;
    }
    rest(out, count, "--json lists them")
}

/// How two components touch, and where.
fn touching(joint: &Joint) -> String {
    let at: Vec<String> = if joint.pairs.is_empty() {
        let images = joint.images.iter();
        images.take(SHOWN).cloned().collect()
    } else {
        let pairs = joint.pairs.iter().take(SHOWN);
        pairs.map(|[a, b]| format!("{a} {b}")).collect()
    };
    let inliers = match joint.inliers.as_deref() {
        None => String::new(),
        Some(inliers) => format!(" (inliers: {})", list(inliers)),
    };
    format!("{}, {}{inliers}", joint.how, at.join(", "))
}

fn list(numbers: &[impl ToString]) -> String {
    let numbers: Vec<String> = numbers.iter().map(ToString::to_string).collect();
    numbers.join(", ")
}

fn weak(out: &mut impl Write, found: &Weak, single_pairs_only: bool) -> io::Result<()> {
    let what = format!(
        "without any one of these {} a component falls apart",
        found.of
    );
    if single_pairs_only {
        return writeln!(
            out,
            "  weak        nothing to fall apart: no component is more than a pair"
        );
    }
    writeln!(out, "  weak        {}", some(found.items.len(), &what))?;
    for item in found.items.iter().take(SHOWN) {
        let name = item.what.join(" ");
        writeln!(
            out,
            "    {name} (component {}): {}",
            item.component, item.why
        )?;
    }
    rest(out, found.items.len(), "--json lists them")?;
    if found.kept != "solvable" {
        writeln!(
            out,
            "    without any other one it stays finite solvable, if not unique"
        )?;
    }
    if found.single_pairs > 0 {
        let thing = match found.of {
            "pairs" | "images" => "single pair",
            _ => "single observation",
        };
        let pairs = counted(found.single_pairs, thing);
        writeln!(
            out,
            "    not among them: {pairs}, on which no larger component rests"
        )?;
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
        let inliers = one
            .inliers
            .as_deref()
            .map(|known| format!("inliers now: {}", list(known)));
        let matches = one
            .matches
            .as_deref()
            .map(|known| format!("matches: {}", list(known)));
        let tried = one.tried.as_deref().and_then(tried);
        let known = inliers.into_iter().chain(matches).chain(tried);
        let known: Vec<String> = reason.into_iter().chain(known).collect();
        let known = match known.len() {
            0 => String::new(),
            _ => format!(" [{}]", known.join("; ")),
        };
        writeln!(
            out,
            "    {}{enough}: {}, {} together{known}",
            pairs.join(", "),
            joins(one),
            counted(one.images, "image"),
        )?;
        if let Some(enough) = &one.enough {
            writeln!(out, "      enough: {}", sufficient(enough))?;
        }
        if !one.also.is_empty() {
            writeln!(
                out,
                "      at the same places, to be matched as well: {}",
                one.also.join(", ")
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
    let ToMatch {
        file,
        pairs,
        command,
    } = found;
    let Some(command) = command else {
        return writeln!(
            out,
            "  written     no pair to {file}: none is left to match"
        );
    };
    let pairs = counted(*pairs, "pair");
    writeln!(
        out,
        "  written     {pairs} to {file}, the most promising first; match and verify, then ask again:"
    )?;
    writeln!(out, "    {command}")
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
    let pairs = match one.single_pairs {
        0 => String::new(),
        count => counted(count, single),
    };
    let frames = match one.frames {
        0 => String::new(),
        count => counted(count, "frame"),
    };
    let both: Vec<String> = [parts, pairs, frames]
        .into_iter()
        .filter(|part| !part.is_empty())
        .collect();
    match one.joins.len() + one.single_pairs + one.frames {
        1 => format!(
            "adds {} to {}",
            counted(one.gain, "image"),
            both.join(" and ")
        ),
        _ => format!("joins {}", both.join(" and ")),
    }
}

fn explain(out: &mut impl Write, found: &Explain, of_tracks: bool) -> io::Result<()> {
    if of_tracks {
        explain_observations(out, found)?;
    } else {
        explain_pairs(out, found)?;
    }
    for pair in &found.unused {
        let matches = pair
            .matches
            .map_or(String::new(), |count| format!(", {count} matches"));
        writeln!(
            out,
            "    not used: {} with {}{matches}",
            pair.image,
            counted(pair.inliers as usize, "inlier")
        )?;
    }
    if !found.suggestions.is_empty() {
        writeln!(out, "    it would help to match:")?;
        suggestions(out, &found.suggestions)?;
    }
    Ok(())
}

/// A camera, and the points that it sees.
fn explain_observations(out: &mut impl Write, found: &Explain) -> io::Result<()> {
    let outside = found.pairs_outside.len();
    let place = match (&found.components[..], outside) {
        ([], 0) => "sees no track that counts".to_owned(),
        ([], _) => "is in no component of two cameras or more".to_owned(),
        ([one], _) => format!("is in component {one}"),
        (many, _) => format!("is in components {}, which it hinges", list(many)),
    };
    writeln!(out, "  image       {} {place}", found.image)?;
    if found.pairs_inside > 0 {
        let points = counted(found.pairs_inside, "point");
        writeln!(out, "    it sees {points} inside")?;
    }
    for sees in found.sees.iter().flatten().take(SHOWN) {
        let points = counted(sees.points, "point");
        writeln!(
            out,
            "    sees {points} of component {}; an incremental mapper wants {}",
            sees.component, sees.needs
        )?;
    }
    for seen in found.pairs_outside.iter().take(SHOWN) {
        let reaches = match &seen.reaches[..] {
            [] => "is in no such component either".to_owned(),
            parts => format!(
                "is in component {}, for which one observation is not enough",
                list(parts)
            ),
        };
        writeln!(out, "    it sees {}, which {reaches}", seen.image)?;
    }
    rest(out, outside, "--json lists them")
}

/// An image, and its pairs.
fn explain_pairs(out: &mut impl Write, found: &Explain) -> io::Result<()> {
    let outside = found.pairs_outside.len();
    let place = match (&found.components[..], outside) {
        ([], 0) => "has no pair".to_owned(),
        ([], _) => "is in no component larger than a pair".to_owned(),
        ([one], _) => format!("is in component {one}"),
        (many, _) => format!("is in components {}, which it hinges", list(many)),
    };
    writeln!(out, "  image       {} {place}", found.image)?;
    if found.pairs_inside > 0 {
        let pairs = counted(found.pairs_inside, "pair");
        writeln!(out, "    {pairs} inside")?;
    }
    for pair in found.pairs_outside.iter().take(SHOWN) {
        let inliers = pair
            .inliers
            .map_or(String::new(), |count| format!(" ({count} inliers)"));
        let reaches = match &pair.reaches[..] {
            [] => "leads to an image in no larger component either".to_owned(),
            parts => format!(
                "leads to component {}, for which one pair is not enough",
                list(parts)
            ),
        };
        writeln!(
            out,
            "    pair with {}{inliers} is in no larger component: {reaches}",
            pair.image
        )?;
    }
    rest(out, outside, "--json lists them")
}

fn export(out: &mut impl Write, found: &Export) -> io::Result<()> {
    let parts = counted(found.components, "component");
    writeln!(out, "  exported    {parts} to {}", found.folder)?;
    if !found.shared_images.is_empty() {
        let shown = &found.shared_images[..found.shared_images.len().min(SHOWN)];
        writeln!(
            out,
            "    {} in several components: {}{}",
            counted(found.shared_images.len(), "image"),
            shown.join(", "),
            if shown.len() < found.shared_images.len() {
                ", ..."
            } else {
                ""
            },
        )?;
    }
    if found.outside > 0 {
        writeln!(
            out,
            "    {} in no component that is exported (images.tsv lists them)",
            counted(found.outside, "image")
        )?;
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
