//! Certificates of the folder `certificates`, changed in some places, and why they are rejected.

use serde_json::{Value, json};
use std::fs;
use std::path::Path;
use viewcert_check::{Answer, Certificate, Failure, Graph, Limits};

pub(crate) fn named(name: &str) -> Value {
    let path = format!("tests/certificates/{name}.json");
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

/// Where the members stand that are changed most.
fn expand(pointer: &str) -> String {
    match (pointer.strip_prefix('E'), pointer.strip_prefix('P')) {
        (Some(rest), _) => format!("/pieces/0/evidence{rest}"),
        (_, Some(rest)) => format!("/pieces/0{rest}"),
        _ => pointer.to_owned(),
    }
}

pub(crate) fn at<'v>(value: &'v mut Value, pointer: &str) -> &'v mut Value {
    let pointer = expand(pointer);
    value
        .pointer_mut(&pointer)
        .unwrap_or_else(|| panic!("no {pointer}"))
}

/// Changes values; `remove` takes one out of its list, `repeat` adds it again.
pub(crate) fn changed(name: &str, changes: &[(&str, Value)]) -> Value {
    let mut value = named(name);
    for (pointer, new) in changes {
        if *new == json!("remove") {
            let (list, number) = pointer.rsplit_once('/').unwrap();
            let list = at(&mut value, list).as_array_mut().unwrap();
            list.remove(number.parse().unwrap());
        } else if *new == json!("repeat") {
            let (list, number) = pointer.rsplit_once('/').unwrap();
            let list = at(&mut value, list).as_array_mut().unwrap();
            let entry = list[number.parse::<usize>().unwrap()].clone();
            list.push(entry);
        } else {
            let place = at(&mut value, pointer);
            assert_ne!(place, new, "{name}: {pointer} is not changed");
            *place = new.clone();
        }
    }
    value
}

pub(crate) fn answer(value: &Value, graph: Option<&Graph>) -> Result<Answer, Failure> {
    let certificate = Certificate::parse(value.to_string().as_bytes())?;
    certificate.check(graph, None, &Limits::default())
}

pub(crate) fn rejection(value: &Value, graph: Option<&Graph>) -> String {
    match answer(value, graph) {
        Err(Failure::Rejected(rejection)) => rejection.to_string(),
        other => panic!("not rejected: {other:?}"),
    }
}

pub(crate) fn refused(name: &str, changes: &[(&str, Value)], wanted: &str) {
    let reason = rejection(&changed(name, changes), None);
    let wanted = wanted.replace("E/", "pieces[0].evidence");
    assert!(reason.starts_with(&wanted), "{name} {changes:?}: {reason}");
}

#[track_caller]
pub(crate) fn rejected(words: &str, value: &Value) {
    let reason = rejection(value, None);
    assert!(reason.contains(words), "{reason}");
}
