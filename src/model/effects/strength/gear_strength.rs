//! Rating constants of the gears, and the readings of stress, damage and safety factors.

use super::mesh_load::BentPair;
use super::utilisation::safety;
use super::{Fatigue, FlankLoad, MeshLoad, StrengthSpec};
use crate::contact::detailed::{Detailed, SliceLoad};
use crate::contact::pair_load::PairLoad;
use crate::contact::tooth_friction::{Sliding, ToothFriction};
use crate::contact::{Flank, ToothLoad};
use crate::model::effect_kinds::EffectSetting;
use crate::model::scene::GearContact;
use crate::model::thermal::{GEARS, NODES, OIL};
use crate::problem::Problem;
use crate::strength::Rating;
use crate::strength::face_load::root_factor;
use crate::strength::flash::Flash;

/// Number of readings of damage; the readings of safety follow them.
const DAMAGES: usize = 4;

/// Number of readings of stress; the readings of temperature follow them.
const STRESSES: usize = 5;
/// Index of the contact temperature among the readings.
pub const CONTACT_TEMPERATURE: usize = STRESSES + 1;
/// Largest safety factor that is reported.
const MOST_SAFETY: f64 = 1000.0;

/// Rating constants of planet and side gear.
#[derive(Clone, Copy, Debug)]
pub struct GearStrength {
    pub(super) rating: Rating,
    /// Application factor K_A: rated load over simulated load.
    application: f64,
    /// Mean cone distance [m].
    mean_cone: f64,
    /// True if one spring represents all teeth of a mesh.
    pub(super) is_single: bool,
    /// Position of the rated point on the path of contact, from the position at which the planet's tooth is in the
    /// middle of the mesh, in pitches.
    pub(super) rated_point: f64,
    flash: Flash,
    /// Contact temperature at which flanks scuff [K].
    scuffing: f64,
}

impl GearStrength {
    /// Strength of the gears of `setting`. Fails if the tool leaves a tooth without a valid root section.
    pub fn new(spec: &StrengthSpec, setting: &EffectSetting) -> Result<Self, Problem> {
        let strength = spec.tooth_strength();
        let elastic = (setting.material.young_modulus, setting.material.poisson_ratio);
        let rating = Rating::new(setting.pair, elastic, &strength, spec.tool_radius);
        let Some(rating) = rating else {
            return Err(problem!(
                "strength.tool_radius",
                "{} m_n: a tooth cut with this tool has no valid root section; choose a smaller radius or more teeth",
                spec.tool_radius
            ));
        };
        let flash = Flash { modulus: rating.contact.modulus, coefficient: spec.thermal_contact_coefficient };
        let pair = setting.pair;
        Ok(Self {
            rating,
            application: spec.application_factor,
            mean_cone: pair.mean_cone,
            is_single: setting.scene.gear_contact == GearContact::Lumped,
            rated_point: (rating.contact.rated_position() - pair.centred_position()) / pair.base_pitch,
            flash,
            scuffing: spec.scuffing_temperature,
        })
    }

    /// Damage of these gears with `groups` groups of planets, as in [`Fatigue::new`].
    pub fn fatigue(&self, groups: usize, times: (f64, f64), in_equilibrium: bool) -> Fatigue {
        Fatigue::new(&self.rating, groups, times, in_equilibrium)
    }

    /// Remembers the damage of all teeth, because it is read.
    pub fn remember(&self, fatigue: &mut Fatigue) {
        fatigue.remember(&self.rating.bending);
    }

    /// Adds the load of a pair to the load of its mesh. The stress of a root follows from the force of the pair and the
    /// height at which it acts. One spring for all teeth has no pairs: its stress is that of method B1.
    pub fn add_load(&self, mesh: &mut MeshLoad, load: &PairLoad) {
        let moment = self.application * load.moment;
        let flank = mesh.flank(load.flank);
        let force = moment / load.cone;
        flank.normal += force;
        flank.normal_face_loaded += force * load.face_factor;
        // the root formula needs the force at the mean cone distance
        let bending = moment / self.mean_cone * root_factor(load.face_factor, self.rating.face_exponent);
        let stress = self
            .rating
            .root
            .each_ref()
            .map(|root| bending.max(0.0) * if self.is_single { root.per_force } else { root.per_force_at(load.s) });
        mesh.add_pair(BentPair { drives: load.flank == Flank::Drive, teeth: load.teeth, stress });
    }

    /// Raises the pressure of a mesh to the pressure of one of its pairs. This pressure is only a reading; no rating
    /// uses it.
    pub fn add_pressure(&self, mesh: &mut MeshLoad, load: &PairLoad) {
        let flank = mesh.flank(load.flank);
        let line_load = self.application * load.steepest * self.mean_cone;
        let pressure = self.rating.contact.pressure_at(line_load, self.mean_cone, load.s);
        flank.pressure = flank.pressure.max(pressure.unwrap_or(0.0));
    }

    /// Raises the pressure of a mesh to the pressures of the pair of `load` at both ends of the face. `line_load`
    /// returns the load per width [N/m] at a cone distance [m].
    pub fn add_pressure_at_ends(&self, mesh: &mut MeshLoad, load: &ToothLoad, line_load: &dyn Fn(f64) -> f64) {
        let flank = mesh.flank(load.flank);
        for cone in self.rating.contact.cone_range {
            let pressure = self.rating.contact.pressure_at(self.application * line_load(cone), cone, load.s);
            flank.pressure = flank.pressure.max(pressure.unwrap_or(0.0));
        }
    }

    /// Raises the readings of stress to the largest stresses of all meshes at an instant.
    pub fn read_stresses(&self, meshes: impl Iterator<Item = MeshLoad>, readings: &mut [f64]) {
        for mesh in meshes {
            let stresses = [
                mesh.largest(|flank| flank.pressure),
                mesh.largest(|flank| self.rating.contact.pressure(flank.normal, 0.0).unwrap_or(0.0)),
                mesh.root_stress(0),
                mesh.root_stress(1),
                mesh.largest(|flank| self.rated_pressure(flank)),
            ];
            for (reading, stress) in readings.iter_mut().zip(stresses) {
                *reading = reading.max(stress);
            }
        }
    }

    /// Largest flash temperature over the face of a pair [K]. `slice` is a slice of the pair in the mesh `detailed`,
    /// with the friction `law`. Beyond the ends of the path, the radii at the ends are used, as for pressure.
    pub fn flash(&self, detailed: &Detailed, law: &ToothFriction, slice: &SliceLoad) -> f64 {
        let Some(radius) = self.rating.contact.relative_radius(slice.s) else { return 0.0 };
        detailed.largest_on_face(slice, law, |point| {
            let sliding = Sliding { radius: radius * point.cone, ..point.sliding };
            self.flash.temperature(&sliding, point.coefficient)
        })
    }

    /// Sets the readings of temperature and of the safety against scuffing, from the largest `flash` temperature [K]
    /// and the `temperatures` of the nodes [K].
    pub fn read_flash(&self, flash: f64, temperatures: &[f64; NODES], readings: &mut [f64]) {
        let (contact, oil) = (temperatures[GEARS] + flash, temperatures[OIL]);
        let safety = (self.scuffing - oil) / (contact - oil);
        let is_warmer = contact > oil && safety < MOST_SAFETY;
        readings[STRESSES..].copy_from_slice(&[flash, contact, if is_warmer { safety } else { MOST_SAFETY }]);
    }

    /// Sets the readings of damage and of the safety factors.
    pub fn read_damage(&self, fatigue: &Fatigue, readings: &mut [f64]) {
        let (sums, open) = fatigue.worst(&self.rating.bending);
        let (damage, safeties) = readings.split_at_mut(DAMAGES);
        damage.copy_from_slice(&sums);
        let utilisation = &fatigue.tally.utilisation;
        let root = utilisation.root.share.max(open / self.rating.bending.curve.strength);
        safeties.copy_from_slice(&[safety(root), utilisation.flank.safety()]);
    }

    /// Pressure by which pitting of a flank is rated [Pa].
    pub(super) fn rated_pressure(&self, flank: &FlankLoad) -> f64 {
        self.rating.contact.rated_pressure(flank.normal_face_loaded).unwrap_or(0.0)
    }
}
