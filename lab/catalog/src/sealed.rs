//! Small files of JSON that say by a digest whether they are as they were written.

use crate::files;
use anyhow::Result;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::path::Path;
use viewcert::certificate::hex;

/// A value and the SHA-256 of its compact JSON.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Sealed<T> {
    content: T,
    sha256: String,
}

/// The text of a file that holds a value.
///
/// # Panics
/// Never: what is sealed has names as keys.
pub(crate) fn sealed(content: &impl Serialize) -> String {
    let sha256 = digest(content);
    let text = serde_json::to_string(&Sealed { content, sha256 });
    text.expect("names as keys") + "\n"
}

fn digest(content: &impl Serialize) -> String {
    let text = serde_json::to_vec(content).expect("names as keys");
    hex(&Sha256::digest(text))
}

/// The value in a text, or what is wrong with it.
pub(crate) fn opened<T: Serialize + DeserializeOwned>(text: &str) -> Result<T, String> {
    let sealed: Sealed<T> =
        serde_json::from_str(text).map_err(|error| format!("cut off or changed ({error})"))?;
    if digest(&sealed.content) != sealed.sha256 {
        return Err("changed: its digest is another one".into());
    }
    Ok(sealed.content)
}

/// The value in a file, or what is wrong with it.
///
/// # Errors
/// A file that cannot be read.
pub(crate) fn read<T: Serialize + DeserializeOwned>(path: &Path) -> Result<Result<T, String>> {
    Ok(opened(&files::text(path)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_changed_does_not_open() {
        let text = sealed(&vec![1, 2, 3]);
        assert_eq!(opened::<Vec<u32>>(&text), Ok(vec![1, 2, 3]));
        assert!(opened::<Vec<u32>>(&text.replace("[1,", "[4,")).is_err());
        assert!(opened::<Vec<u32>>(&text[..text.len() / 2]).is_err());
        assert!(opened::<Vec<u32>>("").is_err());
    }
}
