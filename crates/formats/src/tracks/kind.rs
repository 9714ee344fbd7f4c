//! Which of the files with tracks an input is, by its beginning.

use super::words;

/// A file with tracks, or a part of one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TrackFile {
    /// A problem of bundle adjustment in the large.
    Bal,
    /// `bundle.out`.
    Bundler,
    /// A file of VisualSFM.
    Nvm,
    /// Matches of OpenMVG as text.
    OpenMvgMatches,
    /// Matches of AliceVision as text.
    AliceVisionMatches,
    /// `sfm_data.json` of OpenMVG.
    OpenMvg,
    /// `.sfm` of AliceVision.
    AliceVision,
    /// `tracks.csv` of OpenSfM.
    OpenSfm,
}

impl TrackFile {
    /// What it is called in reports.
    pub(super) fn format(self) -> &'static str {
        let (name, mut articles) = (self.name(), ["a file of ", "a ", "an "].iter());
        let bare = articles.find_map(|article| name.strip_prefix(article));
        bare.unwrap_or(name)
    }

    /// What it is called in messages.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Bal => "a bundle adjustment problem (BAL)",
            Self::Bundler => "a Bundler file",
            Self::Nvm => "an NVM file of VisualSFM",
            Self::OpenMvgMatches => "a file of feature matches (OpenMVG)",
            Self::AliceVisionMatches => "a file of feature matches (AliceVision)",
            Self::OpenMvg => "a model of OpenMVG",
            Self::AliceVision => "a model of AliceVision",
            Self::OpenSfm => "a file of tracks of OpenSfM",
        }
    }
}

/// Which file begins with `head`, which is all of it if `whole`.
pub(crate) fn kind(head: &[u8], whole: bool) -> Option<TrackFile> {
    if let Some(file) = by_first_words(head) {
        return Some(file);
    }
    let text = head.trim_ascii_start();
    let lines = words::first_lines(text, whole);
    let lines: Vec<&[&[u8]]> = lines.iter().map(Vec::as_slice).collect();
    let integers = |line: &[&[u8]]| line.iter().all(|word| words::integer(word).is_some());
    let is_below =
        |one, other| words::integer(one) < words::integer(other) && words::integer(one).is_some();
    let numbers = |line: &[&[u8]]| line.iter().all(|word| words::is_number(word));
    match lines[..] {
        [[cameras, points, observations], [camera, point, x, y], ..]
            if is_below(camera, cameras)
                && is_below(point, points)
                && is_below(b"0", observations)
                && numbers(&[x, y]) =>
        {
            Some(TrackFile::Bal)
        }
        [first @ [_, _], [count], third @ [_, _], ..]
            if integers(first) && integers(&[count]) && integers(third) =>
        {
            Some(TrackFile::OpenMvgMatches)
        }
        [first @ [_, _], [count], [kind, matches], ..]
            if integers(first) && integers(&[count, matches]) && kind[0].is_ascii_lowercase() =>
        {
            Some(TrackFile::AliceVisionMatches)
        }
        _ => None,
    }
}

/// Which file a text is by what stands in its first line.
pub(crate) fn by_first_words(head: &[u8]) -> Option<TrackFile> {
    let text = head.trim_ascii_start();
    let has = |name: &str| {
        text.windows(name.len())
            .any(|window| window == name.as_bytes())
    };
    if text.starts_with(b"{") && has("\"sfm_data_version\"") {
        return Some(TrackFile::OpenMvg);
    }
    if text.starts_with(b"{") && has("\"version\"") && has("\"viewId\"") {
        return Some(TrackFile::AliceVision);
    }
    [
        ("OPENSFM_TRACKS_VERSION_v", TrackFile::OpenSfm),
        ("NVM_V", TrackFile::Nvm),
        ("# Bundle file", TrackFile::Bundler),
    ]
    .into_iter()
    .find_map(|(words, file)| text.starts_with(words.as_bytes()).then_some(file))
}
