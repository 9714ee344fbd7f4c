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

/// The models of cameras by their numbers in COLMAP 4.2: what they are called, and how many parameters
/// they have.
pub(super) const CAMERA_MODELS: [(&str, u64); 18] = [
    ("SIMPLE_PINHOLE", 3),
    ("PINHOLE", 4),
    ("SIMPLE_RADIAL", 4),
    ("RADIAL", 5),
    ("OPENCV", 8),
    ("OPENCV_FISHEYE", 8),
    ("FULL_OPENCV", 12),
    ("FOV", 5),
    ("SIMPLE_RADIAL_FISHEYE", 4),
    ("RADIAL_FISHEYE", 5),
    ("THIN_PRISM_FISHEYE", 12),
    ("RAD_TAN_THIN_PRISM_FISHEYE", 16),
    ("SIMPLE_DIVISION", 4),
    ("DIVISION", 5),
    ("SIMPLE_FISHEYE", 3),
    ("FISHEYE", 4),
    ("EUCM", 6),
    ("EQUIRECTANGULAR", 2),
];
