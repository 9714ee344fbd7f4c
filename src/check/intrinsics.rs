//! `verify check` on a certificate of intrinsics.

use super::checker::{graph_of, named_at};
use crate::intrinsics;
use crate::plan::IntrinsicsFrom;
use anyhow::Result;
use std::borrow::Cow;
use std::path::Path;
use viewcert::certificate::hex;
use viewcert_check::{Failure, IntrinsicsCertificate, Limits};
use viewcert_formats::ReadOptions;

/// What a certificate proves, in words: for the graph in a file if there is one, and then for its classes if
/// they are said.
///
/// # Errors
/// Those of the files.
pub(super) fn check(
    text: &[u8],
    graph: Option<&Path>,
    classes: Option<&IntrinsicsFrom>,
    options: &ReadOptions,
) -> Result<Result<String, Failure>> {
    let certificate = match IntrinsicsCertificate::parse(text) {
        Ok(certificate) => certificate,
        Err(failure) => return Ok(Err(failure)),
    };
    let (mut own, mut hash) = (None, None);
    if let Some(path) = graph {
        let input = named_at(certificate.graph_sha256(), path, options)?;
        own = Some(graph_of(&input)?);
        let (_, sensors) = intrinsics::read(classes, Cow::Owned(input))?;
        hash = sensors.map(|sensors| hex(&sensors.sha256()));
    }
    let checked = certificate.check_within(own.as_ref(), hash.as_deref(), &Limits::default());
    Ok(checked.map(|verified| verified.to_string()))
}
