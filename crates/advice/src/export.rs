//! Components as files that COLMAP takes, tables of them, and the commands that come next.

use crate::folder::ensure_new;
use crate::named::{Export, ToMatch};
use crate::task::{Task, number};
use anyhow::{Result, ensure};
use std::collections::BTreeSet;
use std::fs;
use std::io::{BufWriter, Write};
use std::path::Path;
use viewcert::wording::printable;
use viewcert_session::{Outputs, outputs};

const COMPONENTS: &str = "components";
const TABLES: [&str; 2] = ["components.tsv", "images.tsv"];
const LISTS: [&str; 2] = ["images.txt", "pairs.txt"];

/// Most names in a message.
const NAMED: usize = 5;

/// A component that has a folder.
struct Exported {
    /// Its place in the verdict.
    component: usize,
    images: Vec<u32>,
    pairs: Vec<(u32, u32)>,
}

/// Writes the folder, whole or not at all.
///
/// # Errors
/// If a name cannot be expressed, or the folder cannot be written.
pub(crate) fn write(outputs: &Outputs, folder: &Path, task: &Task) -> Result<Export> {
    ensure_new("export", folder)?;
    let exported = exported(task);
    let images: BTreeSet<u32> = exported
        .iter()
        .flat_map(|part| part.images.iter().copied())
        .collect();
    let names = images.into_iter().map(|v| task.names.of(v));
    let what = format!("export {}", folder.display());
    ensure_expressible(&what, names, task.input.cameras.is_none())?;
    let digits = exported
        .last()
        .map_or(3, |last| number(last.component).to_string().len().max(3));
    let place = |component: usize| format!("{COMPONENTS}/{:0digits$}", number(component));
    outputs.folder(folder, |new| {
        fs::create_dir(new.join(COMPONENTS))?;
        for part in &exported {
            write_part(&new.join(place(part.component)), task, part)?;
        }
        write_components(&new.join(TABLES[0]), task, &exported, place)?;
        write_images(&new.join(TABLES[1]), task)
    })?;
    let mut seen = BTreeSet::new();
    let mut shared = BTreeSet::new();
    for &v in exported.iter().flat_map(|part| &part.images) {
        if !seen.insert(v) {
            shared.insert(v);
        }
    }
    let parts = exported.iter().map(|part| {
        let lists = folder.join(place(part.component));
        commands(
            task,
            &lists,
            &format!("{:0digits$}", number(part.component)),
        )
    });
    Ok(Export {
        folder: folder.display().to_string(),
        components: exported.len(),
        shared_images: shared.into_iter().map(|v| task.names.of(v)).collect(),
        outside: task.names.images().len() - seen.len(),
        commands: parts.collect(),
    })
}

/// Writes a list of pairs, as `matches_importer` takes it.
///
/// # Errors
/// If a name cannot be expressed, or the list cannot be written.
pub(crate) fn write_pairs(
    outputs: &Outputs,
    list: &Path,
    task: &Task,
    pairs: &[&[String; 2]],
) -> Result<ToMatch> {
    let names: BTreeSet<&String> = pairs.iter().copied().flatten().collect();
    ensure_expressible(
        &list.display().to_string(),
        names.into_iter().cloned(),
        true,
    )?;
    outputs.write(list, |out| {
        let mut pairs = pairs.iter();
        pairs.try_for_each(|[a, b]| writeln!(out, "{a} {b}"))
    })?;
    let file = if outputs::is_standard(list) {
        Path::new(LISTS[1])
    } else {
        list
    };
    let command = || {
        format!(
            "colmap matches_importer --database_path {} --match_list_path {}",
            shell(database(task)),
            shell(&file.display().to_string())
        )
    };
    Ok(ToMatch {
        file: list.display().to_string(),
        pairs: pairs.len(),
        command: (!pairs.is_empty()).then(command),
    })
}

/// The database in commands.
fn database<'a>(task: &Task<'a>) -> &'a str {
    match task.input.database {
        Some(_) => &task.input.name,
        None => "database.db",
    }
}

/// The components that are more than a pair, of a camera-point graph those with two cameras.
fn exported(task: &Task) -> Vec<Exported> {
    let images = task.names.images().end;
    let edges = match task.input.cameras {
        None => task.parts.edges(&task.input.graph),
        // Pairs of cameras are not known here.
        Some(_) => vec![Vec::new(); task.parts.parts.len()],
    };
    let parts = task.parts.parts.iter().zip(edges);
    let parts = parts.map(|(part, pairs)| Exported {
        component: part.component,
        images: part.nodes.iter().copied().filter(|&v| v < images).collect(),
        pairs,
    });
    parts.filter(|part| part.images.len() > 1).collect()
}

/// Refuses names that COLMAP's lists of images, or of pairs, would read as something else.
fn ensure_expressible(
    what: &str,
    names: impl Iterator<Item = String>,
    in_pairs: bool,
) -> Result<()> {
    let bad = |name: &str| {
        let blank = if in_pairs {
            name.contains(char::is_whitespace)
        } else {
            // Everything at which Python, or COLMAP, ends a line.
            let ends = |c: char| c.is_control() || "\u{2028}\u{2029}".contains(c);
            name.contains(ends) || name.trim() != name
        };
        blank || name.is_empty() || in_pairs && name.starts_with('#')
    };
    let bad: Vec<String> = names.filter(|name| bad(name)).collect();
    let shown: Vec<String> = bad
        .iter()
        .take(NAMED)
        .map(|name| format!("{name:?}"))
        .collect();
    let more = match bad.len().saturating_sub(NAMED) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    let why = match in_pairs {
        true => "a list of pairs is split at blanks, and # begins a comment",
        false => "a name is a line, without blanks at its ends",
    };
    ensure!(
        bad.is_empty(),
        "{what}: COLMAP's lists cannot hold the names {}{more}: {why}; rename these images",
        shown.join(", ")
    );
    Ok(())
}

fn file(path: &Path) -> Result<BufWriter<fs::File>> {
    Ok(BufWriter::new(fs::File::create(path)?))
}

/// The lists of one component.
fn write_part(folder: &Path, task: &Task, part: &Exported) -> Result<()> {
    fs::create_dir(folder)?;
    let labels = &task.input.labels;
    let mut images = file(&folder.join(LISTS[0]))?;
    for name in part.images.iter().flat_map(|&v| task.names.all_of(v)) {
        writeln!(images, "{name}")?;
    }
    images.flush()?;
    if task.input.cameras.is_none() {
        let mut pairs = file(&folder.join(LISTS[1]))?;
        for &(a, b) in &part.pairs {
            writeln!(pairs, "{} {}", labels.display(a), labels.display(b))?;
        }
        pairs.flush()?;
    }
    Ok(())
}

fn table(path: &Path) -> Result<csv::Writer<fs::File>> {
    Ok(csv::WriterBuilder::new().delimiter(b'\t').from_path(path)?)
}

fn write_components(
    path: &Path,
    task: &Task,
    exported: &[Exported],
    place: impl Fn(usize) -> String,
) -> Result<()> {
    let mut out = table(path)?;
    out.write_record(["component", "images", "points", "pairs", "folder"])?;
    let cameras = task.names.images().end;
    let mut folders = exported.iter().peekable();
    for (k, component) in task.verdict.components.iter().enumerate() {
        let nodes = task.parts.nodes_of(k);
        let images = nodes.partition_point(|&v| v < cameras);
        let folder = folders.next_if(|part| part.component == k);
        out.write_record([
            number(k).to_string(),
            images.to_string(),
            (nodes.len() - images).to_string(),
            component.edge_count().to_string(),
            folder.map_or(String::new(), |part| place(part.component)),
        ])?;
    }
    Ok(out.flush()?)
}

fn write_images(path: &Path, task: &Task) -> Result<()> {
    let mut degree = vec![0usize; task.input.graph.nodes()];
    for &(i, j) in task.input.graph.edges() {
        degree[i as usize] += 1;
        degree[j as usize] += 1;
    }
    let mut out = table(path)?;
    out.write_record(["image", "pairs", "components", "single_pairs"])?;
    for v in task.names.images() {
        let parts = task.parts.of(v).iter();
        let parts: Vec<String> = parts
            .map(|&k| number(task.parts.parts[k as usize].component).to_string())
            .collect();
        out.write_record([
            task.names.of(v),
            degree[v as usize].to_string(),
            parts.join(","),
            task.parts.links_at(v).count().to_string(),
        ])?;
    }
    Ok(out.flush()?)
}

/// The first versions with a list of images among the options of the mapper, and with a global mapper.
const LISTED: u32 = 3_130_000;
const GLOBAL: u32 = 4_000_000;

/// Whether a version has a global mapper; one that is not known is taken for a version that has.
pub fn has_global_mapper(version: Option<u32>) -> bool {
    version.is_none_or(|version| version >= GLOBAL)
}

/// The commands that reconstruct one component: with COLMAP's two mappers, and with pycolmap; those
/// that the version has by which the database was written, or else those of version 4.
fn commands(task: &Task, lists: &Path, name: &str) -> Vec<String> {
    let database = database(task);
    let images = lists.join(LISTS[0]).display().to_string();
    let out = format!("sparse/{name}");
    let facts = task.input.database.as_ref();
    let version = facts.and_then(|facts| facts.version).unwrap_or(GLOBAL);
    let mapper = |command: &str, list: &str| {
        format!(
            "mkdir -p {out} && colmap {command} --database_path {} --image_path images \
             --output_path {out} --{list}image_list_path {}",
            shell(database),
            shell(&images)
        )
    };
    let script = |options: &str, mapping: &str| {
        let script = format!(
            "import pycolmap; options = pycolmap.{options}(); options.image_names = open({}, \
             encoding=\"utf-8\").read().splitlines(); pycolmap.{mapping}({}, \"images\", \"{out}\", \
             options)",
            python(&images),
            python(database)
        );
        format!("mkdir -p {out} && python3 -c {}", shell(&script))
    };
    let list = if version < LISTED { "" } else { "Mapper." };
    let mut commands = vec![mapper("mapper", list)];
    if version >= GLOBAL {
        commands.push(mapper("global_mapper", "GlobalMapper."));
    }
    commands.push(script("IncrementalPipelineOptions", "incremental_mapping"));
    if version >= GLOBAL {
        commands.push(script("GlobalPipelineOptions", "global_mapping"));
    }
    commands
}

/// A word for a POSIX shell.
pub fn shell(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "/._-+:@%=".contains(c);
    if !word.is_empty() && !word.starts_with('=') && word.chars().all(plain) {
        word.to_owned()
    } else if printable(word) != word {
        let quoted = word.replace('\\', r"\\").replace('\'', r"\'");
        format!("$'{}'", printable(&quoted))
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

/// A string for Python, without single quotes, as it goes into a shell's.
pub fn python(text: &str) -> String {
    let escaped = text
        .replace('\\', r"\\")
        .replace('"', "\\\"")
        .replace('\'', r"\x27");
    format!("\"{escaped}\"")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_quoted_for_the_shell_and_for_python() {
        assert_eq!(shell("out/components/001"), "out/components/001");
        assert_eq!(shell("my photos"), "'my photos'");
        assert_eq!(shell("it's\n\u{202e}"), r"$'it\'s\u000a\u202e'");
        assert_eq!(shell("it's"), r"'it'\''s'");
        assert_eq!(python(r#"a "b" \ it's"#), r#""a \"b\" \\ it\x27s""#);
    }
}
