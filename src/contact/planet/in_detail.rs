//! Planet contact summed over the face, for flanks that do not fit, that rub, or that press their gears' seats. The
//! gear bodies are rigid or elastic.

use super::{Contact, PlanetContact, PlanetState, Visit, Visitor, first};
use crate::contact::bodies::PairCouplings;
use crate::contact::detailed::{
    DetailedLoad, DetailedState, KnownSlice, LOCAL, MeshTeeth, Opening, SharedTeeth, SliceLoad, WITH_OTHER,
};
use crate::contact::errors::{MeshId, PairId};
use crate::contact::{Flank, FlankGaps, ToothLoad};
use crate::geometry::Pair;
use crate::numeric::{Dual, cos, sin};

/// A planet with rigid gear bodies.
#[derive(Clone, Copy)]
pub struct InDetail<'a> {
    /// Constants.
    pub contact: &'a Contact,
    /// Present gaps of the teeth.
    pub gaps: Option<&'a FlankGaps>,
    /// Viscosity of the oil [Pa·s], if friction depends on the oil.
    pub viscosity: Option<f64>,
}

/// A planet with elastic gear bodies.
#[derive(Clone, Copy)]
pub struct InDetailOnBodies<'a> {
    /// The teeth, as with rigid bodies.
    pub teeth: InDetail<'a>,
    /// Couplings through the bodies.
    pub bodies: &'a PairCouplings,
}

impl<'a> InDetail<'a> {
    /// Teeth of the mesh of planet `planet` with side gear `side`.
    #[inline(always)]
    fn mesh_teeth(&self, planet: usize, side: usize) -> MeshTeeth<'a> {
        MeshTeeth {
            engagement: &self.contact.mesh.engagement,
            gaps: self.gaps,
            viscosity: self.viscosity,
            planet,
            side,
        }
    }

    /// Fraction of a step of `h` [s] at which the force of the mesh of side `s` has its first kink, or `None`. `moved`
    /// returns the arc by which other pairs open a pair [rad].
    #[inline(never)]
    fn kink_of(
        &self,
        (at, s): (&PlanetState, usize),
        h: f64,
        moved: Option<&dyn Fn(Flank, i64) -> f64>,
    ) -> Option<f64> {
        let (mesh, detailed) = (&self.contact.mesh, &self.contact.detailed);
        let moved_by = |flank: Flank, number: i64| moved.map_or(0.0, |moved| moved(flank, number));
        if self.gaps.is_some() {
            let (teeth, state) = (self.mesh_teeth(at.planet, s), at.detailed(s));
            return mesh.kink_of_open(&at.mesh(s), h, |flank, number, s| {
                detailed.opened(&teeth, &state, (flank, number, s), mesh.whole.cone) + moved_by(flank, number)
            });
        }
        if moved.is_some() {
            return mesh.kink_of_open(&at.mesh(s), h, |flank, number, _| moved_by(flank, number));
        }
        mesh.kink(&at.mesh(s), h)
    }

    /// Converts a slice of a pair into a tooth load.
    fn load(&self, at: &PlanetState, slice: &SliceLoad) -> ToothLoad {
        let (side, flank) = (slice.name.side, slice.pair.flank);
        ToothLoad {
            planet: at.planet,
            side,
            flank,
            spot: slice.spot,
            spot_arc: slice.spot_arc,
            teeth: self.contact.perfect.teeth(slice.name),
            s: slice.s,
            cone: slice.cone,
            share: slice.share,
            line_load: slice.line_load,
            depth: slice.arc * slice.cone,
            normal: slice.normal,
            friction: slice.friction,
            components: slice.components,
            touch: None,
        }
    }

    fn face_load_factor_at(&self, at: &PlanetState, slice: &ToothLoad, pair: &Pair) -> f64 {
        let detailed = &self.contact.detailed;
        if !detailed.face.is_distributed() {
            return 1.0;
        }
        let mesh = MeshId { planet: slice.planet, side: slice.side };
        let [planet_tooth, side_tooth] = slice.teeth;
        let teeth = PairId { planet_tooth, side_tooth, flank: slice.flank };
        let mut opening = self.gaps.map_or(Opening::NONE, |gaps| gaps.of(mesh, teeth, slice.s));
        if detailed.has_seats {
            let axial = cos(pair.gears[1].base) * sin(pair.pitch_arc[1] - slice.s);
            opening.even.v += at.position[slice.side][super::W] * axial;
        }
        let known = KnownSlice { cone: slice.cone, arc: slice.depth / slice.cone, s: slice.s };
        detailed.face_load_factor(&known, &opening)
    }
}

impl PlanetContact for InDetail<'_> {
    type Load = DetailedLoad<f64>;
    type Linearised = DetailedLoad<Dual<LOCAL>>;

    #[inline(always)]
    fn write(&self, at: &PlanetState, to: &mut [DetailedLoad<f64>; 2]) {
        for s in 0..2 {
            to[s] = self.contact.detailed.load(&self.mesh_teeth(at.planet, s), &at.detailed(s));
        }
    }

    #[inline(always)]
    fn linearise(&self, at: &PlanetState, to: &mut [DetailedLoad<Dual<LOCAL>>; 2]) {
        for s in 0..2 {
            to[s] = self.contact.detailed.linearise(&self.mesh_teeth(at.planet, s), &at.detailed(s));
        }
    }

    fn energy(&self, at: &PlanetState) -> f64 {
        let of = |s: usize| self.contact.detailed.energy(&self.mesh_teeth(at.planet, s), &at.detailed(s));
        of(0) + of(1)
    }

    fn energy_gained(&self, from: &PlanetState, to: &PlanetState) -> f64 {
        let of =
            |at: &PlanetState, s: usize| self.contact.detailed.energy(&self.mesh_teeth(at.planet, s), &at.detailed(s));
        let gained = |s: usize| of(to, s) - of(from, s);
        gained(0) + gained(1)
    }

    #[inline(never)]
    fn kink(&self, at: &PlanetState, h: f64) -> Option<f64> {
        first(self.kink_of((at, 0), h, None), self.kink_of((at, 1), h, None))
    }

    fn visit(&self, at: &PlanetState, visit: &Visit, see: &mut Visitor) {
        for s in visit.sides.clone() {
            let mut look = |slice: &SliceLoad| see(&self.load(at, slice), Some(slice));
            self.contact.detailed.look(&self.mesh_teeth(at.planet, s), &at.detailed(s), &mut look);
        }
    }

    fn face_load_factor(&self, at: &PlanetState, slice: &ToothLoad, pair: &Pair) -> f64 {
        self.face_load_factor_at(at, slice, pair)
    }
}

impl InDetailOnBodies<'_> {
    #[inline(always)]
    fn shared_teeth(&self, planet: usize) -> SharedTeeth<'_> {
        let opposite = self.teeth.contact.perfect.opposite(planet);
        SharedTeeth { teeth: [0, 1].map(|s| self.teeth.mesh_teeth(planet, s)), bodies: self.bodies, opposite }
    }
}

/// States of both meshes.
#[inline(always)]
fn states(at: &PlanetState) -> [DetailedState; 2] {
    [at.detailed(0), at.detailed(1)]
}

impl PlanetContact for InDetailOnBodies<'_> {
    type Load = DetailedLoad<f64>;
    type Linearised = DetailedLoad<Dual<WITH_OTHER>>;

    #[inline(always)]
    fn write(&self, at: &PlanetState, to: &mut [DetailedLoad<f64>; 2]) {
        *to = self.teeth.contact.detailed.load_shared(&self.shared_teeth(at.planet), &states(at));
    }

    #[inline(always)]
    fn linearise(&self, at: &PlanetState, to: &mut [DetailedLoad<Dual<WITH_OTHER>>; 2]) {
        *to = self.teeth.contact.detailed.linearise_shared(&self.shared_teeth(at.planet), &states(at));
    }

    fn energy(&self, at: &PlanetState) -> f64 {
        self.teeth.contact.detailed.energy_shared(&self.shared_teeth(at.planet), &states(at))
    }

    #[inline(never)]
    fn kink(&self, at: &PlanetState, h: f64) -> Option<f64> {
        let openings = self.teeth.contact.detailed.opening_by_others(&self.shared_teeth(at.planet), &states(at));
        let kink = |s: usize| self.teeth.kink_of((at, s), h, Some(&|flank, number| openings.of(s, flank, number)));
        first(kink(0), kink(1))
    }

    fn visit(&self, at: &PlanetState, visit: &Visit, see: &mut Visitor) {
        let mut look = |slice: &SliceLoad| {
            if visit.sides.contains(&slice.name.side) {
                see(&self.teeth.load(at, slice), Some(slice));
            }
        };
        self.teeth.contact.detailed.look_shared(&self.shared_teeth(at.planet), &states(at), &mut look);
    }

    fn face_load_factor(&self, at: &PlanetState, slice: &ToothLoad, pair: &Pair) -> f64 {
        self.teeth.face_load_factor_at(at, slice, pair)
    }
}
