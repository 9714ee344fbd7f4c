//! What is asked about a verdict, and the answers to it.

use crate::named::Advice;
use crate::task::{Task, Weak};
use crate::{export, folder};
use anyhow::{Result, bail, ensure};
use std::collections::BTreeSet;
use std::path::PathBuf;
use viewcert::Verdict;
use viewcert::watch::Watch;
use viewcert_formats::NamedGraph;
use viewcert_session::Outputs;

/// What is asked; joints are looked for in any case.
#[derive(Clone, Debug, Default)]
pub struct Request {
    /// What a component hangs on.
    pub weak: Option<Weak>,
    /// Pairs that would join components, so many at most; with tracks also how much has to come of it.
    pub suggest: Option<u32>,
    /// The file that gets those of them that are left to match, as COLMAP takes them.
    pub write: Option<PathBuf>,
    /// An image, by its label, to be explained.
    pub explain: Option<String>,
    /// The folder that gets the components as COLMAP takes them.
    pub export: Option<PathBuf>,
}

impl Request {
    /// Refuses what can be refused before a graph is read.
    ///
    /// # Errors
    /// A folder with something in it.
    pub fn check(&self) -> Result<()> {
        match self.export.as_deref() {
            Some(place) => folder::ensure_new("export", place),
            None => Ok(()),
        }
    }

    /// Why there cannot be several graphs, if there cannot.
    pub fn too_many(&self, what: &str) -> Option<String> {
        let folder = self.export.as_ref()?.display();
        Some(format!(
            "export {folder}: a folder holds the components of one graph, and there are {what}; \
             run them one by one"
        ))
    }

    /// The options that weigh the pairs of a graph and nothing else.
    fn asked_of_pairs(&self) -> impl Iterator<Item = &'static str> {
        let asked = [
            (self.weak.is_some(), "--weak"),
            (self.suggest.is_some(), "--suggest"),
            (self.explain.is_some(), "--explain"),
        ];
        let asked = asked.into_iter();
        asked.filter_map(|(asked, option)| asked.then_some(option))
    }

    /// Refuses options that have no answer where so much is known besides pairs and tracks.
    ///
    /// # Errors
    /// The first such option.
    pub fn ensure_alone(&self, known: &str) -> Result<()> {
        let mut asked = self.asked_of_pairs();
        match asked.find(|option| !["--suggest", "--explain"].contains(option)) {
            None => Ok(()),
            Some(option) => bail!(
                "{option} looks at pairs or tracks alone, and {known} would be left out of account; \
                 leave out --given, and rigs by --no-rigs"
            ),
        }
    }

    /// Whether more than the joints is asked for.
    pub fn asks(&self) -> bool {
        self.asked_of_pairs().next().is_some() || self.export.is_some()
    }

    /// Does what is asked for; joints are always looked for, but not with displacements that are given
    /// as numbers, which are in no general position.
    ///
    /// # Errors
    /// Those of decisions and of the folder; an image that is not there; work that was stopped.
    pub fn advise(
        &self,
        outputs: &Outputs,
        input: &NamedGraph,
        verdict: &Verdict,
        seed: u64,
        watch: Watch,
    ) -> Result<Advice> {
        if let Some(option) = self.asked_of_pairs().next() {
            ensure!(
                verdict.known_parts.is_empty(),
                "{option} weighs the pairs of a graph alone, and this verdict rests on known parts; \
                 leave out one of the two"
            );
        }
        if !verdict.displacements.is_empty() {
            self.ensure_alone("known displacements")?;
        }
        if verdict.displacements.vectors().is_some() {
            ensure!(
                self.asked_of_pairs().next().is_none(),
                "displacements that are given as numbers join components in ways of their own, and nothing \
                 is said about these; give them without numbers"
            );
            let mut advice = Advice::without_joints(verdict.components.len() < 2);
            if let Some(folder) = &self.export {
                let task = Task::new(input, verdict, seed, watch);
                advice.export = Some(export::write(outputs, folder, &task)?);
            }
            return Ok(advice);
        }
        if verdict.components.len() < 2 && !self.asks() {
            return Ok(Advice::whole());
        }
        let task = Task::new(input, verdict, seed, watch);
        let (mut advice, joints) = task.joints()?;
        if let Some(what) = self.weak {
            advice.weak = Some(task.weak(what)?);
        }
        if let Some(most) = self.suggest {
            let found = task.suggest(&joints, most as usize, None)?;
            let mut seen = BTreeSet::new();
            let open = found.iter().flat_map(|one| &one.open);
            let open: Vec<&[String; 2]> = open.filter(|pair| seen.insert(*pair)).collect();
            if open.is_empty() && !advice.is_whole {
                advice.photograph = task.photograph();
            }
            if let Some(list) = &self.write {
                advice.to_match = Some(export::write_pairs(outputs, list, &task, &open)?);
            }
            advice.suggestions = Some(found);
        }
        if let Some(image) = &self.explain {
            advice.explain = Some(task.explain(&joints, image)?);
        }
        if let Some(folder) = &self.export {
            advice.export = Some(export::write(outputs, folder, &task)?);
        }
        Ok(advice)
    }
}
