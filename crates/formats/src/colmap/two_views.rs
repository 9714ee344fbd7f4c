//! What a database knows of the geometry of one pair of images.

/// Two images of a database, `first` the one with the smaller number there.
///
/// Numbers are those of the database, floats of its own estimation: whatever is concluded from them
/// is an estimate.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TwoViews {
    /// The node of the image with the smaller number, and that of the other.
    pub images: [u32; 2],
    /// The configuration ([`config_name`](super::config_name)).
    pub config: i64,
    /// How many matches were verified.
    pub inliers: u32,
    /// The essential matrix E, in rows: y^T E x = 0 for x in the first image and y in the second.
    pub essential: Option<[[f64; 3]; 3]>,
    /// The homography between the planes at distance 1 of the two cameras, if it is stored: y = H x.
    pub homography: Option<[[f64; 3]; 3]>,
    /// E as it is stored, whatever else is.
    pub stored_essential: Option<[[f64; 3]; 3]>,
    /// The stored quaternion and translation, each if it is whole, finite and, the first, not zero.
    pub qvec: Option<[f64; 4]>,
    /// See there.
    pub tvec: Option<[f64; 3]>,
    /// The rotation, as a quaternion (w, x, y, z), and the translation that take coordinates of the
    /// first camera to those of the second.
    pub pose: Option<([f64; 4], [f64; 3])>,
    /// The verified matches: the two directions, each in the frame of its camera; of a camera with an image
    /// plane the point in the plane at distance 1. Without distortion, which is rarely known before a
    /// reconstruction. Empty if keypoints or cameras are missing, or the camera is a fisheye.
    pub matches: Vec<[[f64; 3]; 2]>,
}
