//! Exact, certified solvability of viewing graphs.
//!
//! Data flows one way: a [`graph`] is read, contracted to bodies ([`body`]) and cut into
//! pieces ([`piece`]); each piece is decided with [`exact`] arithmetic at a [`camera`]
//! set in some [`formulation`], its [`component`]s are found and upper [`bound`]s are
//! counted; the [`verdict`] leaves with its [`evidence`].

pub mod audit;
pub mod body;
pub mod bound;
pub mod camera;
pub mod catalog;
pub mod certificate;
pub mod cli;
pub mod component;
pub mod conditions;
pub mod evidence;
pub mod exact;
pub mod formulation;
pub mod graph;
pub mod model;
pub mod piece;
pub mod report;
pub mod union_find;
pub mod verdict;
pub mod watch;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
