//! Which modules of a crate import which, by their `use` declarations and the paths in their code.

use regex::Regex;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// A module by the names on the way to it; the crate itself has none.
pub(super) type Module = Vec<String>;

/// For every module of a crate those it imports from; `files` are under `src`. What the head of a folder
/// takes from the files of its folder does not count: it stands on them, and may lend them its types.
pub(super) fn imports(src: &Path, files: &[PathBuf]) -> BTreeMap<Module, BTreeSet<Module>> {
    let modules: BTreeMap<Module, &PathBuf> =
        files.iter().map(|file| (module(src, file), file)).collect();
    modules
        .iter()
        .map(|(own, file)| {
            let text = fs::read_to_string(file).unwrap();
            let product = text.split("#[cfg(test)]\nmod ").next().unwrap();
            let declared = declarations(product);
            let declared = declared.iter().map(String::as_str);
            let paths = declared.flat_map(expanded).chain(written_out(product));
            let found = paths.filter_map(|path| target(own, &path, &modules));
            (own.clone(), found.filter(|module| module != own).collect())
        })
        .collect()
}

/// The modules that are left when again and again all are taken away that import none of the others:
/// those of circles, and those that import them.
pub(super) fn circles(mut imports: BTreeMap<Module, BTreeSet<Module>>) -> BTreeSet<Module> {
    loop {
        let left: BTreeSet<Module> = imports.keys().cloned().collect();
        imports.retain(|_, imported| !imported.is_disjoint(&left));
        if imports.len() == left.len() {
            return left;
        }
    }
}

fn module(src: &Path, file: &Path) -> Module {
    let path = file.strip_prefix(src).unwrap().with_extension("");
    let names = path.iter().map(|name| name.to_str().unwrap().to_owned());
    let mut names: Module = names.collect();
    if matches!(
        names.last().map(String::as_str),
        Some("mod" | "lib" | "main")
    ) {
        names.pop();
    }
    names
}

/// The trees of all `use` declarations, without blanks.
fn declarations(code: &str) -> Vec<String> {
    let mut lines = code.lines().map(str::trim_start);
    let mut found = Vec::new();
    while let Some(line) = lines.next() {
        let Some((before, tree)) = line.split_once("use ") else {
            continue;
        };
        if !matches!(before, "" | "pub " | "pub(crate) " | "pub(super) ") {
            continue;
        }
        let mut tree = tree.to_owned();
        while !tree.ends_with(';') {
            tree += lines.next().expect("a declaration that ends");
        }
        tree.retain(|c| !c.is_whitespace() && c != ';');
        found.push(tree);
    }
    found
}

/// The paths from `crate` and `super` that stand in the code itself, which no `use` declares.
fn written_out(code: &str) -> Vec<String> {
    let path = Regex::new(r"\b(?:crate|super)(?:::\w+)+").unwrap();
    let lines = code.lines().map(str::trim_start);
    let lines = lines.filter(|line| !line.starts_with("//") && !line.contains("use "));
    let found = lines.flat_map(|line| path.find_iter(line).map(|found| found.as_str().to_owned()));
    found.collect()
}

/// The paths of a tree of `use`: `a::{b, c::d}` is `a::b` and `a::c::d`.
fn expanded(tree: &str) -> Vec<String> {
    let Some((before, rest)) = tree.split_once('{') else {
        return vec![tree.to_owned()];
    };
    let inner = rest.strip_suffix('}').expect("a tree that ends");
    let (mut depth, mut parts) = (0, vec![String::new()]);
    for c in inner.chars() {
        depth += i32::from(c == '{') - i32::from(c == '}');
        if c == ',' && depth == 0 {
            parts.push(String::new());
        } else {
            parts.last_mut().unwrap().push(c);
        }
    }
    let named = parts.iter().filter(|part| !part.is_empty());
    let paths = named.flat_map(|part| expanded(&format!("{before}{part}")));
    paths.collect()
}

/// The module that a path in `own` leads into, if it is one of this crate.
fn target(own: &Module, path: &str, modules: &BTreeMap<Module, &PathBuf>) -> Option<Module> {
    let mut names = path.split("::").peekable();
    let mut found = match names.next()? {
        "crate" => Vec::new(),
        "super" => own[..own.len().saturating_sub(1)].to_vec(),
        "self" => own.clone(),
        _ => return None,
    };
    while names.next_if_eq(&"super").is_some() {
        found.pop();
    }
    for name in names {
        found.push(name.to_owned());
        if !modules.contains_key(&found) {
            found.pop();
            break;
        }
    }
    modules.contains_key(&found).then_some(found)
}
