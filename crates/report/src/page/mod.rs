//! The report of one graph as one page, which needs no network and no other file.
//!
//! In: what `verify --json` prints, a picture of the graph, and perhaps what a command prints for people. Out: the
//! template filled with these, with its style and its script. The script reads all numbers from the JSON, so that the
//! page and the JSON cannot differ.
//!
//! Names come from files of others. They are escaped; and the page's policy lets no script run
//! but its own.

use super::scene::{COLOURS, Kind, Scene, escaped};
use super::{Report, json as report_json};
use base64::{Engine, prelude::BASE64_STANDARD};
use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use std::io::{self, Write};

const TEMPLATE: &str = include_str!("template.html");
const STYLE: &str = include_str!("style.css");
const SCRIPT: &str = include_str!("script.js");

/// What a page says before the report: the answer in a sentence, and the words of a command.
pub(crate) struct Foreword<'a> {
    /// What kind of page it is.
    pub(crate) kind: &'a str,
    /// The answer, and whether it is good.
    pub(crate) answer: (String, bool),
    /// What the command prints for people, below its first line, and what it prints behind that.
    pub(crate) text: &'a str,
    pub(crate) rest: &'a str,
}

impl Foreword<'_> {
    fn html(&self) -> String {
        let (answer, is_good) = &self.answer;
        let lines = |text: &str| -> String {
            let lines = text.lines().map(|line| escaped(line) + "\n");
            lines.collect()
        };
        format!(
            "<div id=\"answer\" class=\"{}\"><p class=\"answer\">{}</p></div>\n<pre id=\"words\">{}</pre>\n\
             <details><summary>All parts, joints, notes and verdicts</summary><pre id=\"rest\">{}</pre></details>\n",
            if *is_good { "good" } else { "bad" },
            escaped(answer),
            lines(self.text),
            lines(self.rest)
        )
    }
}

/// Writes the page.
///
/// # Errors
/// Those of the writer.
pub(crate) fn write(
    out: &mut dyn Write,
    report: &Report,
    scene: &Scene,
    foreword: Option<&Foreword>,
) -> io::Result<()> {
    let mut numbers = Vec::new();
    let listing = Report {
        list_components: true,
        ..*report
    };
    report_json::write(&mut numbers, &listing)?;
    let drawing = serde_json::to_vec(&drawing(report, scene))?;
    let mut parts = TEMPLATE.split("{{");
    out.write_all(parts.next().unwrap_or_default().as_bytes())?;
    for part in parts {
        let (name, rest) = part.split_once("}}").expect("a field of the template ends");
        match name {
            "title" => out.write_all(escaped(&report.input.name).as_bytes())?,
            "policy" => write!(out, "script-src 'sha256-{}'", hash(SCRIPT))?,
            "style" => out.write_all(STYLE.as_bytes())?,
            "script" => out.write_all(SCRIPT.as_bytes())?,
            "kind" => out.write_all(
                foreword
                    .map_or("Viewing graph", |words| words.kind)
                    .as_bytes(),
            )?,
            "foreword" => {
                let words = foreword.map_or_else(String::new, Foreword::html);
                out.write_all(words.as_bytes())?;
            }
            "report" => embed(out, numbers.trim_ascii_end())?,
            "drawing" => embed(out, &drawing)?,
            "picture" => out.write_all(scene.svg(false).as_bytes())?,
            _ => unreachable!("the template has no field {name}"),
        }
        out.write_all(rest.as_bytes())?;
    }
    Ok(())
}

/// What the script needs besides the report.
fn drawing(report: &Report, scene: &Scene) -> Value {
    let graph = &report.input.graph;
    let mut degrees = vec![0u32; graph.nodes()];
    for &(i, j) in graph.edges() {
        degrees[i as usize] += 1;
        degrees[j as usize] += 1;
    }
    degrees.truncate(scene.names.len());
    let edges = scene.edges.iter().filter(|edge| edge.kind == Kind::Pair);
    let edges = edges.flat_map(|edge| [edge.ends.0, edge.ends.1]);
    let others =
        [Kind::Short, Kind::Suggested, Kind::Contradicting].map(|kind| scene.of_kind(kind));
    json!({
        "version": env!("CARGO_PKG_VERSION"),
        "names": scene.names,
        "degrees": degrees,
        // The lines, end after end, if the picture shows all nodes.
        "edges": scene.is_whole().then(|| edges.collect::<Vec<u32>>()),
        // How many lines are dashed, dotted and red.
        "others": others,
        "colours": COLOURS,
        // How many components, the first ones, have a mark of their own.
        "marked": scene.marked(),
        // The nodes of each metric component, if cameras have classes.
        "metric": report.scope.intrinsics().map(|found| found.nodes()),
    })
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
            "title", "policy", "style", "script", "kind", "foreword", "report", "drawing",
            "picture",
        ] {
            assert!(TEMPLATE.contains(&format!("{{{{{name}}}}}")), "{name}");
        }
    }
}
