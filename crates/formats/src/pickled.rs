//! A graph apart from its pairs and labels, as text that another process can take up again.
//!
//! In: a graph as it was read. Out: all that was said, noted and counted of it, as JSON; and the
//! graph again. Pairs and labels, the bulk of it, are left to whoever has better means for them. The
//! text is for the same version of the program: nothing is promised of other ones.

use crate::colmap::DatabaseFacts;
use crate::tracks::{Frames, TrackFacts};
use crate::{Matching, NamedGraph, ReadAs};
use serde::{Deserialize, Serialize};
use viewcert::graph::{Graph, Labels};

/// What a [`NamedGraph`] has beside graph and labels, by reference or owned.
#[derive(Serialize, Deserialize)]
struct About<R, N, M, D, F> {
    read: R,
    notes: N,
    matching: M,
    cameras: Option<u32>,
    database: D,
    tracks: Option<TrackFacts>,
    frames: F,
}

type Owned =
    About<ReadAs, Vec<String>, Option<Matching>, Option<Box<DatabaseFacts>>, Option<Box<Frames>>>;

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

/// All that is known of a graph beside its name, pairs and labels. O(size).
///
/// # Errors
/// A position of an image that is not finite.
pub fn about(input: &NamedGraph) -> Result<String, NotAbout> {
    let about = About {
        read: &input.read,
        notes: &input.notes,
        matching: &input.matching,
        cameras: input.cameras,
        database: &input.database,
        tracks: input.tracks,
        frames: &input.frames,
    };
    Ok(serde_json::to_string(&about)?)
}

/// The graph that a text of [`about`] is about. O(size).
///
/// # Errors
/// Another text, or that of a graph of another size.
pub fn with_about(
    name: String,
    graph: Graph,
    labels: Labels,
    text: &str,
) -> Result<NamedGraph, NotAbout> {
    let about: Owned = serde_json::from_str(text)?;
    let inliers = about
        .matching
        .as_ref()
        .map_or(0, |known| known.inliers.len());
    if inliers != 0 && inliers != graph.edges().len() {
        return Err(NotAbout::OtherGraph("its pairs are not as many"));
    }
    if about
        .cameras
        .is_some_and(|cameras| cameras as usize > graph.nodes())
    {
        return Err(NotAbout::OtherGraph("it has more cameras than nodes"));
    }
    Ok(NamedGraph {
        name,
        graph,
        labels,
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
        let again = |graph, text| with_about("mine".into(), graph, input.labels.clone(), text);
        assert_eq!(again(input.graph.clone(), &text).unwrap(), input);
        let other = Graph::new(3, [(0, 1)]).unwrap();
        assert!(matches!(again(other, &text), Err(NotAbout::OtherGraph(_))));
        let cut = &text[..text.len() - 1];
        assert!(matches!(
            again(input.graph.clone(), cut),
            Err(NotAbout::Unreadable(_))
        ));
    }
}
