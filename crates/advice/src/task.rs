//! One graph that advice is asked about: what the mathematics finds, in the user's names.

use crate as advice;
use crate::mapper::Thresholds;
use crate::named::{self, Advice, Names};
use crate::suggest::{IMAGE_NEEDS, PAIR_NEEDS, Wanted};
use crate::words::Scales;
use crate::{Candidate, Known, Nearness, OtherPair, Parts, words};
use anyhow::{Context, Result};
use std::collections::BTreeMap;
use viewcert::decide::{Options, Question};
use viewcert::watch::Watch;
use viewcert::{Value, Verdict};
use viewcert_formats::NamedGraph;

/// What a component may hang on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Weak {
    /// Pairs.
    Pairs,
    /// Images.
    Images,
}

/// Most joints that are computed.
const JOINTS: usize = 10_000;

/// Most pairs without enough inliers that an image is explained with, and most suggestions.
const EXPLAINED: usize = 5;

/// A graph that something is done about.
pub(crate) struct Task<'a> {
    pub(crate) input: &'a NamedGraph,
    pub(crate) verdict: &'a Verdict,
    pub(crate) parts: Parts,
    pub(crate) known: Known<'a>,
    pub(crate) names: Names<'a>,
    pub(crate) options: Options,
}

impl<'a> Task<'a> {
    pub(crate) fn new(
        input: &'a NamedGraph,
        verdict: &'a Verdict,
        seed: u64,
        watch: Watch,
    ) -> Self {
        Self {
            input,
            verdict,
            parts: Parts::new(&input.graph, verdict),
            known: input
                .matching
                .as_ref()
                .map_or(Known::default(), |known| Known {
                    inliers: &known.inliers,
                    others: &known.others,
                    near: None,
                }),
            names: Names::new(input),
            options: Options::default()
                .question(Question::without_solutions(verdict.model))
                .seed(seed)
                .watch(watch),
        }
    }

    /// The joints, in the user's names and as they were found.
    pub(crate) fn joints(&self) -> Result<(Advice, Vec<advice::Joint>)> {
        let (graph, parts) = (&self.input.graph, &self.parts);
        let found =
            advice::joints(graph, self.verdict, parts, &self.options, JOINTS).context("joints")?;
        let joints = found.joints.iter().map(|joint| self.joint(joint)).collect();
        let named = Advice {
            joints,
            joints_complete: found.complete,
            of_tracks: self.input.cameras.is_some(),
            single_pairs_only: self.parts.parts.is_empty(),
            is_whole: self
                .verdict
                .components
                .iter()
                .any(|component| component.node_count() == graph.nodes()),
            ..Advice::default()
        };
        Ok((named, found.joints))
    }

    fn joint(&self, joint: &advice::Joint) -> named::Joint {
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
        named::Joint {
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
            meaning: words::meaning(self.verdict.model, joint.freedom, self.scales(joint)),
            strength: joint.strength.name(),
        }
    }

    /// What is known of scales at a joint.
    fn scales(&self, joint: &advice::Joint) -> Scales {
        let by = joint.how.through.iter();
        let by = by.flat_map(|&[a, x, b]| [(a, x), (x, b)]);
        let mut between = joint.how.pairs.iter().copied().chain(by);
        match joint.components.map(|k| self.parts.is_scaled(k)) {
            [true, true] => Scales::Both,
            _ if between.any(|pair| self.parts.is_displacement(pair)) => Scales::Between,
            _ => Scales::Free,
        }
    }

    pub(crate) fn weak(&self, what: Weak) -> Result<named::Weak> {
        let (graph, parts) = (&self.input.graph, &self.parts);
        let found = match what {
            Weak::Pairs => advice::weak_pairs(graph, parts, &self.options).context("--weak")?,
            Weak::Images => {
                advice::weak_images(graph, parts, &self.options).context("--weak=images")?
            }
        };
        let items = found.into_iter().map(|weak| named::WeakItem {
            what: weak.nodes.iter().map(|&v| self.names.of(v)).collect(),
            component: number(weak.component),
            why: words::why(weak.why, &self.names),
            strength: weak.strength.name(),
        });
        Ok(named::Weak {
            of: match (what, self.input.cameras) {
                (Weak::Pairs, None) => "pairs",
                (Weak::Pairs, Some(_)) => "observations",
                (Weak::Images, None) => "images",
                (Weak::Images, Some(_)) => "cameras and points",
            },
            kept: match self.verdict.model.is_linear() {
                true => Value::Solvable.name(),
                false => Value::FiniteSolvable.name(),
            },
            items: items.collect(),
            single_pairs: parts.links.len(),
        })
    }

    /// Where a photograph would help, if all that could be matched was.
    pub(crate) fn photograph(&self) -> Option<named::Photograph> {
        self.input.matching.as_ref()?;
        let images = self.names.images();
        let near = self.near();
        let known = Known {
            near: Some(&near),
            ..self.known
        };
        let (a, b) = advice::gap(&self.input.graph, &self.parts, known, images.end)?;
        let group = |v: u32| match self.parts.of(v) {
            [] => vec![self.names.of(v)],
            [part, ..] => {
                let nodes = self.parts.parts[*part as usize].nodes.iter();
                let cameras = nodes.filter(|v| images.contains(*v));
                cameras.map(|&v| self.names.of(v)).collect()
            }
        };
        Some(named::Photograph {
            between: self.names.pair((a, b)),
            groups: [group(a), group(b)],
        })
    }

    /// What says which images are near each other: names and positions.
    fn near(&self) -> Nearness {
        let names: Vec<String> = self.names.images().map(|v| self.names.of(v)).collect();
        let matching = self.input.matching.as_ref();
        Nearness::new(&names, matching.map_or(&[], |known| &known.positions))
    }

    pub(crate) fn suggest(
        &self,
        joints: &[advice::Joint],
        most: usize,
        at: Option<u32>,
    ) -> Result<Vec<named::Suggestion>> {
        let wanted = Wanted { most, at };
        let near = self.near();
        let known = Known {
            near: Some(&near),
            ..self.known
        };
        if let Some(cameras) = self.input.cameras {
            return self.suggest_matches(cameras, known, wanted);
        }
        let (graph, parts) = (&self.input.graph, &self.parts);
        let found = advice::suggest(graph, parts, joints, known, wanted, &self.options);
        let named = found.context("--suggest")?.into_iter().map(|found| {
            let (links, frames, joins) = self.links_and_parts(&found.components);
            let known = |pick: fn(OtherPair) -> Option<u32>| {
                let all: Option<Vec<u32>> = found
                    .pairs
                    .iter()
                    .map(|&(_, known)| known.and_then(pick))
                    .collect();
                all
            };
            named::Suggestion {
                pairs: found
                    .pairs
                    .iter()
                    .map(|&(pair, _)| self.names.pair(pair))
                    .collect(),
                open: self.open(&found.candidates),
                also: Vec::new(),
                inliers: known(|pair| Some(pair.inliers)),
                matches: known(|pair| pair.matches),
                joins,
                single_pairs: links,
                frames,
                images: found.images,
                gain: found.gain,
                tried: self.tried(&found.candidates),
                why: self.reasons(&found.candidates),
                needs: self.needs(),
                enough: None,
            }
        });
        Ok(named.collect())
    }

    /// What has become of matching some pairs, if the input says anything of that.
    fn tried(&self, candidates: &[Candidate]) -> Option<Vec<&'static str>> {
        let tried = candidates.iter().map(|one| one.tried.name());
        self.input.matching.as_ref().map(|_| tried.collect())
    }

    fn reasons(&self, candidates: &[Candidate]) -> Vec<String> {
        let reasons = candidates.iter();
        reasons
            .map(|one| words::reason(one.reason, &self.names))
            .collect()
    }

    /// What mappers need, where images are matched.
    fn needs(&self) -> Option<named::Needs> {
        self.input.matching.as_ref().map(|_| named::Needs {
            inliers: PAIR_NEEDS,
            points: IMAGE_NEEDS,
        })
    }

    /// How many of some components are single pairs, how many frames without points, and the numbers
    /// of the others.
    fn links_and_parts(&self, components: &[usize]) -> (usize, usize, Vec<usize>) {
        let of = |component: usize| &self.verdict.components[component];
        let is_frame = |&component: &usize| of(component).edge_count() == 0;
        let (frames, others): (Vec<usize>, Vec<usize>) =
            components.iter().partition(|k| is_frame(k));
        let larger = others.iter().filter(|&&k| of(k).node_count() > 2);
        let larger: Vec<usize> = larger.copied().map(number).collect();
        (others.len() - larger.len(), frames.len(), larger)
    }

    /// The same in a camera-point graph.
    fn suggest_matches(
        &self,
        cameras: u32,
        known: Known,
        wanted: Wanted,
    ) -> Result<Vec<named::Suggestion>> {
        let (graph, parts) = (&self.input.graph, &self.parts);
        let options = &self.options;
        let found = advice::suggest_matches(graph, parts, cameras, known, wanted, options);
        let named = found.context("--suggest")?.into_iter().map(|found| {
            let (links, frames, joins) = self.links_and_parts(&found.components);
            let known = found.known;
            named::Suggestion {
                pairs: vec![self.names.pair(found.cameras)],
                open: self.open(&[found.candidate]),
                also: self.also(found.cameras),
                inliers: known.map(|known| vec![known.inliers]),
                matches: known.and_then(|known| Some(vec![known.matches?])),
                joins,
                single_pairs: links,
                frames,
                images: found.images,
                gain: found.gain,
                tried: self.tried(&[found.candidate]),
                why: self.reasons(&[found.candidate]),
                needs: self.needs(),
                enough: Some(named::Enough {
                    observations: self.further(&found.observations),
                    matched: known.is_some_and(|known| known.used),
                }),
            }
        });
        Ok(named.collect())
    }

    /// The pairs of images that are left to match: a camera may stand for several images.
    fn open(&self, candidates: &[Candidate]) -> Vec<[String; 2]> {
        let open = candidates.iter().filter(|one| one.tried.is_open());
        let images = open.flat_map(|one| {
            let (a, b) = one.pair;
            let with = move |a: String| self.names.all_of(b).map(move |b| [a.clone(), b]);
            self.names.all_of(a).flat_map(with)
        });
        images.collect()
    }

    /// The images that were taken at the place of one of two, besides the one that has its name.
    fn also(&self, (a, b): (u32, u32)) -> Vec<String> {
        let others = [a, b].into_iter().map(|v| self.names.all_of(v).skip(1));
        others.flatten().collect()
    }

    /// Further observations, by the camera and the component whose points it would see.
    fn further(&self, observations: &[(u32, u32)]) -> Vec<named::Further> {
        let mut further: Vec<named::Further> = Vec::new();
        for &(camera, point) in observations {
            let part = self.parts.of(point)[0] as usize;
            let component = number(self.parts.parts[part].component);
            let image = self.names.of(camera);
            let same = |one: &&mut named::Further| one.image == image && one.component == component;
            match further.iter_mut().find(same) {
                Some(one) => one.points += 1,
                None => further.push(named::Further {
                    image,
                    component,
                    points: 1,
                }),
            }
        }
        further
    }

    pub(crate) fn explain(&self, joints: &[advice::Joint], image: &str) -> Result<named::Explain> {
        let node = self.names.find(image)?;
        let (graph, parts) = (&self.input.graph, &self.parts);
        let found = advice::explain(graph, parts, self.known, node, EXPLAINED);
        let suggestions = self.suggest(joints, EXPLAINED, Some(node))?;
        let other = |(a, b): (u32, u32)| self.names.of(a + b - node);
        Ok(named::Explain {
            image: image.to_owned(),
            components: found.components.into_iter().map(number).collect(),
            pairs_inside: found.inside,
            pairs_outside: found
                .links
                .into_iter()
                .map(|link| named::Outside {
                    image: self.names.of(link.other),
                    inliers: link.inliers,
                    reaches: link.reaches.into_iter().map(number).collect(),
                })
                .collect(),
            sees: self.input.cameras.map(|_| self.sees(node)),
            unused: found
                .others
                .into_iter()
                .map(|pair| named::Unused {
                    image: other(pair.images),
                    inliers: pair.inliers,
                    matches: pair.matches,
                })
                .collect(),
            suggestions,
        })
    }

    /// How many points of each component an image sees.
    fn sees(&self, image: u32) -> Vec<named::SeesOf> {
        let mut counts: BTreeMap<usize, usize> = BTreeMap::new();
        for &(_, point) in self.input.graph.edges_from(image) {
            for &part in self.parts.of(point) {
                let component = self.parts.parts[part as usize].component;
                *counts.entry(number(component)).or_default() += 1;
            }
        }
        let needs = Thresholds::default().abs_pose_min_num_inliers;
        let counts = counts.into_iter().map(|(component, points)| named::SeesOf {
            component,
            points,
            needs,
        });
        let mut sees: Vec<named::SeesOf> = counts.collect();
        sees.sort_by_key(|sees| std::cmp::Reverse(sees.points));
        sees
    }
}

/// How people count components.
pub(crate) fn number(component: usize) -> usize {
    component + 1
}
