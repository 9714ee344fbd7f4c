//! Certificates of what is determined at given cameras (section 14 of the specification; theory,
//! section 16). Nothing here is needed for a certificate about generic cameras.

mod centres;
mod claim;
mod cores;
mod document;
mod primes;

pub use claim::VerifiedHere;

use crate::Graph;
use crate::algebra::Field;
use crate::bodies::Known;
use crate::core::Core;
use crate::document::{Members, Model};
use crate::draws;
use crate::elimination::Echelon;
use crate::kernel::{check_apart, edge_motion, plane_motion};
use crate::limits::Meter;
use crate::matrices::{bearings, plane_direction};
use crate::rejection::{Checked, Within, ensure};
use crate::setting::Setting;
use crate::structure::{Part, Structure};
use centres::Centres;
use claim::claim;
pub(crate) use document::Document;
use document::{Class, Piece, Split};
use primes::{Primes, bound, error};

/// Verifies a certificate at given cameras, for the given graph or the one that it holds.
pub(crate) fn check(
    document: &Document,
    graph: Option<&Graph>,
    meter: &Meter,
) -> Checked<VerifiedHere> {
    Graph::ensure_bare(graph)?;
    let (graph, sha256) = document.graph.find(graph).within(|| "graph".into())?;
    let centres = Centres::new(document, &graph, meter).within(|| "centres".into())?;
    centres.check_bodies(document)?;
    let centres = &centres;
    let setting = &Setting::bare(document.model, sha256, meter);
    let bodies = (Known::default(), &document.bodies[..]);
    let structure = &Structure::new(&graph, setting, bodies)?;
    let checker = Checker { structure, centres };
    let found = checker.section(&document.rigid, &document.pieces, &structure.everything)?;
    claim(document, &found, &graph, centres).within(|| "claim".into())
}

/// What a part of a certificate shows.
#[derive(Default)]
struct Found {
    rank: i64,
    components: usize,
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
        let bound = bound(setting.model, rank, &core, self.centres.bits(&nodes));
        let most = bound.div_ceil(61);
        ensure!(
            piece.primes <= most,
            "{} primes, and {most} are a proof",
            piece.primes
        );
        for _ in 1..piece.primes {
            let (field, points) = primes.next()?;
            let other = self.rank(&field, &points, &core)?;
            ensure!(other <= rank, "the rank modulo a prime is {other}");
        }
        let error = error(piece.primes, bound)?;
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
        if model.in_plane() {
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
        Primes::new(self.structure, self.centres, (core, nodes))
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
