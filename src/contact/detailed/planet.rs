//! Loads of both meshes of a planet, summed over their tooth pairs. Gear bodies are rigid or elastic.

use std::ops::Range;

use super::face::{Part, PointStorage};
use super::opening::Opened;
use super::totals::SUMS;
use super::touching::{NearPair, Touching};
use super::{Detailed, DetailedLoad, DetailedState, MeshTeeth, PairMotion, SliceLoad, Totals, WITH_OTHER};
use crate::contact::bodies::PairCouplings;
use crate::contact::shared::Share;
use crate::contact::spring::with_spring;
use crate::contact::{AnySpring, Spring};
use crate::numeric::Dual;

/// Both meshes of a planet.
#[derive(Clone, Copy)]
pub struct Meshes<'a> {
    /// Teeth, left and right.
    pub teeth: [MeshTeeth<'a>; 2],
    /// States of the meshes.
    pub states: [DetailedState; 2],
    /// Couplings through the bodies, if these are elastic.
    pub bodies: Option<&'a PairCouplings>,
    /// Number of the planet tooth whose position in the right mesh corresponds to the position of tooth 0 in the left
    /// mesh.
    pub opposite: i64,
}

/// Loads with derivatives with respect to `WIDE` variables: those of one mesh on rigid bodies, or those of both meshes
/// on elastic bodies.
impl Detailed {
    /// Writes the loads of both meshes.
    pub fn write<const WIDE: usize>(&self, meshes: &Meshes, to: &mut [DetailedLoad<f64>; 2]) {
        let totals = self.totals::<0, WIDE>(meshes);
        for s in 0..2 {
            to[s] = totals[s].load();
        }
    }

    /// Writes the loads of both meshes with their exact derivatives.
    pub fn linearise<const WIDE: usize>(&self, meshes: &Meshes, to: &mut [DetailedLoad<Dual<WIDE>>; 2]) {
        let totals = self.totals::<SUMS, WIDE>(meshes);
        for s in 0..2 {
            to[s] = totals[s].linearised();
        }
    }

    /// Calls `look` with each loaded slice of the meshes of `sides`. It is compiled once for all laws and callers.
    pub fn look<const WIDE: usize>(&self, meshes: &Meshes, sides: Range<usize>, look: &mut dyn FnMut(&SliceLoad)) {
        let mut totals = [Totals::<0, WIDE>::default(); 2];
        self.sum(&self.spring, &mut totals, meshes, (sides.clone(), true), |slice| {
            if sides.contains(&slice.name.side) {
                look(slice);
            }
        });
    }

    /// Elastic energies of both meshes [J].
    pub fn energies<const WIDE: usize>(&self, meshes: &Meshes) -> [f64; 2] {
        let mut energies = [0.0; 2];
        let add = |near: &NearPair<_>| self.add_energy(&mut energies[near.name.side], near);
        if self.is_open(&meshes.teeth[0]) {
            self.each_near::<_, WIDE, true>(&self.spring, meshes, (0..2, false), add);
        } else {
            self.each_near::<_, WIDE, false>(&self.spring, meshes, (0..2, false), add);
        }
        energies
    }

    /// Adds the energy of a pair, and its half of the energy of its couplings with other pairs.
    fn add_energy(&self, energy: &mut f64, near: &NearPair<<AnySpring as Spring>::Local>) {
        let (share, opening) = (near.share, &near.opened.opening);
        let mut storage = PointStorage::default();
        let parts = self.face.loaded(share.own, opening, &mut storage);
        if parts.iter().all(Part::is_empty) {
            return;
        }
        let local = near.local.unwrap_or_else(|| self.spring.local(near.pair.s));
        for part in parts {
            for node in part.nodes {
                let arc = share.own - opening.turn - part.even * node.per_cone - opening.bend * node.cone;
                if arc > 0.0 {
                    *energy += node.weight * self.spring.respond(&local, arc).energy;
                }
            }
        }
        *energy += self.coupling_energy(near);
    }

    /// Half of the energy of the couplings of a pair with other pairs [J].
    #[inline(always)]
    fn coupling_energy<P>(&self, NearPair { pair, share, .. }: &NearPair<P>) -> f64 {
        0.5 * self.moment * share.load * (pair.depth - share.own)
    }

    #[inline(always)]
    fn totals<const ROWS: usize, const WIDE: usize>(&self, meshes: &Meshes) -> [Totals<ROWS, WIDE>; 2] {
        let mut totals = [Totals::default(); 2];
        with_spring!(&self.spring, spring => self.sum(spring, &mut totals, meshes, (0..2, self.needs_thrust), |_| {}));
        totals
    }

    /// Adds the loads of all pairs of the meshes of `sides`.
    #[inline(always)]
    fn sum<S: Spring, const ROWS: usize, const WIDE: usize>(
        &self,
        spring: &S,
        totals: &mut [Totals<ROWS, WIDE>; 2],
        meshes: &Meshes,
        (sides, needs_thrust): (Range<usize>, bool),
        mut look: impl FnMut(&SliceLoad),
    ) {
        if self.is_open(&meshes.teeth[0]) {
            self.each_near::<S, WIDE, true>(spring, meshes, (sides, ROWS > 0), |near| {
                self.add::<S, ROWS, WIDE, true>((spring, meshes, needs_thrust), totals, near, &mut look)
            });
        } else {
            self.each_near::<S, WIDE, false>(spring, meshes, (sides, ROWS > 0), |near| {
                self.add::<S, ROWS, WIDE, false>((spring, meshes, needs_thrust), totals, near, &mut look)
            });
        }
    }

    /// Calls `see` with each pair of the meshes of `sides` that may touch. On elastic bodies, it visits the pairs of
    /// both meshes, and shares include slopes if `with_slopes`.
    #[inline(always)]
    fn each_near<S: Spring, const WIDE: usize, const OPEN: bool>(
        &self,
        spring: &S,
        meshes: &Meshes,
        (sides, with_slopes): (Range<usize>, bool),
        mut see: impl FnMut(&NearPair<S::Local>),
    ) {
        if WIDE == WITH_OTHER {
            return self.share::<S, OPEN>(spring, meshes, (0.0, with_slopes), see);
        }
        for side in sides {
            let (teeth, state) = (&meshes.teeth[side], &meshes.states[side]);
            self.each(teeth, state, [self.slack(teeth, state); 2], |name, pair| {
                let opened = if OPEN { self.opened_pair(teeth, name, pair.s, state.position[2]) } else { Opened::NONE };
                see(&NearPair { name, pair, opened: &opened, local: None, share: &Share::alone(pair.depth) });
            });
        }
    }

    /// Adds the loads of a pair.
    #[inline(always)]
    fn add<S: Spring, const ROWS: usize, const WIDE: usize, const OPEN: bool>(
        &self,
        (spring, meshes, needs_thrust): (&S, &Meshes, bool),
        totals: &mut [Totals<ROWS, WIDE>; 2],
        near: &NearPair<S::Local>,
        look: impl FnMut(&SliceLoad),
    ) {
        let NearPair { name, pair, opened, share, .. } = near;
        let (side, mut storage) = (name.side, PointStorage::default());
        let parts = self.loaded_parts::<OPEN>(share.own, &opened.opening, &mut storage);
        // most nearby pairs do not touch
        if parts.iter().all(Part::is_empty) {
            return;
        }
        let mut motion = PairMotion::<OPEN>::new(pair, share.own, opened, &meshes.states[side]);
        if WIDE == WITH_OTHER {
            let mut along_by = [[0.0; 3]; 2];
            if let Some(slopes) = share.slopes {
                let [own, along] =
                    slopes.map(|by| [side, 1 - side].map(|side| [by[3 * side], by[3 * side + 1], by[3 * side + 2]]));
                motion.own = own;
                along_by = along.map(|by| by.map(|by| self.moment * pair.s_slope * by));
            }
            let force = self.moment * pair.s_slope * share.load * share.along;
            totals[side].add_moving(force, along_by, self.coupling_energy(near));
        }
        let touching = Touching { near, parts, motion };
        self.add_touching((spring, &meshes.teeth[side], needs_thrust), &mut totals[side], touching, look);
    }
}
