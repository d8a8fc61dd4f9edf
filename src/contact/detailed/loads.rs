//! States of a mesh in full detail, its loads, and the loaded slices and openings of its pairs.

use super::sums::Approach;
use crate::contact::{Flank, Sliding, Spot};
use crate::numeric::{Jet, Scalar};

/// Position and motion of a mesh with the axial displacement w of its side gear.
#[derive(Clone, Copy, Debug)]
pub struct DetailedState {
    /// q, x [rad] and w [m].
    pub position: [f64; 3],
    /// Rates of the position.
    pub rate: [f64; 3],
    /// Number of tooth pairs by which the planet's position was wrapped, positive in the direction of x.
    pub wrapped: i64,
}

/// Loads of a mesh.
#[derive(Clone, Copy, Debug)]
pub struct DetailedLoad<T> {
    /// Forces conjugate to q, x [N·m] and w [N].
    pub force: [T; 3],
    /// Thrust on the planet along its axis, away from the apex [N]. This and the next two forces are summed only if
    /// something rubs under them.
    pub planet_axial: T,
    /// Thrust on the side gear along its axis away from the apex [N].
    pub side_axial: T,
    /// Force on the side gear along the carrier's direction of rotation [N].
    pub tangential: T,
    /// Heat of contact damping and of tooth friction [W].
    pub heat: [f64; 2],
    /// Elastic energy [J], summed only together with derivatives.
    pub energy: f64,
}

impl<T> DetailedLoad<T> {
    /// Converts the forces with `f`, for example to another number type.
    #[inline(always)]
    pub fn map<U>(self, f: impl Fn(T) -> U) -> DetailedLoad<U> {
        DetailedLoad {
            force: self.force.map(&f),
            planet_axial: f(self.planet_axial),
            side_axial: f(self.side_axial),
            tangential: f(self.tangential),
            heat: self.heat,
            energy: self.energy,
        }
    }
}

impl<T: Scalar> DetailedLoad<T> {
    /// No load.
    pub fn zero() -> Self {
        let zero = T::constant(0.0);
        Self { force: [zero; 3], planet_axial: zero, side_axial: zero, tangential: zero, heat: [0.0; 2], energy: 0.0 }
    }
}

/// One loaded slice of one tooth pair, for outputs of individual loads.
#[derive(Clone, Copy, Debug)]
pub struct SliceLoad<'a> {
    /// Kind of contact.
    pub spot: Spot,
    /// Arc Δ past the end of the path, or the position on the path if the pair is on it [rad].
    pub spot_arc: f64,
    /// Cone distance [m].
    pub cone: f64,
    /// Fraction of the face that the slice represents, by its share of J.
    pub share: f64,
    /// Normal force per width [N/m].
    pub line_load: f64,
    /// Penetration arc of the slice [rad].
    pub arc: f64,
    /// Position on the path [rad].
    pub s: f64,
    /// Elastic energy [J].
    pub energy: f64,
    /// Teeth in contact, numbered in the unrolled sequence.
    pub name: PairName,
    /// Normal force [N].
    pub normal: f64,
    /// Friction force along the flank, positive toward the planet's root on the planet [N].
    pub friction: f64,
    /// Sliding of the flanks, if friction is modelled.
    pub sliding: Option<Sliding<f64>>,
    /// Components of the unit normal: along the planet's axis, along the side gear's axis, along the rotation.
    pub components: [f64; 3],
    /// Approach of the pair's flanks and its rates.
    pub approach: Approach,
    /// Gap or excess material between the pair's flanks.
    pub opening: &'a Opening,
}

/// A slice of the face.
#[derive(Clone, Copy, Debug)]
pub struct Slice {
    /// Cone distance R_j [m].
    pub cone: f64,
    /// J_j, the slice's share of ∫R² dR [m³], or a share of 1 if the law has one resultant for the face.
    pub weight: f64,
    /// Width over which the slice's force is spread [m].
    pub width: f64,
}

/// Opening of the flanks of a pair at its position s: e(R, s) = E(s) + turn R + bend R² [m], with additional depth
/// beyond the edge of a broken tooth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Opening {
    /// E [m] with its slopes with respect to s.
    pub even: Jet,
    /// Rotation of one flank against the other about the apex [rad].
    pub turn: f64,
    /// Half the curvature over the face, not negative [1/m].
    pub bend: f64,
    /// Cone distance beyond which material is missing, and its depth [m].
    pub edge: Option<(f64, f64)>,
}

impl Opening {
    /// Flanks that fit.
    pub const NONE: Self = Self { even: Jet { v: 0.0, d: 0.0, dd: 0.0 }, turn: 0.0, bend: 0.0, edge: None };

    /// Adds the opening caused by an axial displacement `w` [m] of the side gear, given ν and ∂ν/∂s.
    #[inline(always)]
    pub fn displace(&mut self, w: f64, [nu, nu_slope]: [f64; 2]) {
        self.even.v += w * nu;
        self.even.d += w * nu_slope;
        self.even.dd -= w * nu;
    }

    /// e [m] at the cone distance `r` [m].
    pub fn at(&self, r: f64) -> f64 {
        let missing = self.edge.map_or(0.0, |(edge, depth)| if r > edge { depth } else { 0.0 });
        self.even.v + r * (self.turn + r * self.bend) + missing
    }
}

/// Identity of a tooth pair: its mesh, flank and tooth in the unrolled sequence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PairName {
    /// Planet.
    pub planet: usize,
    /// Side, 0 left and 1 right.
    pub side: usize,
    /// Flank.
    pub flank: Flank,
    /// Number of the planet's tooth, counted from the mesh's own line at the start and in the direction of x.
    pub tooth: i64,
}

impl PairName {
    /// Returns the name of pair `number` of `flank` in the mesh of `planet` with side gear `side`. The planet's
    /// position was wrapped by `wrapped` pairs in the direction of x.
    #[inline(always)]
    pub fn new((planet, side): (usize, usize), flank: Flank, number: i64, wrapped: i64) -> Self {
        let tooth = if flank == Flank::Drive {
            number.wrapping_sub(wrapped)
        } else {
            number.wrapping_add(wrapped).wrapping_neg()
        };
        Self { planet, side, flank, tooth }
    }
}
