//! Planet contact summed over the face, for flanks that do not fit, that rub, or that press their gears' seats, and for
//! all teeth on elastic gear bodies.

use super::{Contact, PlanetContact, PlanetState, Visit, Visitor, first, load::Slopes};
use crate::contact::bodies::PairCouplings;
use crate::contact::detailed::{DetailedLoad, KnownSlice, MeshTeeth, Meshes, Opening, SliceLoad};
use crate::contact::errors::{MeshId, PairId};
use crate::contact::{FlankGaps, ToothLoad};
use crate::geometry::Pair;
use crate::numeric::{Dual, cos, sin};

/// A planet whose loads have derivatives with respect to `WIDE` variables: those of one mesh if the gear bodies are
/// rigid, or of both meshes if they are elastic.
#[derive(Clone, Copy)]
pub struct InDetail<'a, const WIDE: usize> {
    /// Constants.
    pub contact: &'a Contact,
    /// Present gaps of the teeth.
    pub gaps: Option<&'a FlankGaps>,
    /// Viscosity of the oil [Pa·s], if friction depends on the oil.
    pub viscosity: Option<f64>,
    /// Couplings through the bodies, if these are elastic.
    pub bodies: Option<&'a PairCouplings>,
}

impl<'a, const WIDE: usize> InDetail<'a, WIDE> {
    #[inline(always)]
    fn meshes(&self, at: &PlanetState) -> Meshes<'a> {
        let Self { contact, gaps, viscosity, bodies } = *self;
        let teeth = |side| MeshTeeth { engagement: &contact.mesh.engagement, gaps, viscosity, planet: at.planet, side };
        Meshes {
            teeth: [teeth(0), teeth(1)],
            states: [at.detailed(0), at.detailed(1)],
            bodies,
            opposite: if bodies.is_some() { contact.perfect.opposite(at.planet) } else { 0 },
        }
    }

    /// Converts a slice of a pair into a tooth load.
    fn load(&self, at: &PlanetState, slice: &SliceLoad) -> ToothLoad {
        let SliceLoad { name, cone, .. } = *slice;
        ToothLoad {
            planet: at.planet,
            side: name.side,
            flank: name.flank,
            spot: slice.spot,
            spot_arc: slice.spot_arc,
            teeth: self.contact.perfect.teeth(name),
            s: slice.s,
            cone,
            share: slice.share,
            line_load: slice.line_load,
            depth: slice.arc * cone,
            normal: slice.normal,
            friction: slice.friction,
            components: slice.components,
            touch: None,
        }
    }
}

impl<const WIDE: usize> PlanetContact for InDetail<'_, WIDE>
where
    Dual<WIDE>: Slopes,
{
    type Load = DetailedLoad<f64>;
    type Linearised = DetailedLoad<Dual<WIDE>>;

    #[inline(always)]
    fn write(&self, at: &PlanetState, to: &mut [DetailedLoad<f64>; 2]) {
        self.contact.detailed.write::<WIDE>(&self.meshes(at), to);
    }

    #[inline(always)]
    fn linearise(&self, at: &PlanetState, to: &mut [DetailedLoad<Dual<WIDE>>; 2]) {
        self.contact.detailed.linearise(&self.meshes(at), to);
    }

    fn energies(&self, at: &PlanetState) -> [f64; 2] {
        self.contact.detailed.energies::<WIDE>(&self.meshes(at))
    }

    #[inline(never)]
    fn kink(&self, at: &PlanetState, h: f64) -> Option<f64> {
        let (Contact { mesh, detailed, .. }, meshes) = (self.contact, self.meshes(at));
        let others = self.bodies.map(|_| detailed.opening_by_others(&meshes));
        let kink = |s: usize| {
            let (state, teeth) = (at.mesh(s), &meshes.teeth[s]);
            if self.gaps.is_none() && others.is_none() {
                return mesh.kink(&state, h);
            }
            mesh.kink_of_open(&state, h, |flank, number, position| {
                let opened = self.gaps.map_or(0.0, |_| {
                    detailed.opened(teeth, &meshes.states[s], (flank, number, position), mesh.whole.cone)
                });
                opened + others.as_ref().map_or(0.0, |others| others.of(s, flank, number))
            })
        };
        first(kink(0), kink(1))
    }

    fn visit(&self, at: &PlanetState, visit: &Visit, see: &mut Visitor) {
        let mut look = |slice: &SliceLoad| see(&self.load(at, slice), Some(slice));
        self.contact.detailed.look::<WIDE>(&self.meshes(at), visit.sides.clone(), &mut look);
    }

    fn face_load_factor(&self, at: &PlanetState, slice: &ToothLoad, pair: &Pair) -> f64 {
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
