//! The graph that a claim names.

use super::Named;
use std::io::Cursor;
use std::path::{Path, PathBuf};
use viewcert::graph::graph6;
use viewcert_formats::read::{Graphs, graphs};
use viewcert_formats::{NamedGraph, ReadError, ReadOptions, read_graphs};

/// Why there is no such graph.
#[derive(Debug, thiserror::Error)]
pub enum GraphError {
    /// The folder is not said.
    #[error("the graph is named by file or name: say where with --graphs DIR")]
    NoFolder,
    /// The folder cannot be read.
    #[error("{}", folder.display())]
    Folder {
        /// The folder.
        folder: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// A name that no file of the folder has.
    #[error("unknown graph {name}: no such file in {}", folder.display())]
    NoFile {
        /// The name.
        name: String,
        /// The folder.
        folder: PathBuf,
    },
    /// A name that several files of the folder have.
    #[error("{name} may be any of {files}")]
    Files {
        /// The name.
        name: String,
        /// The files.
        files: String,
    },
    /// It was read from standard input.
    #[error(
        "{0}: the graph was read from standard input, and is not there any more; name its file"
    )]
    StandardInput(String),
    /// No graph on the line of a file.
    #[error("unknown graph {0}: no graph on that line")]
    NoLine(String),
    /// No graph in a file.
    #[error("{0}: no graph")]
    Nothing(String),
    /// Several graphs in a file.
    #[error("{0}: several graphs, and a claim is about one")]
    Several(String),
    /// A file that cannot be read.
    #[error("unknown graph {name}")]
    Unreadable {
        /// How the claim names it.
        name: String,
        /// What is wrong.
        source: ReadError,
    },
    /// Whoever asks does not want that file to be read.
    #[error("{0}")]
    Refused(String),
}

/// Reads the graph that a claim names; `folder` holds those that are named by file or name. `refuse` is asked
/// before a file is read, and says why not.
///
/// # Errors
/// See [`GraphError`].
pub fn graph(
    named: &Named,
    folder: Option<&Path>,
    refuse: &dyn Fn(&Path) -> Option<String>,
) -> Result<NamedGraph, Box<GraphError>> {
    let read = |path: &Path| match refuse(path) {
        Some(why) => Err(Box::new(GraphError::Refused(why))),
        None => Ok(read_graphs(path, &ReadOptions::default())),
    };
    let folder = || folder.ok_or_else(|| Box::new(GraphError::NoFolder));
    match named {
        Named::Graph(text) if !Path::new(text).exists() && graph6::is_graph6(text.as_bytes()) => {
            let line = Cursor::new(format!("{text}\n").into_bytes());
            only(text, graphs(text.clone(), line, ReadOptions::default()))
        }
        Named::Graph(text) if text == "-" || text.starts_with("-:") => {
            Err(Box::new(GraphError::StandardInput(text.clone())))
        }
        Named::Graph(text) => match line_of(text) {
            Some(path) => {
                // Of what stands on other lines, nothing matters here.
                let mut graphs = read(path)?.filter_map(Result::ok);
                let found = graphs.find(|graph| graph.name == *text);
                found.ok_or_else(|| Box::new(GraphError::NoLine(text.clone())))
            }
            None => only(text, read(Path::new(text))?),
        },
        Named::File(file) => only(file, read(&folder()?.join(file))?),
        Named::Name(name) => only(name, read(&find(folder()?, name)?)?),
    }
}

/// The file in the name of a graph on a line of it, as in `file.g6:3`.
fn line_of(name: &str) -> Option<&Path> {
    let (path, line) = name.rsplit_once(':')?;
    let is_line = !line.is_empty() && line.bytes().all(|byte| byte.is_ascii_digit());
    let path = Path::new(path);
    (is_line && !Path::new(name).exists() && path.is_file()).then_some(path)
}

/// The only graph of an input.
fn only(name: &str, mut graphs: Graphs) -> Result<NamedGraph, Box<GraphError>> {
    let first = graphs.next();
    let first = first.ok_or_else(|| Box::new(GraphError::Nothing(name.to_owned())))?;
    let first = first.map_err(|source| {
        let name = name.to_owned();
        Box::new(GraphError::Unreadable { name, source })
    })?;
    match graphs.next() {
        None => Ok(first),
        Some(_) => Err(Box::new(GraphError::Several(name.to_owned()))),
    }
}

/// The file of a name: that name, or that name up to a dot.
fn find(folder: &Path, name: &str) -> Result<PathBuf, Box<GraphError>> {
    let unreadable = |source| {
        let folder = folder.to_owned();
        Box::new(GraphError::Folder { folder, source })
    };
    let mut names = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(unreadable)? {
        let file = PathBuf::from(entry.map_err(unreadable)?.file_name());
        if file.as_os_str() == name || file.file_stem().is_some_and(|stem| stem == name) {
            names.push(file);
        }
    }
    names.sort_unstable();
    match &names[..] {
        [one] => Ok(folder.join(one)),
        [] => Err(Box::new(GraphError::NoFile {
            name: name.to_owned(),
            folder: folder.to_owned(),
        })),
        _ => {
            let names: Vec<String> = names
                .iter()
                .map(|file| file.display().to_string())
                .collect();
            Err(Box::new(GraphError::Files {
                name: name.to_owned(),
                files: names.join(", "),
            }))
        }
    }
}
