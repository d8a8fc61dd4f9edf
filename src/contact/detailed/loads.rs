//! States of a mesh in full detail, its loads, and the slices and gaps that they are made of.

use super::super::pairs::{Flank, Spot, ToothPair};
use super::super::tooth_friction::Sliding;

/// Position and motion of a mesh with the axial displacement w of its side gear.
#[derive(Clone, Copy, Debug)]
pub struct DetailedState<T> {
    /// q, x [rad] and w [m].
    pub position: [T; 3],
    /// Their rates.
    pub rate: [T; 3],
    /// Tooth pairs by which the planet's position was wrapped, positive with x.
    pub wrapped: i64,
}

/// Loads of a mesh.
#[derive(Clone, Copy, Debug)]
pub struct DetailedLoad<T> {
    /// Forces conjugate to q, x [N·m] and w [N].
    pub force: [T; 3],
    /// Sum of normal forces [N].
    pub normal: T,
    /// Thrust on the planet along its axis away from the apex [N].
    pub planet_axial: T,
    /// Thrust on the side gear along its axis away from the apex [N].
    pub side_axial: T,
    /// Force on the side gear along the carrier's direction of rotation [N].
    pub tangential: T,
    /// Heat of contact damping and of tooth friction [W].
    pub heat: [f64; 2],
}

/// One loaded slice of one tooth pair, for outputs of single loads.
#[derive(Clone, Copy, Debug)]
pub struct SliceLoad<'a> {
    /// The pair.
    pub pair: &'a ToothPair,
    /// Kind of contact, and the arc Δ past the end of the path or the place on it [rad].
    pub spot: Spot,
    /// See `spot`.
    pub place: f64,
    /// Cone distance [m].
    pub cone: f64,
    /// Fraction of the face that the slice represents, by its share of J.
    pub share: f64,
    /// Normal force per width [N/m].
    pub line_load: f64,
    /// Its penetration arc [rad].
    pub arc: f64,
    /// Place on the path [rad].
    pub s: f64,
    /// Elastic energy [J].
    pub energy: f64,
    /// Teeth in contact, of the unrolled sequence.
    pub name: PairName,
    /// Normal force [N].
    pub normal: f64,
    /// Friction force along the flank, positive toward the planet's root on the planet [N].
    pub friction: f64,
    /// Sliding of the flanks, if friction is modelled.
    pub sliding: Option<Sliding<f64>>,
    /// Direction parts of the normal: along the planet's axis, along the side gear's axis, along the rotation.
    pub parts: [f64; 3],
}

/// A slice of the face.
#[derive(Clone, Copy, Debug)]
pub struct Slice {
    /// Cone distance R_j [m].
    pub cone: f64,
    /// J_j, its share of ∫R² dR [m³] (of the whole where the law is one for the face).
    pub weight: f64,
    /// Width over which its force is spread [m].
    pub width: f64,
}

/// What tooth errors add to the gap of a pair, slice by slice [m].
pub trait Gaps: Send + Sync + std::fmt::Debug {
    /// Gap e with its first and, if `twice`, its second derivative by s.
    fn at(&self, pair: PairName, slice: usize, s: f64, twice: bool) -> [f64; 3];
    /// Lower bound of all gaps (zero or negative).
    fn least(&self) -> f64;
}

/// Which teeth, of the unrolled sequence, meet in which mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PairName {
    /// Planet.
    pub planet: usize,
    /// Side, 0 left and 1 right.
    pub side: usize,
    /// Flank.
    pub flank: Flank,
    /// Number of the planet's tooth, counted from the mesh's own line at the start and in the sense of x.
    pub tooth: i64,
}
