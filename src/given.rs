//! `--given FILE`: what is known besides the pairs (docs/theory.md, Theorems 4.14 and 13.16 to 13.22).
//!
//! In: a graph as it was read. Out: the graph with what was noted in reading the file, and the known
//! parts or displacements. Whoever decides the graph passes them on.

use anyhow::{Result, ensure};
use clap::Args;
use std::borrow::Cow;
use std::path::{Path, PathBuf};
use viewcert::Known;
use viewcert_formats::NamedGraph;

/// The option.
pub(super) const OPTION: &str = "--given";

/// What is known besides the pairs.
#[derive(Args)]
pub(super) struct GivenArguments {
    /// What is known besides the pairs (`verify help given`).
    #[arg(
        long,
        value_name = "FILE",
        visible_alias = "cameras",
        hide_short_help = true
    )]
    given: Option<PathBuf>,

    /// What --given holds is in the frame of the directions.
    #[arg(long, requires = "given", hide_short_help = true)]
    one_frame: bool,
}

/// What a file of things given looks like: `verify help given`.
pub(super) const HELP: &str = "\
What --given FILE holds: what is known besides the pairs, one thing on each line.

  part A B C ...             The relative position of these cameras is known, from trifocal tensors,
                             rigs or partial reconstructions: as good as all pairs of them, in every
                             model.
  displacement A B           The distance of two calibrated cameras is known as well as its direction
                             (stereo rigs).
  displacement A B X Y Z     The vector from A to B is this one.
  position A                 The position of a calibrated camera is known (GPS).
  position A X Y Z           It is this one.

  camera A P11 P12 .. P34    The matrix of a camera, row by row; or
  pose A QW QX QY QZ X Y Z   its rotation and translation, as in COLMAP's images.txt; or
  centre A X Y Z             its centre (affine: its viewing direction). One for each camera of the graph: what
                             is determined at these very cameras is answered besides.
A table may say the same: name,x,y,z or name,qw,qx,qy,qz,tx,ty,tz or name,p11,..,p34 in its head. A COLMAP model (a folder) as
FILE gives the poses of its images; all but a folder may be standard input (-). Arrays are for Python:
viewcert.at_cameras(graph, array). A COLMAP database as FILE gives the positions of its pose priors.
Cameras are called as in the graph; fields, quotes and comments are those of edge lists. Vectors stand
on all lines or on none: with them the answer is about these vectors, without them about vectors in general
position. Parts and displacements do not go together.
Displacements and positions have a frame of their own: the rotation of each part of the graph against it is
unknown. A line `one-frame`, or the option --one-frame, says that it is the frame of the directions.
The certificate states what was given, and `verify check` asks for the same file.
";

impl GivenArguments {
    /// The file.
    pub(super) fn path(&self) -> Option<&Path> {
        self.given.as_deref()
    }

    /// Whether it is in the frame of the directions.
    pub(super) fn is_one_frame(&self) -> bool {
        self.one_frame
    }
}

/// Refuses standard input for two things.
///
/// # Errors
/// If both a graph and what is given are `-`.
pub(super) fn ensure_one_standard_input(
    name: &str,
    given: Option<&Path>,
    graphs: &[PathBuf],
) -> Result<()> {
    let is_input = |path: &Path| path == Path::new("-");
    let graph = graphs.iter().any(|path| is_input(path));
    ensure!(
        !(graph && given.is_some_and(is_input)),
        "{name} -: standard input is the graph already; put what is given into a file"
    );
    Ok(())
}

/// The graph with the notes on the file, and what it gives and its rigs.
///
/// # Errors
/// Those of the file.
pub(super) fn read<'a>(
    given: Option<&Path>,
    input: &'a NamedGraph,
    one_frame: bool,
) -> Result<(Cow<'a, NamedGraph>, Known)> {
    let found = viewcert_formats::given(given, input, one_frame)?;
    Ok((
        beside_file(input, found.notes, (given, one_frame)),
        found.known,
    ))
}

/// A graph with the notes on a file, which its records name.
pub(super) fn beside_file<'a>(
    input: &'a NamedGraph,
    notes: Vec<String>,
    (file, one_frame): (Option<&Path>, bool),
) -> Cow<'a, NamedGraph> {
    let mut input = noted(input, notes);
    if let Some(file) = file {
        let options = &mut input.to_mut().read.options;
        options.insert("given".to_owned(), file.display().to_string());
        options.extend(one_frame.then(|| ("one-frame".to_owned(), String::new())));
    }
    input
}

/// A graph with more notes.
pub(super) fn noted(input: &NamedGraph, notes: Vec<String>) -> Cow<'_, NamedGraph> {
    if notes.is_empty() {
        return Cow::Borrowed(input);
    }
    let mut input = input.clone();
    input.notes.extend(notes);
    Cow::Owned(input)
}

/// Why a file that goes with one graph cannot go with many.
pub(super) fn too_many(name: &str, path: &Path, what: &str) -> String {
    format!(
        "{name} {}: this is about one graph, and there are {what}; run the program on each",
        path.display()
    )
}
