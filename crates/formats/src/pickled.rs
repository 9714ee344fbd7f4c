//! A graph apart from its pairs, as text that another process can take up again.
//!
//! In: a graph as it was read. Out: its labels and all that was said, noted and counted of it, as JSON; and the
//! graph again. Pairs, the bulk of it, are left to whoever has better means for them. The
//! text is for the same version of the program: nothing is promised of other ones.

use crate::colmap::DatabaseFacts;
use crate::tracks::{Frames, TrackFacts};
use crate::{Matching, NamedGraph, ReadAs};
use serde::{Deserialize, Serialize};
use viewcert::graph::{Graph, Labels};

/// What a [`NamedGraph`] has beside its name and graph.
#[derive(Serialize, Deserialize)]
struct About {
    #[serde(with = "Named")]
    labels: Labels,
    read: ReadAs,
    notes: Vec<String>,
    matching: Option<Matching>,
    cameras: Option<u32>,
    database: Option<Box<DatabaseFacts>>,
    tracks: Option<TrackFacts>,
    frames: Option<Box<Frames>>,
}

/// [`Labels`] for serde.
#[derive(Serialize, Deserialize)]
#[serde(remote = "Labels")]
enum Named {
    Numbers { first: u64 },
    Integers(Vec<u64>),
    Names(Vec<Box<str>>),
    CamerasAndPoints(Vec<Box<str>>),
}

/// Why a text is not about a graph.
#[derive(Debug, thiserror::Error)]
pub enum NotAbout {
    /// It was not written by [`about`], or by another version.
    #[error("this was not kept by this version of viewcert: {0}")]
    Unreadable(#[from] serde_json::Error),
    /// It is about another graph.
    #[error("this was kept of another graph: {0}")]
    OtherGraph(&'static str),
}

/// All that is known of a graph beside its name and pairs. O(size).
///
/// # Errors
/// A position of an image that is not finite.
pub fn about(input: &NamedGraph) -> Result<String, NotAbout> {
    let input = input.clone();
    Ok(serde_json::to_string(&About {
        labels: input.labels,
        read: input.read,
        notes: input.notes,
        matching: input.matching,
        cameras: input.cameras,
        database: input.database,
        tracks: input.tracks,
        frames: input.frames,
    })?)
}

/// The graph that a text of [`about`] is about. O(size).
///
/// # Errors
/// Another text, or that of a graph of another size.
pub fn with_about(name: String, graph: Graph, text: &str) -> Result<NamedGraph, NotAbout> {
    let about: About = serde_json::from_str(text)?;
    let (nodes, pairs) = (graph.nodes(), graph.edges().len());
    let inliers = about
        .matching
        .as_ref()
        .map_or(0, |known| known.inliers.len());
    if inliers != 0 && inliers != pairs {
        return Err(NotAbout::OtherGraph("its pairs are not as many"));
    }
    let cameras = about.cameras.map_or(0, |cameras| cameras as usize);
    let fits = match &about.labels {
        Labels::Numbers { .. } => true,
        Labels::Integers(values) => values.len() == nodes,
        Labels::Names(names) => names.len() == nodes,
        Labels::CamerasAndPoints(names) => names.len() <= nodes,
    };
    if !fits || cameras > nodes {
        return Err(NotAbout::OtherGraph("its nodes are not as many"));
    }
    Ok(NamedGraph {
        name,
        graph,
        labels: about.labels,
        read: about.read,
        notes: about.notes,
        matching: about.matching,
        cameras: about.cameras,
        database: about.database,
        tracks: about.tracks,
        frames: about.frames,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pairs::with_inliers;

    #[test]
    fn a_graph_comes_back_with_all_that_is_known() {
        let labels = Labels::Names(["a", "b", "c"].map(Into::into).into());
        let pairs = vec![(0, 1), (1, 2), (0, 2)];
        let mut input = with_inliers("mine", 3, labels, pairs, &[20, 3, 17], 15).unwrap();
        let matching = input.matching.as_mut().unwrap();
        // Decimals that are no multiples of powers of two come back to the last bit.
        matching.positions = vec![None, Some([0.1, -1e-300, 1.0 / 3.0]), None];
        input.frames = Some(Box::default());
        let text = about(&input).unwrap();
        let again = |graph, text| with_about("mine".into(), graph, text);
        assert_eq!(again(input.graph.clone(), &text).unwrap(), input);
        for other in [Graph::new(3, [(0, 1)]), Graph::new(4, [(0, 1), (0, 3)])] {
            assert!(matches!(
                again(other.unwrap(), &text),
                Err(NotAbout::OtherGraph(_))
            ));
        }
        let cut = &text[..text.len() - 1];
        assert!(matches!(
            again(input.graph.clone(), cut),
            Err(NotAbout::Unreadable(_))
        ));
    }
}
