//! Parts, joints and suggestions as tables.

use super::scene::Scene;
use crate::svg::escaped;
use crate::{advice, counted};
use viewcert_advice::Advice;

/// Most rows of a table.
const ROWS: usize = 200;
/// Most names that stand in a cell; more are there to be opened.
const NAMES: usize = 4;
/// Most names that are written at all.
const MOST: usize = 5000;

/// A table with these heads; rows that are too many are counted.
fn table(heads: &[&str], rows: impl ExactSizeIterator<Item = Vec<String>>) -> String {
    let more = rows.len().saturating_sub(ROWS);
    let head: String = heads
        .iter()
        .map(|head| format!("<th>{head}</th>"))
        .collect();
    let rows = rows.take(ROWS).map(|cells| {
        let cells: String = cells
            .iter()
            .map(|cell| format!("<td>{cell}</td>"))
            .collect();
        format!("<tr>{cells}</tr>\n")
    });
    let rows: String = rows.collect();
    let rest = match more {
        0 => String::new(),
        more => format!("<p class=\"soft\">and {more} more (--json lists them)</p>\n"),
    };
    format!(
        "<div class=\"scroll\"><table>\n<thead><tr>{head}</tr></thead>\n<tbody>\n{rows}</tbody></table>\
         </div>\n{rest}"
    )
}

/// Names, the first and the last one if they are many, with all of them behind.
fn names(all: &[String]) -> String {
    let join = |some: &[String]| escaped(&some.join(", "));
    let (Some(first), Some(last)) = (all.first(), all.last()) else {
        return String::new();
    };
    if all.len() <= NAMES {
        return join(all);
    }
    let rest = match all.len().saturating_sub(MOST) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    format!(
        "<details><summary>{} &hellip; {}</summary><p>{}{rest}</p></details>",
        escaped(first),
        escaped(last),
        join(&all[..all.len().min(MOST)])
    )
}

/// The parts with their images, and the images of none.
pub(super) fn parts(scene: &Scene) -> String {
    let mut images = scene.parts.iter().flat_map(|part| &part.images);
    let are_shared = images.any(|&v| scene.parts_of(v).len() > 1);
    let rows = (0..scene.parts.len()).map(|k| {
        let part = &scene.parts[k];
        let images: Vec<String> = part.images.iter().map(|&v| scene.name(v)).collect();
        let shared = part.images.iter().filter(|&&v| scene.parts_of(v).len() > 1);
        let shared: Vec<String> = shared.map(|&v| scene.name(v)).collect();
        let mut cells = vec![
            scene.swatch(k),
            part.component.to_string(),
            counted(images.len(), "image"),
            part.points
                .map_or(String::new(), |points| counted(points, "point")),
            names(&images),
        ];
        cells.extend(are_shared.then(|| names(&shared)));
        cells
    });
    let mut heads = vec!["", "part", "images", "points", "which"];
    heads.extend(are_shared.then_some("also in other parts"));
    let table = if scene.parts.is_empty() {
        "<p>There is no part: no images are determined against each other.</p>\n".to_owned()
    } else {
        table(&heads, rows)
    };
    let outside: Vec<String> = scene.outside().map(|v| scene.name(v)).collect();
    if outside.is_empty() {
        return table;
    }
    let count = counted(outside.len(), "image");
    format!("{table}<h3>In no part: {count}</h3>\n{}\n", names(&outside))
}

/// The joints.
pub(super) fn joints(found: &Advice) -> String {
    if found.joints.is_empty() || found.single_pairs_only {
        return String::new();
    }
    let rows = found.joints.iter().map(|joint| {
        let pairs = joint.pairs.iter().map(|[a, b]| format!("{a} {b}"));
        let at = if joint.pairs.is_empty() {
            joint.images.clone()
        } else {
            pairs.collect()
        };
        let [one, other] = joint.between;
        vec![
            format!("{one} and {other}"),
            escaped(&joint.how),
            names(&at),
            escaped(&joint.meaning),
        ]
    });
    let more = if found.joints_complete {
        ""
    } else {
        "<p class=\"soft\">There are more joints than are computed.</p>\n"
    };
    table(&["parts", "touch by", "where", "left free"], rows) + more
}

/// The suggestions, in the words of the screen.
pub(super) fn suggestions(found: &Advice) -> String {
    let Some(all) = found.suggestions.as_deref().filter(|all| !all.is_empty()) else {
        return String::new();
    };
    let mut text = Vec::new();
    advice::suggestions(&mut text, all).expect("memory takes it");
    let text = String::from_utf8_lossy(&text);
    let mut items = String::new();
    let mut is_open = false;
    for line in text.lines() {
        let indent = line.len() - line.trim_start().len();
        let words = escaped(line.trim());
        if indent > 4 && is_open {
            items += &format!("<br><span class=\"soft\">{words}</span>");
        } else {
            items += if is_open { "</li>\n<li>" } else { "<li>" };
            items += &words;
            is_open = true;
        }
    }
    format!(
        "<p>Each of these is proved to join parts, if as much comes of it as is said.</p>\n\
         <ul>{items}</li></ul>\n"
    )
}
