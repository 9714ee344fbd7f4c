//! All tests of the program, as one program: forty took more than four times as long to build (benches/README.md).
//!
//! `cargo test --test all golden::` runs one file.

mod common;

mod act;
mod act_outputs;
mod affine;
mod affine_certificates;
mod arguments;
mod at_cameras;
mod audit;
mod audit_cameras;
mod base_lines;
mod camera_point;
mod catalog;
mod certificates;
mod checking;
mod colmap;
mod convert;
mod cross;
mod degenerate;
mod displacements;
mod foreign;
mod formulas;
mod golden;
mod house;
mod hypotheses;
mod intrinsics;
mod intrinsics_certificates;
mod json;
mod mappers;
mod misfit;
mod models;
mod networkx;
mod outputs;
mod overview;
mod overview_page;
mod own_frame;
mod page_browser;
mod pages;
mod parts;
mod paths;
mod promises;
mod proof;
mod readers;
mod readme;
mod reconstruction;
mod redundancy;
mod running;
mod solution_certificates;
mod solutions;
mod split_merge;
mod symptoms;
mod table;
mod verify;
mod watch;
