//! Both meshes of a planet whose gears have elastic bodies (`contact::shared`).
//!
//! Bodies move a tooth as a whole, so the own arc of a pair replaces the pair's arc in every slice. The load that acts
//! on other pairs is computed from the elastic torque over the face, ω = M/J.

use super::super::bodies::{LoadedPair, PairCouplings};
use super::super::shared::{COORDINATES, Change, OpeningByOthers, Pairs, Share, Sharing};
use super::directions::Arcs;
use super::face::{Part, PointStorage};
use super::loads::Look;
use super::sums::{Approach, Sums};
use super::totals::SUMS;
use super::touching::Touching;
use super::{
    Detailed, DetailedLoad, DetailedState, MeshTeeth, Opening, PairMotion, PairName, SliceLoad, Totals, WITH_OTHER,
};
use crate::contact::spring::with_teeth;
use crate::contact::{Damping, Flank, Spring, ToothPair};
use crate::numeric::Dual;

/// Teeth of both meshes of a planet on shared elastic bodies.
#[derive(Clone, Copy)]
pub struct SharedTeeth<'a> {
    /// Teeth, left and right.
    pub teeth: [MeshTeeth<'a>; 2],
    /// Couplings through the bodies.
    pub bodies: &'a PairCouplings,
    /// Number of the planet tooth whose position in the right mesh corresponds to the position of tooth 0 in the left
    /// mesh.
    pub opposite: i64,
}

/// A pair that may touch.
#[derive(Clone)]
struct Near<P> {
    name: PairName,
    pair: ToothPair,
    opening: Opening,
    axial: [f64; 2],
    arcs: Arcs,
    loaded: LoadedPair,
    local: P,
}

/// Callback for each pair, with the approach of its flanks [rad] and its share of the load.
type See<'a, P> = dyn FnMut(&Near<P>, f64, &Share) + 'a;

/// Elastic load ω = M/J of a face at an own arc [N/m²], with its derivatives with respect to arc, opening E and
/// position s, and the energy divided by J.
#[derive(Clone, Copy, Default)]
struct ElasticLoad {
    load: f64,
    by_arc: f64,
    by_opening: f64,
    by_s: f64,
    energy: f64,
}

impl Detailed {
    /// Elastic load of a pair at its own arc `arc` [rad].
    #[inline(always)]
    fn elastic_load<S: Spring, const OPEN: bool>(&self, spring: &S, near: &Near<S::Local>, arc: f64) -> ElasticLoad {
        if !OPEN {
            // one point represents the load of a face whose flanks fit
            if arc <= 0.0 {
                return ElasticLoad::default();
            }
            let elastic = spring.respond(&near.local, arc);
            let (load, by_arc, by_s) = (elastic.torque, elastic.stiffness, elastic.torque_by_s);
            return ElasticLoad { load, by_arc, by_opening: 0.0, by_s, energy: elastic.energy };
        }
        let (opening, mut sums) = (&near.opening, Sums::default());
        let still = Approach { arc, rate: 0.0, opening_rate: 0.0 };
        for part in self.face.loaded(arc, opening, &mut PointStorage::default()) {
            sums.add::<S, true, true>(&part, (spring, &near.local, &Damping::NONE), &still, opening, None, |_| {});
        }
        let [by_arc, by_opening, by_s, ..] = sums.by[0].map(|by| by / self.moment);
        let (load, energy) = (sums.torque / self.moment, sums.energy / self.moment);
        ElasticLoad { load, by_arc, by_opening, by_s, energy }
    }

    /// Load and its slope with respect to the arc, for the iterations that solve for the own arcs.
    #[inline(never)]
    fn load_of<S: Spring, const OPEN: bool>(&self, spring: &S, near: &Near<S::Local>, arc: f64) -> [f64; 2] {
        let ElasticLoad { load, by_arc, .. } = self.elastic_load::<S, OPEN>(spring, near, arc);
        [load, by_arc]
    }

    /// Gathers the pairs of both meshes that are pressed, that others may pull into contact, or that are within
    /// `lookout` times the deepest approach of touching. Pairs are written in place, because they are large.
    fn gather<S: Spring, const OPEN: bool>(
        &self,
        spring: &S,
        shared: &SharedTeeth,
        states: &[DetailedState; 2],
        lookout: f64,
        pairs: &mut Pairs<Near<S::Local>>,
    ) {
        // excess material presses before flanks without errors would touch
        let excess = [0, 1].map(|side| {
            let gaps = shared.teeth[side].gaps.map_or(0.0, |gaps| -gaps.least);
            (gaps + (-states[side].position[2]).max(0.0)) / self.face.inner()
        });
        let depth = [0, 1].map(|side| {
            let q = states[side].position[0];
            [-q, q].map(|q| q - shared.teeth[side].engagement.half_backlash() + excess[side])
        });
        let deepest = depth.as_flattened().iter().fold(0.0f64, |deepest, depth| deepest.max(*depth));
        for side in 0..2 {
            let (teeth, state) = (&shared.teeth[side], &states[side]);
            let margin = [0, 1].map(|flank| shared.bodies.pull.margin(&depth, side, flank) + lookout * deepest);
            self.each(teeth, state, margin, |name, pair| {
                let margin = margin[usize::from(pair.flank == Flank::Coast)];
                let (mut opening, mut axial, mut arcs) = (Opening::NONE, [0.0; 2], Arcs::NONE);
                let is_clear = if OPEN {
                    (opening, axial, arcs) = self.opened_pair(teeth, name, pair.s, state.position[2]);
                    !self.face.is_loaded(pair.depth + margin, &opening)
                } else {
                    pair.depth + margin <= 0.0
                };
                if is_clear {
                    return;
                }
                pairs.add(pair.depth, || {
                    let tooth = if side == 0 { name.tooth } else { shared.opposite.wrapping_sub(name.tooth) };
                    let loaded = LoadedPair { side, flank: pair.flank, number: pair.number, tooth, s: pair.s };
                    let local = spring.local(pair.s);
                    Near { name: *name, pair: *pair, opening, axial, arcs, loaded, local }
                });
            });
        }
    }

    /// Calls `see` with each pair that may touch, the approach of its flanks and its share of the load. With `SLOPES`,
    /// the share includes its slopes.
    fn share<S: Spring, const OPEN: bool, const SLOPES: bool>(
        &self,
        spring: &S,
        shared: &SharedTeeth,
        states: &[DetailedState; 2],
        lookout: f64,
        see: &mut See<S::Local>,
    ) {
        let mut pairs = Pairs::none();
        self.gather::<S, OPEN>(spring, shared, states, lookout, &mut pairs);
        let near_of = |k: usize| pairs.get(k);
        // flanks pressed by excess material are loaded even at negative arcs, so the law is evaluated at every arc
        let law = |k: usize, arc: f64| near_of(k).map_or([0.0; 2], |near| self.load_of::<S, OPEN>(spring, near, arc));
        let changes = |k: usize, own: f64| {
            let (mut by, mut change) = ([0.0; COORDINATES], Change::default());
            if let Some(near) = near_of(k) {
                let (at, pair) = (3 * near.loaded.side, &near.pair);
                (by[at], by[at + 1]) = (pair.slope[0], pair.slope[1]);
                let elastic_load = self.elastic_load::<S, OPEN>(spring, near, own);
                let by_s = elastic_load.by_s + elastic_load.by_opening * near.opening.even.d;
                change.position = (at + 1, pair.s_slope, by_s * pair.s_slope);
                change.opening = (at + 2, elastic_load.by_opening * near.axial[0]);
            }
            (by, change)
        };
        let loaded_pair = |k: usize| near_of(k).map(|near| &near.loaded);
        let arcs = pairs.arcs();
        let sharing = Sharing {
            bodies: shared.bodies,
            arcs,
            loaded_pair: &loaded_pair,
            law: &law,
            is_linear: S::LINEAR && !OPEN,
        };
        sharing.solve(if SLOPES { Some(&changes) } else { None }, &mut |k, share| {
            if let Some(near) = near_of(k) {
                see(near, pairs.arcs()[k], share);
            }
        });
    }

    /// Calls [`Self::share`] without slopes. Selects the variant for flanks that may open or the variant for flanks
    /// that fit.
    #[inline(never)]
    fn share_at<S: Spring>(
        &self,
        spring: &S,
        shared: &SharedTeeth,
        states: &[DetailedState; 2],
        lookout: f64,
        see: &mut See<S::Local>,
    ) {
        if self.may_open(shared) {
            self.share::<S, true, false>(spring, shared, states, lookout, see);
        } else {
            self.share::<S, false, false>(spring, shared, states, lookout, see);
        }
    }

    fn may_open(&self, shared: &SharedTeeth) -> bool {
        self.is_open(&shared.teeth[0])
    }

    /// Loads of both meshes of a planet.
    pub fn load_shared(&self, shared: &SharedTeeth, states: &[DetailedState; 2]) -> [DetailedLoad<f64>; 2] {
        self.load_and_look_shared(shared, states, self.needs_thrust, None)
    }

    fn load_and_look_shared(
        &self,
        shared: &SharedTeeth,
        states: &[DetailedState; 2],
        needs_thrust: bool,
        look: Look,
    ) -> [DetailedLoad<f64>; 2] {
        let mut totals = [Totals::<0, WITH_OTHER>::default(); 2];
        with_teeth!(&self.spring, spring => if self.may_open(shared) {
            self.sum_shared::<_, 0, true, false>(spring, &mut totals, shared, states, needs_thrust, look);
        } else {
            self.sum_shared::<_, 0, false, false>(spring, &mut totals, shared, states, needs_thrust, look);
        }, ());
        totals.map(|totals| totals.load())
    }

    /// Loads of both meshes with their exact derivatives. Variables are q, x, w of the mesh, their rates, and q, x, w
    /// of the planet's other mesh.
    pub fn linearise_shared(
        &self,
        shared: &SharedTeeth,
        states: &[DetailedState; 2],
    ) -> [DetailedLoad<Dual<WITH_OTHER>>; 2] {
        let mut totals = [Totals::<SUMS, WITH_OTHER>::default(); 2];
        with_teeth!(&self.spring, spring => if self.may_open(shared) {
            self.sum_shared::<_, SUMS, true, true>(spring, &mut totals, shared, states, self.needs_thrust, None);
        } else {
            self.sum_shared::<_, SUMS, false, true>(spring, &mut totals, shared, states, self.needs_thrust, None);
        }, ());
        totals.map(|totals| totals.linearised())
    }

    /// Loads of both meshes; calls `look` with each loaded slice.
    pub fn look_shared(
        &self,
        shared: &SharedTeeth,
        states: &[DetailedState; 2],
        look: &mut dyn FnMut(&SliceLoad),
    ) -> [DetailedLoad<f64>; 2] {
        self.load_and_look_shared(shared, states, true, Some(look))
    }

    /// Elastic energy of both meshes [J].
    pub fn energy_shared(&self, shared: &SharedTeeth, states: &[DetailedState; 2]) -> f64 {
        let mut sum = 0.0;
        with_teeth!(&self.spring, spring => self.share_at(spring, shared, states, 0.0, &mut |near, arc, share| {
            let alone = if self.may_open(shared) {
                self.elastic_load::<_, true>(spring, near, share.own)
            } else {
                self.elastic_load::<_, false>(spring, near, share.own)
            };
            sum += self.moment * (alone.energy + 0.5 * share.load * (arc - share.own));
        }), ());
        sum
    }

    /// Displacements that other pairs cause at pairs that touch or are about to touch.
    pub fn opening_by_others(&self, shared: &SharedTeeth, states: &[DetailedState; 2]) -> OpeningByOthers {
        let mut opening_by_others = OpeningByOthers::default();
        let lookout = OpeningByOthers::LOOKOUT;
        with_teeth!(&self.spring, spring => self.share_at(spring, shared, states, lookout, &mut |near, arc, share| {
            opening_by_others.add(near.loaded.side, near.pair.flank, near.pair.number, arc - share.own);
        }), ());
        opening_by_others
    }

    /// Adds the loads of all pairs.
    #[inline(always)]
    fn sum_shared<S: Spring, const ROWS: usize, const OPEN: bool, const SLOPES: bool>(
        &self,
        spring: &S,
        totals: &mut [Totals<ROWS, WITH_OTHER>; 2],
        shared: &SharedTeeth,
        states: &[DetailedState; 2],
        needs_thrust: bool,
        mut look: Look,
    ) {
        let mut see = |slice: &SliceLoad| {
            if let Some(look) = &mut look {
                look(slice);
            }
        };
        self.share::<S, OPEN, SLOPES>(spring, shared, states, 0.0, &mut |near, arc, share| {
            let (side, opening) = (near.loaded.side, &near.opening);
            let pair = ToothPair { depth: share.own, ..near.pair };
            let mut storage = PointStorage::default();
            let parts = self.loaded_parts::<OPEN>(pair.depth, opening, &mut storage);
            if parts.iter().all(Part::is_empty) {
                return;
            }
            let (mut motion, mut along_by) =
                (PairMotion::<OPEN, true>::new(&pair, opening, near.axial, &states[side]), [[0.0; 3]; 2]);
            if let Some([own, along]) = share.slopes {
                let of = |by: &[f64; COORDINATES]| {
                    [side, 1 - side].map(|side| [by[3 * side], by[3 * side + 1], by[3 * side + 2]])
                };
                motion.own = of(own);
                along_by = of(along).map(|by| by.map(|by| self.moment * pair.s_slope * by));
            }
            let force = self.moment * pair.s_slope * share.load * share.along;
            let energy = 0.5 * self.moment * share.load * (arc - share.own);
            totals[side].add_moving(force, along_by, energy);
            let touching = Touching {
                name: &near.name,
                pair: &pair,
                local: Some(near.local),
                opening,
                arcs: near.arcs,
                parts,
                motion,
            };
            let teeth = &shared.teeth[side];
            self.add_touching((spring, teeth, needs_thrust), &mut totals[side], touching, &mut see);
        });
    }
}
