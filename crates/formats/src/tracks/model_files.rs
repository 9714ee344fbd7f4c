//! What the files of a model are, and what is read from them.

/// Which file of a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Part {
    Cameras,
    Images,
    Points,
}

/// How a model is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Encoding {
    Binary,
    Text,
}

/// The tracks of a model by the numbers of images, one track after another.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct Points {
    pub(super) images: Vec<u32>,
    /// Where the images of every track end.
    pub(super) ends: Vec<usize>,
}

/// An image of a model.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Image {
    pub(super) id: u32,
    pub(super) name: Box<str>,
}
