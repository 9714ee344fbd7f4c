//! From options to a plan: what is decided, and what is done with the answer.
//!
//! In: the arguments of `verify GRAPH` and of the commands that do something about an answer. Out: a
//! [`Plan`], or by name what does not go together. All rules stand here and in the library's
//! [`Question`]; what carries a plan out never looks back at options.

use super::certificates::Target;
use super::given;
use anyhow::{Context, Result, ensure};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use viewcert::Known;
use viewcert::decide::Meaningless;
use viewcert::decide::{Arithmetic, Options, Prime, Question};
use viewcert::geometry::model::Model;
use viewcert_advice::Request;
use viewcert_formats::ReadOptions;
use viewcert_report::assumptions::Asked;
use viewcert_session::outputs;

/// What is decided, and what is done with the answer.
pub(super) struct Plan {
    /// The files with graphs.
    pub(super) graphs: Vec<PathBuf>,
    /// How they are read.
    pub(super) read: ReadOptions,
    /// What else was said of how they are decided, for the records.
    pub(super) said: BTreeMap<String, String>,
    /// The file with what is given besides.
    pub(super) given: Option<PathBuf>,
    /// Whether that is in the frame of the directions.
    pub(super) one_frame: bool,
    /// Where classes of cameras are from, if that is asked.
    pub(super) intrinsics: Option<IntrinsicsFrom>,
    /// The question, without what is given.
    pub(super) question: Question,
    /// The prime.
    pub(super) prime: Prime,
    /// The seed of all draws.
    pub(super) seed: u64,
    /// What is asked about the scope of the answer.
    pub(super) asked: Asked,
    /// What is asked about the answer.
    pub(super) request: Request,
    /// Files that are written.
    pub(super) products: Products,
    /// How the report is printed.
    pub(super) form: Form,
    /// Whether it lists the members of every component.
    pub(super) list_components: bool,
}

/// Where classes of cameras are from.
pub(super) enum IntrinsicsFrom {
    /// A file.
    File(PathBuf),
    /// The graph's own database, by prior focal lengths.
    Input,
    /// The same, with all focal lengths unknown.
    Free,
}

impl From<Option<PathBuf>> for IntrinsicsFrom {
    /// What stands behind the option.
    fn from(file: Option<PathBuf>) -> Self {
        match file {
            None => Self::Input,
            Some(word) if word == Path::new("free") => Self::Free,
            Some(file) => Self::File(file),
        }
    }
}

/// Files that are written for a graph, each whole or not at all.
#[derive(Default)]
pub(super) struct Products {
    /// The certificate, or the folder for the certificates of all graphs.
    pub(super) certificate: Option<PathBuf>,
    /// The explicit proof.
    pub(super) proof: Option<PathBuf>,
    /// Two families of cameras with the same fundamental matrices.
    pub(super) witness: Option<PathBuf>,
    /// The page.
    pub(super) page: Option<PathBuf>,
    /// The picture.
    pub(super) picture: Option<PathBuf>,
}

/// How a report is printed.
pub(super) enum Form {
    /// Some lines a graph.
    Text,
    /// One JSON object a graph.
    Json,
    /// Comma-separated values, a row a graph.
    Table,
}

/// The name of the file for certificates in messages.
pub(super) const CERTIFICATE: &str = "--certificate";
/// The same of the explicit proof.
pub(super) const PROOF: &str = "--proof";

/// The same of the list of pairs to match.
const WRITE: &str = "--write";

/// The name of the classes of cameras in messages.
pub(super) const INTRINSICS: &str = "--intrinsics";

impl Plan {
    /// The usual question of a model about some graphs, and a report in lines.
    pub(super) fn new(graphs: &[PathBuf], read: ReadOptions, model: Model, seed: u64) -> Self {
        Self {
            graphs: graphs.to_vec(),
            read,
            said: BTreeMap::new(),
            given: None,
            one_frame: false,
            intrinsics: None,
            question: model.into(),
            prime: Prime::Auto,
            seed,
            asked: Asked::default(),
            request: Request::default(),
            products: Products::default(),
            form: Form::Text,
            list_components: false,
        }
    }

    /// Refuses what does not go together, as far as it shows before a graph is read.
    ///
    /// # Errors
    /// By name, what does not go together, and what to leave out.
    pub(super) fn checked(self) -> Result<Self> {
        self.check_question()?;
        self.check_intrinsics()?;
        self.check_products()?;
        self.check_files()?;
        if let Some(reason) = self.too_many(&format!("{} graphs", self.graphs.len())) {
            ensure!(self.graphs.len() <= 1, reason);
        }
        Ok(self)
    }

    fn check_question(&self) -> Result<()> {
        let (model, of_tracks) = (self.question.model, self.read.tracks.is_some());
        ensure!(
            !of_tracks || model.in_space(),
            "--tracks: observations are directions of known rotations, which only the calibrated \
             model has; leave out --model, or say --model calibrated"
        );
        ensure!(
            !self.asked.planar || !model.in_plane(),
            "--planar: affine cameras have no centres that could lie in a plane; leave out --planar, \
             or --model affine"
        );
        ensure!(
            matches!(self.prime, Prime::Auto) || !model.in_plane(),
            "--prime: the affine model is decided by counting alone; leave out one of the two"
        );
        self.question.clone().checked()?;
        ensure!(
            !self.question.whole_graph || self.given.is_none(),
            Meaningless::KnownOverWholeGraph
        );
        Ok(())
    }

    /// Classes of cameras are about the pairs of the projective model alone.
    fn check_intrinsics(&self) -> Result<()> {
        if self.intrinsics.is_none() {
            return Ok(());
        }
        ensure!(
            !self.question.model.is_linear(),
            "{INTRINSICS}: says what is known of each camera, and --model says it of all; leave out one of \
             the two"
        );
        ensure!(
            self.given.is_none(),
            "{INTRINSICS}: nothing is proved yet about classes of cameras beside what is given; leave out \
             {}",
            given::OPTION
        );
        ensure!(
            !self.asked.planar,
            "{INTRINSICS}: nothing is proved about classes of cameras in a plane; leave out one of the two"
        );
        ensure!(
            !self.question.whole_graph,
            "{INTRINSICS}: is decided between bodies; leave out --method matrix"
        );
        ensure!(
            self.products.proof.is_none(),
            "{INTRINSICS}: explicit proofs do not state classes of cameras; leave out {PROOF}"
        );
        ensure!(
            !matches!(self.form, Form::Table),
            "{INTRINSICS}: a table has no columns for it; leave out one of the two"
        );
        Ok(())
    }

    /// The file with classes of cameras.
    fn intrinsics_file(&self) -> Option<&Path> {
        match &self.intrinsics {
            Some(IntrinsicsFrom::File(path)) => Some(path),
            _ => None,
        }
    }

    /// What is written has to be there to be written.
    fn check_products(&self) -> Result<()> {
        if self.products.proof.is_some() {
            ensure!(
                self.given.is_none(),
                "{PROOF}: explicit proofs rest on pairs alone; leave out {}",
                given::OPTION
            );
        }
        Ok(())
    }

    /// All files that are written, behind what they are called in messages.
    pub(super) fn files(&self) -> [(&'static str, Option<&Path>); 6] {
        let products = &self.products;
        [
            (CERTIFICATE, products.certificate.as_deref()),
            (PROOF, products.proof.as_deref()),
            ("witness", products.witness.as_deref()),
            ("page", products.page.as_deref()),
            ("picture", products.picture.as_deref()),
            (WRITE, self.request.write.as_deref()),
        ]
    }

    /// No output is an input or another output, and standard input is one thing.
    fn check_files(&self) -> Result<()> {
        let inputs = self.graphs.iter().chain(&self.given);
        let inputs = inputs.map(PathBuf::as_path).chain(self.intrinsics_file());
        let files = self.files();
        // A folder of certificates is no file that could be the same.
        let is_folder = files[0].1.is_some_and(Path::is_dir);
        let from = usize::from(is_folder);
        outputs::ensure_apart(&files[from..], inputs)?;
        self.request.check()?;
        given::ensure_one_standard_input(given::OPTION, self.given.as_deref(), &self.graphs)?;
        given::ensure_one_standard_input(INTRINSICS, self.intrinsics_file(), &self.graphs)
    }

    /// Why there cannot be several graphs, if there cannot.
    pub(super) fn too_many(&self, what: &str) -> Option<String> {
        let files = self.files().into_iter();
        let mut files = files.filter_map(|(name, path)| Some((name, path?)));
        let given = self.given.as_deref().map(|path| (given::OPTION, path));
        let given = given.or(self.intrinsics_file().map(|path| (INTRINSICS, path)));
        let single = |&(name, path): &(&str, &Path)| name != CERTIFICATE || !path.is_dir();
        match files.find(single).or(given) {
            Some((CERTIFICATE, path)) => Some(Target::too_many(path, what)),
            Some((name, path)) => Some(given::too_many(name, path, what)),
            None => self.request.too_many(what),
        }
    }

    /// Where certificates go, if they go anywhere.
    ///
    /// # Errors
    /// If one file is meant and there are several graphs.
    pub(super) fn target(&self) -> Option<Target> {
        let path = self.products.certificate.as_deref()?;
        Some(Target::new(path))
    }

    /// How a graph is decided of which this is known.
    ///
    /// # Errors
    /// If the question has no use for it.
    pub(super) fn options(&self, known: Known) -> Result<Options> {
        if !matches!(known, Known::Parts(_)) {
            ensure!(
                !self.asked.planar,
                "--planar: in a plane nothing is proved about known displacements; leave out one of the \
                 two"
            );
        }
        let question = Question {
            known,
            ..self.question.clone()
        };
        let question = question.checked().context(given::OPTION)?;
        Ok(Options::default()
            .question(question)
            .prime(self.prime)
            .seed(self.seed))
    }

    /// Whether cameras are rational.
    pub(super) fn is_rational(&self) -> bool {
        self.question.arithmetic != Arithmetic::Prime
    }
}
