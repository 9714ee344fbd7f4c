//! The report of one graph as one page, which needs no network and no other file.
//!
//! In: what `verify --json` prints, and a picture of the graph. Out: the template filled with both,
//! with its style and its script. The script reads all numbers from the JSON, so that the page and
//! the JSON cannot differ.
//!
//! Names come from files of others. They are escaped; and the page's policy lets no script run
//! but its own.

mod adjacency;

use super::graph_picture::{Drawn, Picture, document};
use super::motion_picture::{self, Frames};
use super::svg::{COLOURS, escaped};
use super::{Report, json};
use adjacency::Adjacency;
use base64::{Engine, prelude::BASE64_STANDARD};
use serde::Serialize;
use sha2::{Digest, Sha256};
use std::borrow::Cow;
use std::io::{self, Write};

const TEMPLATE: &str = include_str!("template.html");
const STYLE: &str = include_str!("style.css");
const SCRIPT: &str = include_str!("script.js");

/// Fewest nodes for which an adjacency picture says more than the graph itself.
const ADJACENCY_FROM: usize = 100;

/// The section with the motions at given cameras, which is there only if there are some.
const MOTION: &str = "<section id=\"motion\"><h2>What moves at the given cameras</h2>\n<p class=\"explanation\">\
    Motions of first order, exact, that leave all pairs as they are; the largest part is held still, and arrows show \
    where the other centres go. Colours are the parts here.</p>\n";

/// What the script needs besides the report.
#[derive(Serialize)]
struct Drawing<'a> {
    /// The program's version.
    version: &'static str,
    /// Names of the cameras, in the order of the nodes.
    names: Vec<Cow<'a, str>>,
    /// How many edges each of them has.
    degrees: Vec<u32>,
    /// The edges, end after end, if the picture shows them one by one.
    edges: Option<Vec<u32>>,
    /// The colours of components, which repeat with another shape.
    colours: [&'static str; COLOURS.len()],
    /// How many components, the first ones, have a mark of their own.
    marked: usize,
    /// The nodes of each metric component, if cameras have classes.
    #[serde(skip_serializing_if = "Option::is_none")]
    metric: Option<&'a [Vec<u32>]>,
    /// The adjacency picture, without its pixels.
    adjacency: Option<&'a Adjacency>,
}

/// Writes the page.
///
/// # Errors
/// Those of the writer.
pub fn write(
    out: &mut dyn Write,
    report: &Report,
    picture: &Picture,
    drawn: &Drawn,
) -> io::Result<()> {
    let mut numbers = Vec::new();
    let listing = Report {
        list_components: true,
        ..*report
    };
    json::write(&mut numbers, &listing)?;
    let nodes = report.input.graph.nodes();
    let adjacency = (nodes >= ADJACENCY_FROM).then(|| Adjacency::new(picture));
    let drawing = serde_json::to_vec(&drawing(report, picture, adjacency.as_ref()))?;
    let mut parts = TEMPLATE.split("{{");
    out.write_all(parts.next().unwrap_or_default().as_bytes())?;
    for part in parts {
        let (name, rest) = part.split_once("}}").expect("a field of the template ends");
        match name {
            "title" => out.write_all(escaped(&report.input.name).as_bytes())?,
            "policy" => write!(out, "script-src 'sha256-{}'", hash(SCRIPT))?,
            "style" => out.write_all(STYLE.as_bytes())?,
            "script" => out.write_all(SCRIPT.as_bytes())?,
            "report" => embed(out, numbers.trim_ascii_end())?,
            "drawing" => embed(out, &drawing)?,
            "picture" => out.write_all(document(picture, drawn, false).as_bytes())?,
            "motion" => {
                let moving = |here| motion_picture::picture(&here, Frames::Moving);
                if let Some(picture) = report.here.and_then(moving) {
                    write!(out, "{MOTION}{picture}</section>")?;
                }
            }
            "adjacency" => {
                if let Some(adjacency) = &adjacency {
                    write!(out, "data:image/png;base64,")?;
                    let pixels = BASE64_STANDARD.encode(adjacency.png(picture)?);
                    out.write_all(pixels.as_bytes())?;
                }
            }
            _ => unreachable!("the template has no field {name}"),
        }
        out.write_all(rest.as_bytes())?;
    }
    Ok(())
}

fn drawing<'a>(
    report: &'a Report,
    picture: &Picture,
    adjacency: Option<&'a Adjacency>,
) -> Drawing<'a> {
    let graph = &report.input.graph;
    let cameras = picture.cameras();
    let mut degrees = vec![0u32; graph.nodes()];
    for &(i, j) in graph.edges() {
        degrees[i as usize] += 1;
        degrees[j as usize] += 1;
    }
    degrees.truncate(cameras);
    let edges = graph.edges().iter().flat_map(|&(i, j)| [i, j]);
    Drawing {
        version: env!("CARGO_PKG_VERSION"),
        names: (0..cameras as u32)
            .map(|v| report.input.labels.label(v))
            .collect(),
        degrees,
        edges: picture.is_detailed().then(|| edges.collect()),
        colours: COLOURS,
        marked: picture.marked(),
        metric: report.scope.intrinsics().map(|found| found.nodes()),
        adjacency,
    }
}

/// Writes JSON into an element: there `<` would begin a tag. It stands in strings only, where it
/// has another spelling.
fn embed(out: &mut dyn Write, json: &[u8]) -> io::Result<()> {
    let mut parts = json.split(|&byte| byte == b'<');
    out.write_all(parts.next().unwrap_or_default())?;
    for part in parts {
        out.write_all(br"\u003c")?;
        out.write_all(part)?;
    }
    Ok(())
}

/// How a policy names an inline script.
fn hash(script: &str) -> String {
    BASE64_STANDARD.encode(Sha256::digest(script))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn json_ends_no_element_and_means_the_same() {
        let json = br#"{"</script><!--":"<\\<"}"#;
        let mut out = Vec::new();
        embed(&mut out, json).unwrap();
        assert!(!out.contains(&b'<'));
        let read = |bytes: &[u8]| serde_json::from_slice::<serde_json::Value>(bytes).unwrap();
        assert_eq!(read(&out), read(json));
    }

    /// From the standard (Content Security Policy Level 2, section 4.2.5).
    #[test]
    fn scripts_are_named_as_policies_name_them() {
        assert_eq!(
            hash("alert('Hello, world.');"),
            "qznLcsROx4GACP2dm0UCKCzCG+HiZ1guq6ZZDob/Tng="
        );
    }

    /// A script that held the end of its element would be cut there.
    #[test]
    fn style_and_script_end_with_their_elements() {
        assert!(!SCRIPT.contains("</script") && !SCRIPT.contains("<!--"));
        assert!(!STYLE.contains("</style"));
        for name in [
            "title", "policy", "style", "script", "report", "drawing", "picture",
        ] {
            assert!(TEMPLATE.contains(&format!("{{{{{name}}}}}")), "{name}");
        }
    }
}
