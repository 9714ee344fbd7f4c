//! What a graph determines whose cameras have classes of their own, in words and JSON (docs/theory.md,
//! section 17).
//!
//! In: sensors with their classes, what was found. Out: lines of a report, the member `intrinsics` of JSON.

use crate::condition;
use crate::shown::{row, several, some};
use serde::Serialize;
use std::io::{self, Write};
use viewcert::certificate::hex;
use viewcert::intrinsics::{Class, Metric, MetricComponent, Sensors};
use viewcert::wording::counted;
use viewcert_formats::NamedGraph;

/// The member `intrinsics`.
#[derive(Clone, Debug, Serialize)]
pub struct IntrinsicsLine {
    /// How many cameras are of each class.
    classes: Vec<ClassLine>,
    /// The sensors that several cameras share, the one with most cameras first.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    shared: Vec<SensorLine>,
    /// What a certificate and its checkers call them by.
    classes_sha256: String,
    verdict: &'static str,
    /// What it rests on, if the input is of photographs.
    #[serde(skip_serializing_if = "Option::is_none")]
    condition: Option<String>,
    /// Whether bounds meet: then all that is said is proved.
    proved: bool,
    rank: usize,
    rank_at_most: usize,
    rank_required: usize,
    /// The sum of the conditions of all cameras; a metric graph needs 8.
    conditions: usize,
    components: Vec<MetricLine>,
    /// Pairs that are in none of them.
    other_pairs: usize,
    /// How many cameras have intrinsics that are known or determined.
    determined: usize,
    /// The cameras whose intrinsics are not.
    not_determined: Vec<String>,
    /// The nodes of each of the components.
    #[serde(skip)]
    nodes: Vec<Vec<u32>>,
}

#[derive(Clone, Debug, Serialize)]
struct ClassLine {
    class: &'static str,
    cameras: usize,
}

/// Images with the same unknown intrinsics.
#[derive(Clone, Debug, Serialize)]
struct SensorLine {
    class: &'static str,
    cameras: usize,
    determined: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    labels: Option<Vec<String>>,
}

/// Pairs that are metric against each other.
#[derive(Clone, Debug, Serialize)]
struct MetricLine {
    nodes: usize,
    edges: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    labels: Option<Vec<String>>,
}

impl IntrinsicsLine {
    /// What was found for the sensors of a graph; with the members of each component and of each shared
    /// sensor if they are listed. O(n log n).
    pub fn new(input: &NamedGraph, sensors: &Sensors, found: &Metric, listed: bool) -> Self {
        let label = |node: u32| input.labels.label(node).into_owned();
        let line = |component: &MetricComponent| MetricLine {
            nodes: component.nodes.len(),
            edges: component.pairs,
            labels: listed.then(|| component.nodes.iter().map(|&v| label(v)).collect()),
        };
        let shared = |(sensor, nodes): (usize, Vec<u32>)| SensorLine {
            class: sensors.class(sensor).word(),
            cameras: nodes.len(),
            determined: found.determined[nodes[0] as usize],
            labels: listed.then(|| nodes.iter().map(|&v| label(v)).collect()),
        };
        let mut shared: Vec<SensorLine> = sensors.shared().into_iter().map(shared).collect();
        shared.sort_by_key(|line| std::cmp::Reverse(line.cameras));
        let classes: Vec<Class> = (0..sensors.nodes())
            .map(|v| sensors.class_of_node(v))
            .collect();
        let of_class = Class::ALL.map(|(class, word)| ClassLine {
            class: word,
            cameras: classes.iter().filter(|&&of| of == class).count(),
        });
        let not_determined: Vec<String> = (0..)
            .zip(&found.determined)
            .filter(|&(_, &determined)| !determined)
            .map(|(node, _)| label(node))
            .collect();
        Self {
            classes: of_class.into(),
            shared,
            classes_sha256: hex(&sensors.sha256()),
            verdict: found.verdict(),
            condition: input.database.as_deref().map(|facts| {
                let is_known = classes.iter().all(|&class| class == Class::Known);
                condition::if_right(input) + condition::axes(is_known, facts)
            }),
            proved: found.is_proved(),
            rank: found.rank,
            rank_at_most: found.at_most,
            rank_required: found.required,
            conditions: found.conditions,
            components: found.components.iter().map(line).collect(),
            other_pairs: found.other_pairs,
            determined: found.determined.len() - not_determined.len(),
            not_determined,
            nodes: found
                .components
                .iter()
                .map(|component| component.nodes.clone())
                .collect(),
        }
    }

    /// Under one condition more.
    pub(crate) fn under(self, more: &str) -> Self {
        let condition = condition::with(self.condition, &[more.to_owned()]);
        Self { condition, ..self }
    }

    /// Whether several cameras share unknown intrinsics.
    pub(crate) fn is_shared(&self) -> bool {
        !self.shared.is_empty()
    }

    /// The nodes of each metric component, the largest first.
    pub(crate) fn nodes(&self) -> &[Vec<u32>] {
        &self.nodes
    }

    /// What is found for the pairs of a database by what it knows of its cameras, in one sentence.
    pub(crate) fn words_of_database(&self) -> String {
        let answer = match self.verdict {
            "metric" => "metric",
            "not-metric" => "not metric",
            _ => "open whether metric",
        };
        let parts = match self.components.first() {
            None => "no metric part".to_owned(),
            Some(largest) => format!(
                "{}, largest {}",
                counted(self.components.len(), "part"),
                counted(largest.nodes, "camera")
            ),
        };
        let strength = if self.proved { " (proved)" } else { "" };
        let sensors = match self.shared.len() {
            0 => String::new(),
            count => format!(" ({})", counted(count, "shared sensor")),
        };
        format!(
            "{}{sensors}: {answer}; {parts}; the intrinsics of {} of {} known or determined{}{strength}",
            self.classes_in_words(),
            self.determined,
            self.determined + self.not_determined.len(),
            self.condition()
        )
    }

    /// The condition, behind a blank, if there is one.
    fn condition(&self) -> String {
        let words = self.condition.iter();
        words.map(|words| format!(" {words}")).collect()
    }

    /// "2 known, 3 focal".
    fn classes_in_words(&self) -> String {
        let classes = self.classes.iter().filter(|line| line.cameras > 0);
        let classes = classes.map(|line| format!("{} {}", line.cameras, line.class));
        classes.collect::<Vec<_>>().join(", ")
    }

    /// Whether all cameras are determined, with their intrinsics; it is proved.
    pub fn is_metric(&self) -> bool {
        self.verdict == "metric"
    }

    /// Writes the lines of a report.
    ///
    /// # Errors
    /// Those of the writer.
    pub(crate) fn write(&self, out: &mut impl Write) -> io::Result<()> {
        let answer = match self.verdict {
            "metric" => format!(
                "metric: all cameras and intrinsics, up to similarities and finitely many choices{} (proved)",
                self.condition()
            ),
            "not-metric" if self.conditions < 8 => format!(
                "not metric: {} intrinsics put {} on the 8 numbers between a projective and a metric scene (proved)",
                if self.is_shared() {
                    "known and shared"
                } else {
                    "known"
                },
                counted(self.conditions, "condition")
            ),
            "not-metric" => "not metric: infinitely many sets of cameras (proved)".into(),
            _ => "not metric at drawn cameras, and counting gives no proof".to_owned(),
        };
        writeln!(out, "  intrinsics  {}: {answer}", self.classes_in_words())?;
        self.write_shared(out)?;
        let (rank, most, required) = (self.rank, self.rank_at_most, self.rank_required);
        let rank = match self.proved {
            true => format!("{rank} of {required} (proved)"),
            false => format!("{rank} at least and {most} at most, of {required}"),
        };
        row(out, "metric rank", rank)?;
        let (determined, condition) = (self.determined, self.condition());
        let all = determined + self.not_determined.len();
        let not = match &self.not_determined[..] {
            [] => String::new(),
            [only] => format!("; not of {only}"),
            [first, .., last] => format!("; not of {first} .. {last}"),
        };
        let words = format!("the intrinsics of {determined} of {all}{condition}{not}");
        row(out, "determined", words)?;
        let sizes: Vec<usize> = self.components.iter().map(|line| line.nodes).collect();
        let sizes = match several(&sizes, ", ") {
            none if none.is_empty() => none,
            sizes => format!(" of {sizes} cameras"),
        };
        let components = counted(self.components.len(), "component");
        let pairs = counted(self.other_pairs, "pair");
        row(
            out,
            "metric part",
            format!("{components}{sizes}; {pairs} in none"),
        )?;
        row(out, "classes", format!("SHA-256 {}", self.classes_sha256))?;
        for (k, line) in (1..).zip(&self.components) {
            if let Some(labels) = &line.labels {
                writeln!(out, "  metric component {k}: {}", labels.join(" "))?;
            }
        }
        for (k, line) in (1..).zip(&self.shared) {
            if let Some(labels) = &line.labels {
                writeln!(out, "  sensor {k}: {}", labels.join(" "))?;
            }
        }
        Ok(())
    }

    fn write_shared(&self, out: &mut impl Write) -> io::Result<()> {
        if self.shared.is_empty() {
            return Ok(());
        }
        let lines = self.shared.iter().map(|line| {
            let not = if line.determined { "" } else { "not " };
            format!("{} {} ({not}determined)", line.cameras, line.class)
        });
        let lines = some(&lines.collect::<Vec<_>>(), ", ");
        let count = counted(self.shared.len(), "sensor");
        row(out, "shared", format!("{count}: {lines}"))
    }
}
