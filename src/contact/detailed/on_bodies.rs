//! Pairs of both meshes of a planet whose gears have elastic bodies (`contact::shared`).
//!
//! Bodies move a tooth as a whole, so the own arc of a pair replaces the pair's arc in every slice. The load that acts
//! on other pairs is computed from the elastic torque over the face, ω = M/J.

use super::face::PointStorage;
use super::opening::Opened;
use super::planet::Meshes;
use super::sums::{Approach, Sums};
use super::touching::NearPair;
use super::{Detailed, PairName};
use crate::contact::bodies::LoadedPair;
use crate::contact::shared::{COORDINATES, Change, OpeningByOthers, Pairs, Sharing};
use crate::contact::{Damping, Flank, Spring, ToothPair};

/// A pair that may touch.
struct Near<P> {
    name: PairName,
    pair: ToothPair,
    /// `None` if the flanks fit.
    opened: Option<Opened>,
    local: P,
}

impl<P> Near<P> {
    #[inline(always)]
    fn opened(&self) -> &Opened {
        self.opened.as_ref().unwrap_or(&Opened::NONE)
    }
}

/// Elastic load ω = M/J of a face at an own arc [N/m²], with its derivatives with respect to arc, opening E and
/// position s.
#[derive(Clone, Copy, Default)]
struct ElasticLoad {
    load: f64,
    by_arc: f64,
    by_opening: f64,
    by_s: f64,
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
            return ElasticLoad { load, by_arc, by_opening: 0.0, by_s };
        }
        let (opening, mut sums) = (&near.opened().opening, Sums::default());
        let still = Approach { arc, rate: 0.0, opening_rate: 0.0 };
        for part in self.face.loaded(arc, opening, &mut PointStorage::default()) {
            sums.add::<S, true, true>(&part, (spring, &near.local, &Damping::NONE), &still, opening, None, |_| {});
        }
        let [by_arc, by_opening, by_s, ..] = sums.by[0].map(|by| by / self.moment);
        ElasticLoad { load: sums.torque / self.moment, by_arc, by_opening, by_s }
    }

    /// Gathers the pairs of both meshes that are pressed, that others may pull into contact, or that are within
    /// `lookout` times the deepest approach of touching. Pairs are written in place, because they are large.
    fn gather<S: Spring, const OPEN: bool>(
        &self,
        spring: &S,
        meshes: &Meshes,
        lookout: f64,
        pairs: &mut Pairs<Near<S::Local>>,
    ) {
        let Some(bodies) = meshes.bodies else { return };
        // approaches of drive and coast flanks; excess material presses before flanks without errors would touch
        let (mut slack, mut depth, mut deepest) = ([0.0; 2], [[0.0; 2]; 2], 0.0f64);
        for side in 0..2 {
            let (teeth, state) = (&meshes.teeth[side], &meshes.states[side]);
            slack[side] = self.slack(teeth, state);
            for (flank, q) in [-state.position[0], state.position[0]].into_iter().enumerate() {
                depth[side][flank] = q - teeth.engagement.half_backlash() + slack[side];
                deepest = deepest.max(depth[side][flank]);
            }
        }
        let margins = bodies.pull.margins(&depth);
        for side in 0..2 {
            let (teeth, state) = (&meshes.teeth[side], &meshes.states[side]);
            let margin = [0, 1].map(|flank| margins[side][flank] + lookout * deepest);
            self.each(teeth, state, [slack[side] + margin[0], slack[side] + margin[1]], |name, pair| {
                let arc = pair.depth + margin[usize::from(pair.flank == Flank::Coast)];
                let opened = OPEN.then(|| self.opened_pair(teeth, name, pair.s, state.position[2]));
                let may_touch = opened.as_ref().map_or(arc > 0.0, |opened| self.face.is_loaded(arc, &opened.opening));
                if may_touch {
                    pairs.add(pair.depth, || Near { name: *name, pair: *pair, opened, local: spring.local(pair.s) });
                }
            });
        }
    }

    /// Calls `see` with each pair that may touch and its share of the load. [`Self::gather`] describes `lookout`. If
    /// `with_slopes`, the share includes its slopes.
    #[inline(always)]
    pub(super) fn share<S: Spring, const OPEN: bool>(
        &self,
        spring: &S,
        meshes: &Meshes,
        (lookout, with_slopes): (f64, bool),
        mut see: impl FnMut(&NearPair<S::Local>),
    ) {
        let Some(bodies) = meshes.bodies else { return };
        let mut pairs = Pairs::none();
        self.gather::<S, OPEN>(spring, meshes, lookout, &mut pairs);
        let near_of = |k: usize| pairs.get(k);
        // flanks pressed by excess material are loaded even at negative arcs, so the law is evaluated at every arc
        let law = |k: usize, arc: f64| {
            near_of(k).map_or([0.0; 2], |near| {
                let ElasticLoad { load, by_arc, .. } = self.elastic_load::<S, OPEN>(spring, near, arc);
                [load, by_arc]
            })
        };
        let changes = |k: usize, own: f64| {
            let (mut by, mut change) = ([0.0; COORDINATES], Change::default());
            if let Some(near) = near_of(k) {
                let (at, pair) = (3 * near.name.side, &near.pair);
                (by[at], by[at + 1]) = (pair.slope[0], pair.slope[1]);
                let ElasticLoad { by_opening, by_s, .. } = self.elastic_load::<S, OPEN>(spring, near, own);
                let Opened { opening, axial, .. } = near.opened();
                change.position = (at + 1, pair.s_slope, (by_s + by_opening * opening.even.d) * pair.s_slope);
                change.opening = (at + 2, by_opening * axial[0]);
            }
            (by, change)
        };
        let loaded_pair = |k: usize| {
            let Near { name, pair, .. } = near_of(k)?;
            let tooth = if name.side == 0 { name.tooth } else { meshes.opposite.wrapping_sub(name.tooth) };
            Some(LoadedPair { side: name.side, flank: pair.flank, number: pair.number, tooth, s: pair.s })
        };
        let is_linear = spring.is_linear() && !OPEN;
        let sharing = Sharing { bodies, arcs: pairs.arcs(), loaded_pair: &loaded_pair, law: &law, is_linear };
        sharing.solve(if with_slopes { Some(&changes) } else { None }, &mut |shares| {
            for (k, share) in shares.iter().enumerate() {
                if let Some(near) = near_of(k) {
                    let opened = if OPEN { near.opened() } else { &Opened::NONE };
                    see(&NearPair { name: &near.name, pair: &near.pair, opened, local: Some(near.local), share });
                }
            }
        });
    }

    /// Displacements that other pairs cause at pairs that touch or are about to touch.
    pub fn opening_by_others(&self, meshes: &Meshes) -> OpeningByOthers {
        let mut opening_by_others = OpeningByOthers::default();
        let add = |NearPair { name, pair, share, .. }: &NearPair<_>| {
            opening_by_others.add(name.side, pair.flank, pair.number, pair.depth - share.own);
        };
        let lookout = (OpeningByOthers::LOOKOUT, false);
        if self.is_open(&meshes.teeth[0]) {
            self.share::<_, true>(&self.spring, meshes, lookout, add);
        } else {
            self.share::<_, false>(&self.spring, meshes, lookout, add);
        }
        opening_by_others
    }
}
