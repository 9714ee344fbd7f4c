//! What to do about a verdict: options of `verify GRAPH`, and what they find.
//!
//! In: a graph as it was read, and its verdict. Out: joints, weak pairs, suggestions and the rest
//! in the user's names, as JSON has them ([`Acted`]) and as text; folders for COLMAP. The
//! mathematics is in the crate viewcert-reconstruction; docs/reconstruction.md describes it all.

mod export;
mod found;
mod text;
mod words;

pub(super) use export::shell;
pub(crate) use found::Acted;
pub(crate) use text::joints as write_joints;
pub(super) use text::write;

use anyhow::{Context, Result, anyhow, ensure};
use clap::{Args, ValueEnum};
use found::Names;
use std::path::{Path, PathBuf};
use viewcert::decide::{Options, Question};
use viewcert::watch::Watch;
use viewcert::{Strength, Verdict};
use viewcert_formats::NamedGraph;
use viewcert_reconstruction as reconstruction;
use viewcert_reconstruction::margin::MISSING;
use viewcert_reconstruction::suggest::Wanted;
use viewcert_reconstruction::{Known, OtherPair, Parts, Shapes, Thinning};
use viewcert_session::Outputs;

/// Options about what to do.
#[derive(Args, Default)]
#[command(next_help_heading = "What to do about a verdict")]
pub(super) struct ActArguments {
    /// Find the pairs (`--weak=images`: the images) without which a component falls apart.
    #[arg(long, value_name = "WHAT", num_args = 0..=1, require_equals = true)]
    #[arg(value_enum, default_missing_value = "pairs")]
    pub(crate) weak: Option<Weak>,
    /// Suggest images to match that would join components, at most N [default: 10]; with --tracks
    /// also how much has to come of it.
    #[arg(long, value_name = "N", num_args = 0..=1, require_equals = true)]
    #[arg(default_missing_value = "10", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) suggest: Option<u32>,
    /// Explain an image: its components, its pairs, what it would need.
    #[arg(long, value_name = "IMAGE")]
    pub(crate) explain: Option<String>,
    /// Decide again with at least so many inliers per pair, for each number (of a database).
    #[arg(long, value_name = "N,N,...", value_delimiter = ',')]
    pub(crate) sweep: Vec<u32>,
    /// Leave out pairs (or tracks) at random, N times for each of several shares, and say how often
    /// the components stay whole [default: 10].
    #[arg(long, value_name = "N", num_args = 0..=1, require_equals = true)]
    #[arg(default_missing_value = "10", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub(crate) margin: Option<u32>,
    /// Write the components to this folder, as COLMAP takes them.
    #[arg(long, value_name = "DIR")]
    pub(crate) export: Option<PathBuf>,
}

/// What a component may hang on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Weak {
    /// Pairs.
    Pairs,
    /// Images.
    Images,
}

/// Most joints that are computed.
const JOINTS: usize = 10_000;

/// Most pairs without enough inliers that `--explain` shows, and most suggestions.
const EXPLAINED: usize = 5;

impl ActArguments {
    /// Refuses what can be refused before a graph is read.
    ///
    /// # Errors
    /// A folder with something else in it, or with an input or another output.
    pub(super) fn check(
        &self,
        inputs: &[PathBuf],
        outputs: &[(&str, Option<&Path>)],
    ) -> Result<()> {
        let Some(folder) = self.export.as_deref() else {
            return Ok(());
        };
        export::check(folder)?;
        export::ensure_outside(folder, inputs, outputs)
    }

    /// Why there cannot be several graphs, if there cannot.
    pub(super) fn too_many(&self, what: &str) -> Option<String> {
        let folder = self.export.as_ref()?.display();
        Some(format!(
            "--export {folder}: a folder holds the components of one graph, and there are {what}; \
             run them one by one"
        ))
    }

    /// The first option that weighs the pairs of a graph and nothing else, if there is one.
    pub(super) fn asked_of_pairs(&self) -> Option<&'static str> {
        let asked = [
            (self.weak.is_some(), "--weak"),
            (self.suggest.is_some(), "--suggest"),
            (self.explain.is_some(), "--explain"),
            (!self.sweep.is_empty(), "--sweep"),
            (self.margin.is_some(), "--margin"),
        ];
        let mut asked = asked.into_iter();
        asked.find_map(|(asked, option)| asked.then_some(option))
    }

    /// Refuses what a graph has no answer to.
    ///
    /// # Errors
    /// What is missing in it.
    pub(super) fn check_input(&self, input: &NamedGraph) -> Result<()> {
        ensure!(
            self.sweep.is_empty() || input.cameras.is_none(),
            "--sweep decides graphs of pairs; leave out --tracks, or ask for tracks with each \
             --min-inliers in turn"
        );
        ensure!(
            self.sweep.is_empty() || input.matching.is_some(),
            "--sweep needs the number of inliers of every pair, which only a COLMAP database has; \
             leave it out, or name the database"
        );
        Ok(())
    }

    /// One of the options that is there, for whoever has no use for it; and whether there is one.
    pub(super) fn asked(&self) -> (&'static str, bool) {
        let export = self.export.is_some().then_some("--export");
        let asked = self.asked_of_pairs().or(export);
        (asked.unwrap_or_default(), asked.is_some())
    }

    /// Whether more than the joints is asked for.
    fn asks(&self) -> bool {
        self.asked().1
    }

    /// Does what is asked for; joints are always looked for, but with known displacements, which
    /// join components in ways of their own. What they leave free is kept in
    /// `shapes` for the next graph of the same model.
    ///
    /// # Errors
    /// Those of decisions and of the folder; an image that is not there; work that was stopped.
    pub(super) fn act(
        &self,
        outputs: &Outputs,
        input: &NamedGraph,
        verdict: &Verdict,
        seed: u64,
        shapes: &mut Shapes,
        watch: Watch,
    ) -> Result<Acted> {
        if let Some(option) = self.asked_of_pairs() {
            ensure!(
                verdict.known_parts.is_empty(),
                "{option} weighs the pairs of a graph alone, and this verdict rests on known parts; \
                 leave out one of the two"
            );
        }
        if !verdict.displacements.is_empty() {
            return Ok(Acted::without_joints(verdict.components.len() < 2));
        }
        if verdict.components.len() < 2 && !self.asks() {
            return Ok(Acted::whole());
        }
        let others: Vec<OtherPair> = input.matching.iter().flat_map(others).collect();
        let task = Task::new(input, verdict, &others, seed, watch);
        let (mut acted, joints) = task.joints(shapes)?;
        if let Some(what) = self.weak {
            acted.weak = Some(task.weak(what)?);
        }
        if let Some(most) = self.suggest {
            acted.suggestions = Some(task.suggest(&joints, most as usize, None)?);
        }
        if let Some(image) = &self.explain {
            acted.explain = Some(task.explain(&joints, image)?);
        }
        if !self.sweep.is_empty() {
            acted.sweep = Some(task.sweep(&self.sweep)?);
        }
        if let Some(draws) = self.margin {
            acted.margin = Some(task.margin(draws, seed)?);
        }
        if let Some(folder) = &self.export {
            acted.export = Some(export::write(outputs, folder, &task, &acted.joints)?);
        }
        Ok(acted)
    }
}

/// The joints alone.
///
/// # Errors
/// Those of a decision.
pub(super) fn joints(
    input: &NamedGraph,
    verdict: &Verdict,
    seed: u64,
    watch: Watch,
) -> Result<Acted> {
    let task = Task::new(input, verdict, &[], seed, watch);
    Ok(task.joints(&mut Shapes::default())?.0)
}

fn others(known: &viewcert_formats::Matching) -> impl Iterator<Item = OtherPair> + '_ {
    known.others.iter().map(|pair| OtherPair {
        images: pair.images,
        inliers: pair.inliers,
        matches: pair.matches,
        used: pair.used,
    })
}

/// A graph that something is done about.
struct Task<'a> {
    input: &'a NamedGraph,
    verdict: &'a Verdict,
    parts: Parts,
    known: Known<'a>,
    names: Names<'a>,
    options: Options,
}

impl<'a> Task<'a> {
    fn new(
        input: &'a NamedGraph,
        verdict: &'a Verdict,
        others: &'a [OtherPair],
        seed: u64,
        watch: Watch,
    ) -> Self {
        Self {
            input,
            verdict,
            parts: Parts::new(&input.graph, verdict),
            known: Known {
                inliers: input.matching.as_ref().map_or(&[], |known| &known.inliers),
                others,
            },
            names: Names::new(input),
            options: Options::default()
                .question(Question::without_solutions(verdict.model))
                .seed(seed)
                .watch(watch),
        }
    }

    /// The joints, in the user's names and as they were found.
    fn joints(&self, shapes: &mut Shapes) -> Result<(Acted, Vec<reconstruction::Joint>)> {
        let (graph, parts) = (&self.input.graph, &self.parts);
        let found =
            reconstruction::joints(graph, self.verdict, parts, &self.options, JOINTS, shapes)
                .context("joints")?;
        let joints = found.joints.iter().map(|joint| self.joint(joint)).collect();
        let acted = Acted {
            joints,
            joints_complete: found.complete,
            of_tracks: self.input.cameras.is_some(),
            single_pairs_only: self.parts.parts.is_empty(),
            is_whole: self
                .verdict
                .components
                .iter()
                .any(|component| component.node_count() == graph.nodes()),
            ..Acted::default()
        };
        Ok((acted, found.joints))
    }

    fn joint(&self, joint: &reconstruction::Joint) -> found::Joint {
        let how = &joint.how;
        let inliers = |&(a, b): &(u32, u32)| {
            let edge = self.input.graph.edge_number(a, b)?;
            self.known.inliers.get(edge).copied()
        };
        let shared = how.shared.iter().copied();
        let ends = how.pairs.iter().flat_map(|&(a, b)| [a, b]);
        let through = how.through.iter().flat_map(|by| by.iter().copied());
        let mut images: Vec<u32> = shared.chain(ends).chain(through).collect();
        images.sort_unstable();
        images.dedup();
        let known: Option<Vec<u32>> = how.pairs.iter().map(inliers).collect();
        found::Joint {
            between: joint.components.map(number),
            how: words::how(how, self.input.cameras),
            images: images.into_iter().map(|v| self.names.of(v)).collect(),
            pairs: how
                .pairs
                .iter()
                .map(|&pair| self.names.pair(pair))
                .collect(),
            through: how
                .through
                .iter()
                .map(|by| by.map(|v| self.names.of(v)))
                .collect(),
            crossing: how.pairs.len() + how.through.len(),
            inliers: known.filter(|known| !known.is_empty()),
            freedom: joint.freedom,
            meaning: words::meaning(self.verdict.model, joint.freedom),
            strength: joint.strength.name(),
        }
    }

    fn weak(&self, what: Weak) -> Result<found::Weak> {
        let graph = &self.input.graph;
        let item = |what, component, why, strength: Strength| found::WeakItem {
            what,
            component: number(component),
            why: words::why(why, &self.names),
            strength: strength.name(),
        };
        let items = match what {
            Weak::Pairs => reconstruction::weak_pairs(graph, &self.parts, &self.options)
                .context("--weak")?
                .into_iter()
                .map(|weak| {
                    let (a, b) = weak.pair;
                    let names = vec![self.names.of(a), self.names.of(b)];
                    item(names, weak.component, weak.why, weak.strength)
                })
                .collect(),
            Weak::Images => reconstruction::weak_images(graph, &self.parts, &self.options)
                .context("--weak=images")?
                .into_iter()
                .map(|weak| {
                    let name = vec![self.names.of(weak.image)];
                    item(name, weak.component, weak.why, weak.strength)
                })
                .collect(),
        };
        Ok(found::Weak {
            of: match (what, self.input.cameras) {
                (Weak::Pairs, None) => "pairs",
                (Weak::Pairs, Some(_)) => "observations",
                (Weak::Images, None) => "images",
                (Weak::Images, Some(_)) => "cameras and points",
            },
            items,
            single_pairs: self.parts.links.len(),
        })
    }

    fn suggest(
        &self,
        joints: &[reconstruction::Joint],
        most: usize,
        at: Option<u32>,
    ) -> Result<Vec<found::Suggestion>> {
        let wanted = Wanted { most, at };
        if let Some(cameras) = self.input.cameras {
            return self.suggest_matches(cameras, joints, wanted);
        }
        let (graph, parts, known) = (&self.input.graph, &self.parts, self.known);
        let found = reconstruction::suggest(graph, parts, joints, known, wanted, &self.options);
        let named = found.context("--suggest")?.into_iter().map(|found| {
            let (links, joins) = self.links_and_parts(&found.components);
            let known = |pick: fn(OtherPair) -> Option<u32>| {
                let all: Option<Vec<u32>> = found
                    .pairs
                    .iter()
                    .map(|&(_, known)| known.and_then(pick))
                    .collect();
                all
            };
            found::Suggestion {
                pairs: found
                    .pairs
                    .iter()
                    .map(|&(pair, _)| self.names.pair(pair))
                    .collect(),
                inliers: known(|pair| Some(pair.inliers)),
                matches: known(|pair| pair.matches),
                joins,
                single_pairs: links,
                images: found.images,
                gain: found.gain,
                enough: None,
            }
        });
        Ok(named.collect())
    }

    /// How many of some components are single pairs, and the numbers of the others.
    fn links_and_parts(&self, components: &[usize]) -> (usize, Vec<usize>) {
        let single = |component: usize| self.verdict.components[component].node_count() == 2;
        let larger = components.iter().filter(|&&component| !single(component));
        let larger: Vec<usize> = larger.copied().map(number).collect();
        (components.len() - larger.len(), larger)
    }

    /// The same in a camera-point graph.
    fn suggest_matches(
        &self,
        cameras: u32,
        joints: &[reconstruction::Joint],
        wanted: Wanted,
    ) -> Result<Vec<found::Suggestion>> {
        let (graph, parts, known) = (&self.input.graph, &self.parts, self.known);
        let options = &self.options;
        let found =
            reconstruction::suggest_matches(graph, parts, cameras, joints, known, wanted, options);
        let named = found.context("--suggest")?.into_iter().map(|found| {
            let (links, joins) = self.links_and_parts(&found.components);
            let known = found.known;
            found::Suggestion {
                pairs: vec![self.names.pair(found.cameras)],
                inliers: known.map(|known| vec![known.inliers]),
                matches: known.and_then(|known| Some(vec![known.matches?])),
                joins,
                single_pairs: links,
                images: found.images,
                gain: found.gain,
                enough: Some(found::Enough {
                    observations: self.further(&found.observations),
                    merged: found.merged,
                    matched: known.is_some_and(|known| known.used),
                }),
            }
        });
        Ok(named.collect())
    }

    /// Further observations, by the camera and the component whose points it would see.
    fn further(&self, observations: &[(u32, u32)]) -> Vec<found::Further> {
        let mut further: Vec<found::Further> = Vec::new();
        for &(camera, point) in observations {
            let part = self.parts.of(point)[0] as usize;
            let component = number(self.parts.parts[part].component);
            let image = self.names.of(camera);
            let same = |one: &&mut found::Further| one.image == image && one.component == component;
            match further.iter_mut().find(same) {
                Some(one) => one.points += 1,
                None => further.push(found::Further {
                    image,
                    component,
                    points: 1,
                }),
            }
        }
        further
    }

    fn explain(&self, joints: &[reconstruction::Joint], image: &str) -> Result<found::Explain> {
        let node = self.names.find(image)?;
        let (graph, parts) = (&self.input.graph, &self.parts);
        let found = reconstruction::explain(graph, parts, self.known, node, EXPLAINED);
        let suggestions = self.suggest(joints, EXPLAINED, Some(node))?;
        let other = |(a, b): (u32, u32)| self.names.of(a + b - node);
        Ok(found::Explain {
            image: image.to_owned(),
            components: found.components.into_iter().map(number).collect(),
            pairs_inside: found.inside,
            pairs_outside: found
                .links
                .into_iter()
                .map(|link| found::Outside {
                    image: self.names.of(link.other),
                    inliers: link.inliers,
                    reaches: link.reaches.into_iter().map(number).collect(),
                })
                .collect(),
            unused: found
                .others
                .into_iter()
                .map(|pair| found::Unused {
                    image: other(pair.images),
                    inliers: pair.inliers,
                    matches: pair.matches,
                })
                .collect(),
            suggestions,
        })
    }

    fn sweep(&self, thresholds: &[u32]) -> Result<Vec<found::SweepRow>> {
        let graph = &self.input.graph;
        let rows = reconstruction::sweep(graph, self.known, thresholds, &self.options);
        let rows = rows.context("--sweep")?;
        let named = rows.into_iter().map(|row| found::SweepRow {
            threshold: row.threshold,
            pairs: row.pairs,
            images: row.images,
            connected: row.connected,
            components: row.parts,
            single_pairs: row.links,
            largest: row.largest,
            verdict: row.value.name(),
        });
        Ok(named.collect())
    }

    fn margin(&self, draws: u32, seed: u64) -> Result<found::Margin> {
        let thinning = Thinning { draws, seed };
        let (graph, cameras) = (&self.input.graph, self.input.cameras);
        let found = reconstruction::margin(graph, &self.parts, cameras, thinning, &self.options);
        let parts = found.context("--margin")?.into_iter();
        Ok(found::Margin {
            of: if cameras.is_some() { "tracks" } else { "pairs" },
            draws,
            seed,
            missing: MISSING,
            components: parts
                .map(|part| found::MarginOf {
                    component: number(part.component),
                    whole: part.whole,
                    together: part
                        .together
                        .map(|sum| 100 * sum / (u64::from(draws) * part.images as u64)),
                })
                .collect(),
        })
    }
}

/// How people count components.
fn number(component: usize) -> usize {
    component + 1
}

/// An image that is not in the graph.
fn unknown(image: &str, example: Option<String>) -> anyhow::Error {
    let example = example.map_or(String::new(), |name| format!(", such as {name}"));
    anyhow!("--explain {image}: no image has this name; names are those of the input{example}")
}
