//! OpenMVG's matches as text: `I J`, a number, and so many lines `k l`. AliceVision's: `I J`, a number, and so many
//! blocks: the name of a describer, a number, and so many lines `k l`.
//!
//! Feature k of view I is feature l of view J. Views are called by their numbers, and a view
//! without matches is not in the file. Every match counts: thresholds are those with which the file
//! was made (its geometric filter).

use std::collections::HashMap;
use std::io::Read;

use super::Joined;
use super::graph::{TrackGraph, TrackOptions};
use super::words::{Words, integer, shown};
use crate::NamedGraph;
use crate::error::Fault;

/// AliceVision has fifteen kinds of features.
const MOST_DESCRIBERS: u32 = 16;

pub(super) fn read<R: Read>(
    mut words: Words<R>,
    has_describers: bool,
    options: TrackOptions,
) -> Result<NamedGraph, Fault> {
    let mut views: Vec<u64> = Vec::new();
    let mut places: HashMap<u64, u32> = HashMap::new();
    let mut joined = Joined::new(0);
    let mut describers: HashMap<Vec<u8>, u32> = HashMap::new();
    let mut place = |view, joined: &mut Joined| {
        *places.entry(view).or_insert_with(|| {
            joined.push_image();
            views.push(view);
            views.len() as u32 - 1
        })
    };
    loop {
        let first = match words.word()? {
            None => break,
            Some(word) => match integer(word) {
                Some(first) => first,
                None => {
                    let word = shown(word);
                    let why = format!("`{word}` stands where the number of a view is expected");
                    return Err(words.corrupt(why));
                }
            },
        };
        let second = words.number("the number of a view")?;
        if first == second {
            return Err(words.corrupt(format!("view {first} is matched with itself")));
        }
        let (first, second) = (place(first, &mut joined), place(second, &mut joined));
        let (blocks, kinds) = match has_describers {
            true => (words.number("the number of describers")?, MOST_DESCRIBERS),
            false => (1, 1),
        };
        for _ in 0..blocks {
            // Each describer counts its features from 0.
            let mut above = 0;
            if has_describers {
                let name = words.word()?.unwrap_or_default().to_vec();
                let known = describers.len() as u32;
                above = *describers.entry(name).or_insert(known);
            }
            if above >= kinds {
                return Err(words.corrupt("there are too many kinds of features"));
            }
            for _ in 0..words.number("the number of matches")? {
                let most = u64::from(u32::MAX / kinds);
                let mut feature = || words.number_below(most, "the number of a feature");
                let [a, b] = [feature()?, feature()?].map(|feature| feature * kinds + above);
                joined.join((first, a), (second, b))?;
            }
        }
    }
    let mut order: Vec<u32> = (0..views.len() as u32).collect();
    order.sort_unstable_by_key(|&view| views[view as usize]);
    let mut nodes = vec![0; views.len()];
    for (node, &view) in (0..).zip(&order) {
        nodes[view as usize] = node;
    }
    let names = order
        .iter()
        .map(|&view| views[view as usize].to_string().into());
    let mut graph = TrackGraph::new(names.collect(), options)?;
    joined.tracks(&nodes, None, &mut graph)?;
    graph.finish()
}
