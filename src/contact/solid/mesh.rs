//! A mesh of solid teeth: the potential of all overlapping pairs and sections.
//!
//! V(q, x) = Σ_k Σ_j ω_j U(R_m p_kj(q, x)), Σ_j ω_j = 1
//!
//! The sum is over pairs k and sections j across the face. p is the overlap of a section as an arc
//! ([`super::overlap`]), and U the energy of the law of a pair (IMPACT). Slices of a straight bevel tooth are similar,
//! so the load per width depends only on the arc. If the arc of a section changes by δp, the section yields by R_j δp
//! at its cone distance. Its force is therefore
//!
//! F_j = ω_j R_m/R_j U′(R_m p_kj)
//!
//! This is the only force that balances the torques. If ω_j is proportional to R_j times the section's width, aligned
//! flanks load the face evenly. The resultant then acts at R_m, and V is the potential of tooth pairs on the path of
//! contact. On misaligned or crowned flanks, the load of every section follows from its own overlap.

use super::candidates::Candidates;
use super::flank::Flanks;
use super::overlap::Patch;
use super::turned::Both;
use super::walk::FlankSection;
use super::{Displacement, Placement, SineCosine, Softness, ToothAngles, TurningRay};
use crate::contact::impact::Force;
use crate::contact::state::{MeshForce, MeshJacobian, MeshState};
use crate::contact::{Damping, Flank, Impact};
use crate::geometry::Pair;
use crate::numeric::tan;

/// A section across the face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolidSlice {
    /// Cone distance R_j [m].
    pub cone: f64,
    /// ω_j.
    pub share: f64,
    /// Width that the section represents [m].
    pub width: f64,
    /// Material of the pair removed by crowning at this section [m].
    pub relief: f64,
}

/// Definition of the solids.
#[derive(Clone, Debug)]
pub struct SolidSpec {
    /// Angular radius of the root fillets [rad].
    pub fillet: f64,
    /// Facets per flank.
    pub facets: usize,
    /// Factor of the default softness.
    pub smoothing: f64,
    /// Sections across the face, or one at R_m if all would be identical.
    pub slices: Vec<SolidSlice>,
    /// Displacement of each planet relative to the left and right side gear.
    pub displaced: Vec<[Displacement; 2]>,
}

/// Ratio of ε to the height of the flanks' arcs over their facets, added for both gears. The patch is almost as wide as
/// a facet, so it passes from one facet to the next without a ripple. If its half-width is c facets, the first harmonic
/// of the facets is damped by exp(−2π²c²).
const SOFTNESS: f64 = 1.25;

/// Upper bound of a flank's length [rad].
const LONGEST: f64 = 1.0;

/// A section with the planet's rays in every placement.
#[derive(Clone, Debug)]
pub(super) struct PlacedSlice {
    pub(super) slice: SolidSlice,
    planet_rays: Vec<Vec<TurningRay>>,
}

/// A mesh of solid teeth.
#[derive(Clone, Debug)]
pub struct SolidMesh {
    /// Law of a section, scaled to the whole face.
    pub elastic: Impact,
    /// Damping.
    pub damping: Damping,
    pub(super) cone: f64,
    flanks: Flanks,
    teeth: ToothAngles,
    candidates: Candidates,
    soft: Softness,
    pub(super) slices: Vec<PlacedSlice>,
    /// Sections without a share of the load, at which the load is only evaluated.
    pub(super) edges: Vec<PlacedSlice>,
    /// Distinct placements of drive flanks, and of coast flanks as their mirror images.
    placements: Vec<Placement>,
    /// Indices of `placements` for each planet, side and flank (drive, coast).
    placed: Vec<[[usize; 2]; 2]>,
    side_rays: Vec<TurningRay>,
    half_backlash: f64,
    base_pitch: f64,
    centred: f64,
    /// Magnitude of the negative approach from which flanks can still touch [rad].
    slack: f64,
}

impl SolidMesh {
    /// Returns the mesh of `pair`, whose planets may be displaced. `slack` [m] bounds the gap that displacements can
    /// close.
    pub fn new(pair: &Pair, spec: &SolidSpec, elastic: Impact, damping: Damping, slack: f64) -> Self {
        let flanks = Flanks::new(pair, spec.fillet, spec.facets);
        let width = SOFTNESS * spec.smoothing * (flanks.sagitta[0] + flanks.sagitta[1]);
        let relative = 1.0 / (1.0 / tan(pair.pitch_arc[0]) + 1.0 / tan(pair.pitch_arc[1]));
        let soft = Softness::new(width, relative, LONGEST);
        let slack = slack / pair.inner_cone;
        let mut displacements: Vec<Displacement> = Vec::new();
        let mut number = |d: Displacement| {
            displacements.iter().position(|known| *known == d).unwrap_or_else(|| {
                displacements.push(d);
                displacements.len() - 1
            })
        };
        let placed = spec.displaced.iter().map(|sides| sides.map(|d| [number(d), number(d.mirrored())])).collect();
        let mut mesh = Self {
            elastic,
            damping,
            cone: pair.mean_cone,
            candidates: Candidates::new(pair, &flanks, slack + soft.excess),
            side_rays: Placement::new(pair, &Displacement::default()).side_rays(&flanks.rays[1]),
            flanks,
            teeth: ToothAngles::new(pair),
            slack: slack + soft.excess,
            soft,
            slices: Vec::new(),
            edges: Vec::new(),
            placements: displacements.iter().map(|d| Placement::new(pair, d)).collect(),
            placed,
            half_backlash: pair.normal_backlash / 2.0,
            base_pitch: pair.base_pitch,
            centred: pair.centred_position(),
        };
        mesh.slices = mesh.place(&spec.slices);
        mesh
    }

    /// Adds the sections `edges`, at which the load is only evaluated.
    pub fn with_edges(mut self, edges: &[SolidSlice]) -> Self {
        self.edges = self.place(edges);
        self
    }

    fn place(&self, slices: &[SolidSlice]) -> Vec<PlacedSlice> {
        let rays = |slice: &SolidSlice| {
            let rays = |placement: &Placement| placement.planet_rays(&self.flanks.rays[0], slice.cone, slice.relief);
            self.placements.iter().map(rays).collect()
        };
        slices.iter().map(|slice| PlacedSlice { slice: *slice, planet_rays: rays(slice) }).collect()
    }

    /// Number of sections across the face.
    pub fn section_count(&self) -> usize {
        self.slices.len()
    }

    /// Calls `visit` with each of `slices` of each pair near contact, and the overlap [rad] as a function of (q, x)
    /// with derivatives up to order `N`.
    #[inline(always)]
    pub(super) fn sections<const N: usize>(
        &self,
        slices: &[PlacedSlice],
        which: [usize; 2],
        [q, x]: [f64; 2],
        mut visit: impl FnMut(&FlankPair, &PlacedSlice, Both<N>),
    ) {
        for (flank, sign) in [(Flank::Drive, 1.0), (Flank::Coast, -1.0)] {
            let (q, x) = (sign * q, sign * x);
            if -q - self.half_backlash + self.slack <= 0.0 {
                continue;
            }
            // the mesh repeats with every base pitch
            let turns = libm::round(x / self.base_pitch);
            let x = x - turns * self.base_pitch;
            let placed = self.placed[which[0]][which[1]][usize::from(flank == Flank::Coast)];
            let stance = self.teeth.stance(q, x);
            for k in self.candidates.near(q, x) {
                let Some(angles) = self.teeth.angles(&stance, k) else { continue };
                let s = self.centred + x + f64::from(k) * self.base_pitch;
                let number = (-turns as i64).saturating_add(i64::from(k));
                let near = FlankPair { flank, placed, number, s, angles, start: self.flanks.closest(s) };
                for slice in slices {
                    if let Some(depth) = self.section(&near, slice).depth::<N>(&self.soft) {
                        visit(&near, slice, self.teeth.by_position(depth, sign));
                    }
                }
            }
        }
    }

    #[inline(always)]
    fn section<'a>(&'a self, near: &FlankPair, slice: &'a PlacedSlice) -> FlankSection<'a> {
        let rays = [slice.planet_rays[near.placed].as_slice(), &self.side_rays];
        FlankSection { rays, angles: near.angles, start: near.start }
    }

    /// Placement of a pair, and the contact patch of one of its sections.
    pub(super) fn patch(&self, near: &FlankPair, slice: &PlacedSlice) -> Option<(&Placement, Patch)> {
        let placement = &self.placements[near.placed];
        let normal =
            |gear: usize, ray: usize| placement.turned(gear, near.angles[gear], &self.flanks.rays[gear][ray].normal);
        self.section(near, slice).patch(&self.soft, normal).map(|patch| (placement, patch))
    }

    /// Force of a section that overlaps by `depth` [rad], scaled to the whole face.
    pub(super) fn respond(&self, depth: f64, rate: f64) -> Force {
        let d = self.cone * depth;
        let elastic = self.elastic.force(d, 0.0);
        self.damping.apply(elastic.elastic, elastic.by_depth, d, self.cone * rate)
    }

    /// Forces and heat of the mesh `state.which` of planet and side.
    pub fn force(&self, state: &MeshState) -> MeshForce {
        let mut sum = MeshForce::default();
        let [dq, dx] = state.rate;
        self.sections::<1>(&self.slices, state.which, state.position, |_, PlacedSlice { slice, .. }, p| {
            if p.v > 0.0 {
                let rate = p.d[0] * dq + p.d[1] * dx;
                let force = self.respond(p.v, rate);
                let torque = slice.share * self.cone * force.total;
                sum.force[0] -= torque * p.d[0];
                sum.force[1] -= torque * p.d[1];
                sum.heat += slice.share * (force.total - force.elastic) * self.cone * rate;
            }
        });
        sum
    }

    /// Forces and heat, with their exact derivatives.
    pub fn linearise(&self, state: &MeshState) -> (MeshForce, MeshJacobian) {
        let (mut sum, mut by) = (MeshForce::default(), MeshJacobian::default());
        let [dq, dx] = state.rate;
        self.sections::<2>(&self.slices, state.which, state.position, |_, PlacedSlice { slice, .. }, p| {
            if p.v <= 0.0 {
                return;
            }
            let rate = p.d[0] * dq + p.d[1] * dx;
            let f = self.respond(p.v, rate);
            let r = self.cone;
            let torque = slice.share * r * f.total;
            by.energy += slice.share * self.elastic.energy(r * p.v);
            sum.heat += slice.share * (f.total - f.elastic) * r * rate;
            let hessian = [[p.dd[0], p.dd[1]], [p.dd[1], p.dd[2]]];
            for b in 0..2 {
                sum.force[b] -= torque * p.d[b];
                let along = f.by_depth * p.d[b] + f.by_rate * (hessian[b][0] * dq + hessian[b][1] * dx);
                for a in 0..2 {
                    by.by_position[a][b] -= slice.share * r * (r * along * p.d[a] + f.total * hessian[a][b]);
                    by.by_rate[a][b] -= slice.share * r * r * f.by_rate * p.d[a] * p.d[b];
                }
            }
        });
        (sum, by)
    }

    /// Elastic energy V [J] of the mesh `which` at position (q, x).
    pub fn energy(&self, which: [usize; 2], position: [f64; 2]) -> f64 {
        let mut energy = 0.0;
        self.sections::<0>(&self.slices, which, position, |_, PlacedSlice { slice, .. }, p| {
            if p.v > 0.0 {
                energy += slice.share * self.elastic.energy(self.cone * p.v);
            }
        });
        energy
    }
}

/// A pair of flanks near each other, mirrored if necessary so that it is a drive flank.
pub(super) struct FlankPair {
    pub(super) flank: Flank,
    /// Index of its placement.
    placed: usize,
    pub(super) number: i64,
    pub(super) s: f64,
    angles: [SineCosine; 2],
    /// Fractional indices of the closest rays.
    start: [f64; 2],
}
