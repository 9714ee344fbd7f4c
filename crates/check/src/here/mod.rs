//! Certificates of what is determined at given cameras (section 14 of the specification; theory,
//! section 16). Nothing here is needed for a certificate about generic cameras.

mod centres;
mod cores;
mod document;

use crate::algebra::Field;
use crate::bodies::Known;
use crate::cameras::{Stream, prime};
use crate::core::Core;
use crate::document::{Members, Model};
use crate::draws;
use crate::elimination::Echelon;
use crate::kernel::{check_apart, edge_motion, plane_motion};
use crate::limits::Meter;
use crate::matrices::{bearings, plane_direction};
use crate::rejection::{Checked, Failure, Within, ensure};
use crate::setting::Setting;
use crate::structure::{Part, Structure};
use crate::{Graph, Limits, Strength};
use centres::Centres;
use document::{Class, Document, Piece, Split};
use std::fmt;

/// What a certificate at given cameras proves. There is no way to come by one but a check that passed.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct VerifiedHere {
    /// The number of nodes of the graph, and of its edges.
    pub size: [usize; 2],
    /// The SHA-256 of the graph, in lower-case hexadecimal digits.
    pub sha256: String,
    /// That of the centres.
    pub centres_sha256: String,
    /// The question.
    pub model: Model,
    /// Whether the cameras are determined.
    pub is_determined: bool,
    /// The rank at these cameras.
    pub rank: (i64, Strength),
    /// The rank that determines.
    pub required: i64,
    /// The number of components at these cameras.
    pub components: (i64, Strength),
}

impl fmt::Display for VerifiedHere {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let is = if self.is_determined {
            "determined"
        } else {
            "not-determined"
        };
        let [nodes, edges] = self.size;
        writeln!(f, "graph {} ({nodes} nodes, {edges} edges)", self.sha256)?;
        writeln!(f, "at cameras with centres {}", self.centres_sha256)?;
        writeln!(f, "model {}", self.model)?;
        writeln!(f, "verdict at these cameras {is} ({})", self.rank.1)?;
        writeln!(
            f,
            "rank there {} of {} ({})",
            self.rank.0, self.required, self.rank.1
        )?;
        write!(
            f,
            "components there {} ({})",
            self.components.0, self.components.1
        )
    }
}

/// Whether a text says that it is such a certificate.
pub fn is_here(text: &[u8]) -> bool {
    let format = format!("\"{}\"", document::FORMAT);
    text.windows(format.len())
        .any(|word| word == format.as_bytes())
}

/// A certificate at given cameras that has been parsed, but not verified.
#[derive(Debug)]
pub struct HereCertificate(Document);

impl HereCertificate {
    /// Reads the JSON text.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn parse(text: &[u8]) -> Result<Self, Failure> {
        document::parse(text).map(HereCertificate)
    }

    /// The hash of the graph that the certificate names.
    pub fn graph_sha256(&self) -> &str {
        &self.0.graph.sha256
    }

    /// Verifies it, for the given graph or the one that it holds.
    ///
    /// # Errors
    /// The first thing that cannot be verified, or not within the limits.
    pub fn check_within(
        &self,
        graph: Option<&Graph>,
        limits: &Limits,
    ) -> Result<VerifiedHere, Failure> {
        let HereCertificate(document) = self;
        let (graph, sha256) = document.graph.find(graph).within(|| "graph".into())?;
        let centres = &Centres::new(document, &graph).within(|| "centres".into())?;
        centres.check_bodies(document)?;
        let setting = &Setting {
            model: document.model,
            sha256,
            vectors: None,
            meter: &Meter::new(limits),
        };
        let known = Known {
            parts: &[],
            groups: &[],
        };
        let structure = &Structure::new(&graph, setting, (known, &document.bodies))?;
        let checker = Checker { structure, centres };
        let found = checker.section(&document.rigid, &document.pieces, &structure.everything)?;
        claim(document, found, &graph, centres).within(|| "claim".into())
    }
}

/// What a part of a certificate shows.
#[derive(Default)]
struct Found {
    rank: i64,
    components: i64,
    /// The errors of the pieces, and of all pieces inside of classes.
    errors: Vec<i64>,
    inner: Vec<i64>,
}

struct Checker<'a> {
    structure: &'a Structure<'a>,
    centres: &'a Centres<'a>,
}

impl Checker<'_> {
    /// Pieces of a whole (H5).
    fn section(&self, rigid: &Members, pieces: &[Piece], whole: &Part) -> Checked<Found> {
        let structure = self.structure;
        let mut parts = Vec::new();
        if !rigid.bodies.is_empty() || !rigid.edges.is_empty() {
            let members = structure.part(&rigid.bodies, &rigid.edges);
            parts.extend(
                members
                    .within(|| "rigid".into())?
                    .into_iter()
                    .map(|member| vec![member]),
            );
        }
        let mut found = Found::default();
        for part in &parts {
            found.rank += structure.required(part);
            found.components += 1;
        }
        for (k, piece) in pieces.iter().enumerate() {
            let step = || format!("pieces[{k}]");
            let part = structure.part(&piece.bodies, &piece.edges).within(step)?;
            ensure!(
                part.len() >= 2,
                "pieces[{k}] has fewer than two bodies and edges"
            );
            self.piece(piece, &part, &mut found).within(step)?;
            parts.push(part);
        }
        let divided = structure.owners(whole, &parts);
        divided.within(|| "pieces".into())?;
        structure.check_acyclic(&parts).within(|| "pieces".into())?;
        Ok(found)
    }

    /// A piece (H6 to H10).
    fn piece(&self, piece: &Piece, part: &Part, found: &mut Found) -> Checked<()> {
        let setting = self.structure.setting;
        let (core, nodes) = cores::core(self.structure, part, self.centres)?;
        let required = setting.model.required(core.nodes);
        let mut primes = self.primes(&core, &nodes);
        let (first, points) = primes.next()?;
        let rank = self.rank(&first, &points, &core)?;
        ensure!(
            rank == piece.rank,
            "the rank modulo the first prime is {rank}"
        );
        found.rank += self.structure.required(part) - (required - rank);
        if rank == required {
            ensure!(
                piece.primes == 1 && piece.kernel.is_empty() && piece.classes.is_empty(),
                "a rigid piece has one prime, no kernel and no classes"
            );
            found.components += 1;
            return Ok(());
        }
        ensure!(piece.primes > 0, "no primes");
        for _ in 1..piece.primes {
            let (field, points) = primes.next()?;
            let other = self.rank(&field, &points, &core)?;
            ensure!(other <= rank, "the rank modulo a prime is {other}");
        }
        let error = error(
            setting.model,
            rank,
            piece.primes,
            &core,
            self.centres.bits(&nodes),
        )?;
        found.errors.extend(error);
        found.inner.extend(error);
        self.classes(piece, part, (&core, &first, &points), found)
    }

    /// Classes that a motion tells apart (H9, H10).
    fn classes(
        &self,
        piece: &Piece,
        part: &Part,
        (core, field, points): (&Core, &Field, &[[u64; 3]]),
        found: &mut Found,
    ) -> Checked<()> {
        let structure = self.structure;
        ensure!(piece.classes.len() >= 2, "fewer than two classes");
        let list = piece
            .classes
            .iter()
            .map(|class| (&class.bodies, &class.edges));
        let (parts, owner) = structure.partition(part, list)?;
        let model = structure.setting.model;
        let width = match model {
            Model::Projective => 12,
            Model::Calibrated => 3,
            Model::Affine => 2,
        };
        ensure!(
            piece.kernel.len() == width * core.nodes && piece.kernel.iter().all(|x| x.0 < field.p),
            "`kernel` is no vector of residues"
        );
        let vector: Vec<u64> = piece.kernel.iter().map(|x| field.element(x.0)).collect();
        let classes = (&owner[..], parts.len());
        if model == Model::Affine {
            let plane: Vec<[u64; 2]> = points.iter().map(|&[x, y, _]| [x, y]).collect();
            check_apart(core, classes, |edge| {
                plane_motion(field, core, &plane, &vector, edge)
            })?;
        } else {
            check_apart(core, classes, |edge| {
                edge_motion(field, structure.setting, core, points, &vector, edge)
            })?;
        }
        for (k, (class, part)) in piece.classes.iter().zip(&parts).enumerate() {
            self.class(class, part, found)
                .within(|| format!("classes[{k}]"))?;
        }
        Ok(())
    }

    fn class(&self, class: &Class, part: &Part, found: &mut Found) -> Checked<()> {
        let Some(Split { rigid, pieces }) = &class.split else {
            found.components += 1;
            if part.len() == 1 {
                return Ok(());
            }
            let (core, nodes) = cores::core(self.structure, part, self.centres)?;
            let (field, points) = self.primes(&core, &nodes).next()?;
            let rank = self.rank(&field, &points, &core)?;
            ensure!(
                rank == self.structure.setting.model.required(core.nodes),
                "the class is not rigid: its rank is {rank}"
            );
            return Ok(());
        };
        ensure!(part.len() >= 2, "a single member is not split");
        let inner = self.section(rigid, pieces, part)?;
        found.components += inner.components;
        found.inner.extend(inner.inner);
        Ok(())
    }

    fn primes<'p>(&'p self, core: &'p Core, nodes: &'p [u32]) -> Primes<'p> {
        let hashes = [
            &self.structure.setting.sha256,
            &self.centres.sha256,
            &core.sha256,
        ];
        Primes {
            stream: centres::primes(hashes),
            centres: self.centres,
            core,
            nodes,
            seen: Vec::new(),
        }
    }

    /// The rank of a core at its points.
    fn rank(&self, field: &Field, points: &[[u64; 3]], core: &Core) -> Checked<i64> {
        let setting = self.structure.setting;
        core.charge_draw(setting)?;
        let mut rank = 0;
        match setting.model {
            Model::Projective => return draws::rank(field, points, setting, core),
            Model::Calibrated => {
                let mut echelon = Echelon::new(field, 3 * core.nodes, setting.meter);
                for row in bearings(field, core, points) {
                    rank += i64::from(echelon.push(row, None)?);
                }
            }
            Model::Affine => {
                let plane: Vec<[u64; 2]> = points.iter().map(|&[x, y, _]| [x, y]).collect();
                let mut echelon = Echelon::new(field, 2 * core.nodes, setting.meter);
                for row in 0..core.edges.len() {
                    let row = plane_direction(field, core, &plane, row);
                    rank += 4 * i64::from(echelon.push(row, None)?);
                }
            }
        }
        Ok(rank)
    }
}

/// The primes of a core that are not left out.
struct Primes<'a> {
    stream: Stream,
    centres: &'a Centres<'a>,
    core: &'a Core,
    nodes: &'a [u32],
    seen: Vec<u64>,
}

impl Primes<'_> {
    fn next(&mut self) -> Checked<(Field, Vec<[u64; 3]>)> {
        // Those that are left out divide some number of the certificate: they are few.
        for _ in 0..1000 {
            let field = prime(&mut self.stream)?;
            if self.seen.contains(&field.p) {
                continue;
            }
            if let Some(points) = self.centres.points(&field, self.nodes, self.core) {
                self.seen.push(field.p);
                return Ok((field, points));
            }
        }
        Err(Failure::rejected("no prime is left for the core"))
    }
}

/// The exponent of the error of an upper bound, or nothing if it is a proof (H8; theory, 16.3).
fn error(model: Model, rank: i64, primes: u64, core: &Core, bits: u64) -> Checked<Option<i64>> {
    let (rank, edges) = (rank as u64, core.edges.len() as u64);
    let bound = match model {
        Model::Projective => (rank + edges + 1) * (3 * bits + 3),
        Model::Calibrated => (rank + 1) * (2 * bits + 2),
        Model::Affine => (rank / 4 + 1) * (2 * bits + 2),
    };
    if primes.saturating_mul(61) >= bound {
        return Ok(None);
    }
    let size = i64::from(64 - (bound / 61).leading_zeros());
    let error = -((primes as i64).saturating_mul(53 - size));
    ensure!(
        size < 53 && error <= -100,
        "the error 2^{error} is too large"
    );
    Ok(Some(error))
}

/// The strength of what rests on several errors (section 8).
fn strength(errors: &[i64]) -> Checked<Strength> {
    let Some(&worst) = errors.iter().max() else {
        return Ok(Strength::Proof);
    };
    let more = i64::from(64 - (errors.len() as u64 - 1).leading_zeros());
    ensure!(
        worst + more <= -100,
        "the errors add up to 2^{}",
        worst + more
    );
    Ok(Strength::ErrorBound(worst + more))
}

/// The claim is what was found (H11).
fn claim(
    document: &Document,
    found: Found,
    graph: &Graph,
    centres: &Centres,
) -> Checked<VerifiedHere> {
    let claims = &document.claim;
    let (of_rank, of_components) = (strength(&found.errors)?, strength(&found.inner)?);
    let required = document.model.required(graph.nodes());
    let is_determined = found.rank == required;
    let verdict = if is_determined {
        "determined"
    } else {
        "not-determined"
    };
    let same = |name: &str, error: Option<i64>, strength: Strength| match strength {
        Strength::Proof => name == "proof" && error.is_none(),
        Strength::ErrorBound(e) => name == "error-bound" && error == Some(e),
    };
    ensure!(
        claims.verdict.value == verdict
            && same(&claims.verdict.strength, claims.verdict.error_log2, of_rank),
        "the verdict is {verdict} ({of_rank})"
    );
    ensure!(
        (claims.rank.value, claims.rank.required) == (found.rank, required)
            && same(&claims.rank.strength, claims.rank.error_log2, of_rank),
        "the rank is {} of {required} ({of_rank})",
        found.rank
    );
    ensure!(
        claims.components.value == found.components
            && same(
                &claims.components.strength,
                claims.components.error_log2,
                of_components
            ),
        "there are {} components ({of_components})",
        found.components
    );
    Ok(VerifiedHere {
        size: [graph.nodes(), graph.pairs.len()],
        sha256: document.graph.sha256.clone(),
        centres_sha256: centres
            .sha256
            .iter()
            .map(|byte| format!("{byte:02x}"))
            .collect(),
        model: document.model,
        is_determined,
        rank: (found.rank, of_rank),
        required,
        components: (found.components, of_components),
    })
}
