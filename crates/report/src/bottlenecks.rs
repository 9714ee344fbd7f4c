//! Narrow places and special geometry, in words.

use super::counted;
use viewcert_advice::degenerate::{Hinge, Narrow, Pair};

/// What to look at by eye.
pub(crate) fn few(found: &Narrow) -> Vec<String> {
    let places = found.few.iter().filter(|few| !few.special).map(|few| {
        let [one, other] = few.sides;
        let hold = if few.pairs.len() == 1 {
            "holds"
        } else {
            "hold"
        };
        let pairs = pairs(&few.pairs);
        format!("{pairs} alone {hold} {one} and {other} images together")
    });
    places.collect()
}

/// A line for each special place.
pub(crate) fn warnings(found: &Narrow) -> Vec<String> {
    const SPECIAL: &str = "from one place";
    const MEANS: &str = "verdicts are about generic places";
    let few = found.few.iter().filter(|few| few.special).map(|few| {
        let [one, other] = few.sides;
        format!(
            "what alone holds {one} and {other} images together is {SPECIAL} ({}); {MEANS}",
            pairs(&few.pairs)
        )
    });
    let between = found.between.iter().filter(|between| between.special).map(|between| {
        let [one, other] = between.components;
        let looked = if between.count > between.pairs.len() {
            format!("the {} strongest of {}", between.pairs.len(), counted(between.count, "pair"))
        } else {
            format!("all {} pairs", between.count)
        };
        let what = if between.count == 1 {
            "the only pair is".to_owned()
        } else {
            format!("{looked} are")
        };
        format!(
            "components {one} and {other}: {what} {SPECIAL}; more matches of the same images do not \
             join them"
        )
    });
    let hinges = found.hinges.iter().filter(|hinge| hinge.special).map(|hinge| {
        format!(
            "{} alone hold {} images together, and stand in one place ({}): their scale against each \
             other is not fixed, whatever the verdict says",
            hinge.pair.images.join(" and "),
            sides(hinge),
            numbers(&hinge.pair),
        )
    });
    few.chain(between).chain(hinges).collect()
}

fn sides(hinge: &Hinge) -> String {
    let sides: Vec<String> = hinge.sides.iter().map(usize::to_string).collect();
    sides.join(" and ")
}

/// "A B (17 inliers, 3.2 degrees)" of each.
fn pairs(pairs: &[Pair]) -> String {
    let each = pairs.iter().map(|pair| match &numbers(pair)[..] {
        "" => pair.images.join(" "),
        numbers => format!("{} ({numbers})", pair.images.join(" ")),
    });
    each.collect::<Vec<_>>().join(", ")
}

fn numbers(pair: &Pair) -> String {
    let inliers = pair.inliers.map(|count| counted(count as usize, "inlier"));
    let panoramic = (pair.config == Some(5)).then(|| "panoramic".to_owned());
    let angle = pair.angle.map(|angle| format!("{angle:.1} degrees"));
    let known: Vec<String> = inliers.into_iter().chain(panoramic).chain(angle).collect();
    known.join(", ")
}
