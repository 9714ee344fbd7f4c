//! Words of a command line that are in the wrong place: whose option one is, and where a value ends.
//!
//! In: the words. Out: what they mean, or the line to type. All is found in clap's own tree of commands, so a new
//! option needs nothing here.

use super::help::whole;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Arg, Command, Error, Parser};
use std::ffi::OsString;
use std::io::Write;
use std::path::Path;
use viewcert_advice::export::shell;
use viewcert_formats::colmap::is_database;
use viewcert_session::printable;

/// What the words mean; where they ask for help or are wrong, the process ends here.
pub fn parse<P: Parser>(words: impl IntoIterator<Item = OsString>) -> P {
    let mut tree = P::command();
    tree.build();
    let mut words = words.into_iter();
    words.next();
    let mut line = Line::new(&tree, words.collect());
    line.free_databases::<P>();
    match line.parsed::<P>() {
        Ok(found) => match line.separated::<P>() {
            Some(why) => line.refused(ErrorKind::ValueValidation, why),
            None => found,
        },
        Err(error) if error.kind() == ErrorKind::DisplayHelp && line.is_long() => {
            // A reader that has seen enough is no error.
            let _ = std::io::stdout().write_all(whole(line.command).as_bytes());
            std::process::exit(0)
        }
        Err(mut error) => match line.elsewhere::<P>(&error) {
            Some(why) => line.refused(ErrorKind::UnknownArgument, why),
            None => {
                // `-- --option` is a file of this name, which nobody means.
                error.remove(ContextKind::Suggested);
                for what in [ContextKind::InvalidArg, ContextKind::InvalidValue] {
                    if let Some(ContextValue::String(word)) = error.get(what) {
                        let word = printable(word);
                        error.insert(what, ContextValue::String(word));
                    }
                }
                error.exit()
            }
        },
    }
}

/// A command of the tree, and the words behind it.
#[derive(Clone)]
struct Line<'a> {
    tree: &'a Command,
    command: &'a Command,
    words: Vec<OsString>,
}

impl<'a> Line<'a> {
    fn new(tree: &'a Command, mut words: Vec<OsString>) -> Self {
        let first = words.first().and_then(|word| word.to_str());
        let command = first.and_then(|word| tree.find_subcommand(word));
        if command.is_some() {
            words.remove(0);
        }
        Self {
            tree,
            command: command.unwrap_or(tree),
            words,
        }
    }

    fn refused(&self, kind: ErrorKind, why: String) -> ! {
        self.command.clone().error(kind, why).exit()
    }

    fn all(&self) -> impl Iterator<Item = OsString> {
        let command = (!std::ptr::eq(self.command, self.tree)).then(|| self.command.get_name());
        let names = [self.tree.get_name()].into_iter().chain(command);
        names.map(OsString::from).chain(self.words.iter().cloned())
    }

    fn parsed<P: Parser>(&self) -> Result<P, Error> {
        P::try_parse_from(self.all())
    }

    /// Whether all of the help is asked for.
    fn is_long(&self) -> bool {
        self.words.iter().any(|word| word == "--help")
    }

    /// The option that a word begins with, of this command.
    fn option(&self, word: &OsString) -> Option<&'a Arg> {
        option(self.command, name(word)?)
    }

    /// A database behind an option that may do without a value is a graph, if there is no other, or if there are
    /// other databases.
    fn free_databases<P: Parser>(&mut self) {
        let is_missing = |line: &Self| match line.parsed::<P>() {
            Err(error) => error.kind() == ErrorKind::MissingRequiredArgument,
            Ok(_) => false,
        };
        for at in 1..self.words.len() {
            let may_be_alone =
                |option: &Arg| values(option) == (0, 1) && !option.is_require_equals_set();
            let is_free = |word: &OsString| is_database(Path::new(word));
            if is_free(&self.words[at])
                && self.option(&self.words[at - 1]).is_some_and(may_be_alone)
                && (self.words.iter().filter(|word| is_free(word)).count() > 1 || is_missing(self))
            {
                let option = self.words.remove(at - 1);
                let end = self.words.iter().position(|word| word == "--");
                self.words.insert(end.unwrap_or(self.words.len()), option);
            }
        }
    }

    /// The line in which a word that is no file is the value of the option before it, which takes one behind an
    /// equals sign.
    fn joined<P: Parser>(&self) -> Option<(usize, Self)> {
        (1..self.words.len()).find_map(|at| {
            let [word, next] = [at - 1, at].map(|at| self.words[at].to_str());
            let (word, next) = (word?, next?);
            let takes_sign = self.option(&self.words[at - 1])?.is_require_equals_set();
            if !takes_sign || word.contains('=') || Path::new(next).exists() {
                return None;
            }
            let mut line = self.clone();
            line.words[at - 1] = format!("{word}={next}").into();
            line.words.remove(at);
            line.parsed::<P>().is_ok().then_some((at, line))
        })
    }

    /// Why a word is no graph.
    fn separated<P: Parser>(&self) -> Option<String> {
        let (at, line) = self.joined::<P>()?;
        let [option, value] = [at - 1, at].map(|at| self.words[at].to_string_lossy());
        Some(format!(
            "no file is called {value}; if it is the value of {option}, say\n\n  {}",
            line.shown()
        ))
    }

    /// Which commands have an option that this one has not, and the line to type where it needs no other words.
    fn elsewhere<P: Parser>(&self, error: &Error) -> Option<String> {
        let unknown = unknown(error)?;
        let others = std::iter::once(self.tree).chain(self.tree.get_subcommands());
        let having = others.filter(|one| option(one, &unknown).is_some());
        let having: Vec<&Command> = having.collect();
        let names: Vec<String> = having.iter().map(|one| called(self.tree, one)).collect();
        let line = having.iter().find_map(|command| self.of::<P>(command));
        let line = line.map_or_else(String::new, |line| format!("\n\n  {}", line.shown()));
        (!names.is_empty()).then(|| {
            let (names, this) = (names.join(", "), called(self.tree, self.command));
            format!("{unknown} is an option of {names}, not of {this}{line}")
        })
    }

    /// The same words for another command, if both take graphs and nothing else.
    fn of<P: Parser>(&self, command: &'a Command) -> Option<Self> {
        let takes_graphs = |command: &Command| {
            let mut names = command.get_positionals().map(Arg::get_value_names);
            names.all(|names| names.is_some_and(|names| names[0] == "GRAPH"))
        };
        let mut line = self.clone();
        line.command = command;
        line.free_databases::<P>();
        let joined = line.joined::<P>().map(|(_, joined)| joined);
        let line = joined.or_else(|| line.parsed::<P>().is_ok().then_some(line));
        line.filter(|line| takes_graphs(self.command) && takes_graphs(line.command))
    }

    fn shown(&self) -> String {
        let words = self.all().map(|word| {
            let word = word.to_string_lossy();
            match word.split_once('=').filter(|_| word.starts_with('-')) {
                Some((name, value)) => format!("{name}={}", shell(value)),
                None => shell(&word),
            }
        });
        words.collect::<Vec<_>>().join(" ")
    }
}

/// The name of an option, as in `--model=affine`.
fn name(word: &OsString) -> Option<&str> {
    let word = word
        .to_str()
        .filter(|word| word.len() > 1 && word.starts_with('-'))?;
    Some(word.split_once('=').map_or(word, |(name, _)| name))
}

/// The option of a command that is called so.
fn option<'a>(command: &'a Command, name: &str) -> Option<&'a Arg> {
    command
        .get_arguments()
        .find(|arg| match name.strip_prefix("--") {
            Some(long) => {
                arg.get_long() == Some(long)
                    || arg.get_all_aliases().is_some_and(|all| all.contains(&long))
            }
            None => arg
                .get_short()
                .is_some_and(|short| name.strip_prefix('-') == Some(&short.to_string())),
        })
}

/// How many values an option takes.
fn values(option: &Arg) -> (usize, usize) {
    let range = option.get_num_args().unwrap_or_default();
    (range.min_values(), range.max_values())
}

/// The option that a command does not have.
fn unknown(error: &Error) -> Option<String> {
    match (error.kind(), error.get(ContextKind::InvalidArg)) {
        (ErrorKind::UnknownArgument, Some(ContextValue::String(word))) => Some(word.clone()),
        _ => None,
    }
    .filter(|word| word.starts_with('-'))
}

/// A command as it is typed.
fn called(tree: &Command, command: &Command) -> String {
    match std::ptr::eq(tree, command) {
        true => format!("`{}`", tree.get_name()),
        false => format!("`{} {}`", tree.get_name(), command.get_name()),
    }
}
