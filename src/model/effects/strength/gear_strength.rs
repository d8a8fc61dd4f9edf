//! Stress and fatigue of the gears, from the loads at the ends of steps and at their peaks in between.

use super::fatigue::Fatigue;
use super::mesh_load::{FlankLoad, MeshLoad};
use super::overload::{Overload, Stressed};
use super::spec::StrengthSpec;
use crate::contact::pair_load::PairLoad;
use crate::model::effect_kinds::effect::Setting;
use crate::problem::Problem;
use crate::strength::face_load::root_factor;
use crate::strength::{Load, Rating, loaded_flank};

/// Readings of damage, which stand before those of safety.
const DAMAGES: usize = 4;

/// Constants of the strength of planet and side gear.
#[derive(Clone, Copy, Debug)]
pub struct GearStrength {
    rating: Rating,
    /// Application factor K_A, by which the load on the teeth exceeds the simulated one.
    application: f64,
    mean_cone: f64,
}

/// Part of a completed step, or all of it, of teeth that roll under load.
#[derive(Clone, Copy, Debug)]
pub struct RolledStep<'a> {
    /// Time at the end [s].
    pub time: f64,
    /// Angles by which the planets turned, by group [rad].
    pub spin: &'a [f64],
    /// Angles by which the side gears turned relative to the carrier [rad].
    pub roll: [f64; 2],
    /// Loads of the meshes at the end, by group and side.
    pub mesh: &'a [[MeshLoad; 2]],
    /// Planets of each group.
    pub members: &'a [f64],
}

impl GearStrength {
    /// Strength of the gears of `setting`, or why they cannot be rated.
    pub fn new(spec: &StrengthSpec, setting: &Setting) -> Result<Self, Problem> {
        let material = spec.material();
        let elastic = (setting.material.young_modulus, setting.material.poisson_ratio);
        let rating = Rating::new(setting.pair, elastic, &material, spec.tool_radius);
        let Some(rating) = rating else {
            return Err(Problem::new(
                "strength.tool_radius",
                format!(
                    "{} m_n: a tooth cut with this tool has no sound root section; choose a smaller radius or more teeth",
                    spec.tool_radius
                ),
            ));
        };
        Ok(Self { rating, application: spec.application_factor, mean_cone: setting.pair.mean_cone })
    }

    /// Adds the load of a pair to that of its mesh.
    pub fn add_load(&self, mesh: &mut MeshLoad, load: &PairLoad) {
        let moment = self.application * load.moment;
        let flank = mesh.flank(load.flank);
        let force = moment / load.cone;
        flank.normal += force;
        flank.pressing += force * load.face_factor;
        // the formula of the root takes the force at the mean cone distance
        flank.bending += moment / self.mean_cone * root_factor(load.face_factor, self.rating.face_exponent);
    }

    /// Adds the pressure of a pair to that of its mesh, which no rating asks for.
    pub fn add_pressure(&self, mesh: &mut MeshLoad, load: &PairLoad) {
        let flank = mesh.flank(load.flank);
        let line_load = self.application * load.steepest * self.mean_cone;
        let pressure = self.rating.contact.pressure_at(line_load, self.mean_cone, load.s);
        flank.pressure = flank.pressure.max(pressure.unwrap_or(0.0));
    }

    /// Sets the readings of stress from the loads of all meshes at an instant.
    pub fn read_stresses(&self, meshes: impl Iterator<Item = MeshLoad>, readings: &mut [f64]) {
        for mesh in meshes {
            let stresses = [
                mesh.largest(|flank| flank.pressure),
                mesh.largest(|flank| self.rating.contact.pressure(flank.normal, 0.0).unwrap_or(0.0)),
                mesh.largest(|flank| self.rating.root[0].stress(flank.bending)),
                mesh.largest(|flank| self.rating.root[1].stress(flank.bending)),
            ];
            for (reading, stress) in readings.iter_mut().zip(stresses) {
                *reading = reading.max(stress);
            }
        }
    }

    /// Sets the readings of damage and safety.
    pub fn read_damage(&self, fatigue: &Fatigue, readings: &mut [f64]) {
        let (damage, safety) = readings.split_at_mut(DAMAGES);
        damage.copy_from_slice(&fatigue.sums(&self.rating));
        safety.copy_from_slice(&fatigue.utilisation.safety());
    }

    /// Pressure by which pitting of a flank is rated [Pa].
    fn rated_pressure(&self, flank: &FlankLoad) -> f64 {
        self.rating.contact.rated_pressure(flank.pressing).unwrap_or(0.0)
    }

    /// Counts a step, or a part of it.
    pub fn count(&self, fatigue: &mut Fatigue, step: &RolledStep) {
        let RolledStep { spin, roll, mesh, members, .. } = *step;
        self.watch(fatigue, step);
        let rating = &self.rating;
        let load = |i: usize, far: bool, mesh: &MeshLoad| {
            [true, false].map(|driving| {
                let flank = &mesh.flanks()[usize::from(!driving)];
                Load {
                    flank: loaded_flank(far, driving),
                    root: rating.root[i].stress(flank.bending),
                    pressure: self.rated_pressure(flank),
                }
            })
        };
        for (g, both) in mesh.iter().enumerate() {
            let loads = [load(0, false, &both[0]), load(0, true, &both[1])];
            let curves = (&rating.bending[0], &rating.pitting);
            fatigue.planets[g].add(curves, spin[g], rating.pitch[0], loads.into_iter().flatten());
        }
        for s in 0..2 {
            let side = &mut fatigue.sides[s];
            let rolled = (side.rolling.place + roll[s]).abs() > 0.5 * rating.pitch[1];
            let loads = mesh
                .iter()
                .zip(members)
                .flat_map(|(both, members)| std::iter::repeat_n(load(1, false, &both[s]), *members as usize));
            side.add((&rating.bending[1], &rating.pitting), roll[s], rating.pitch[1], loads.flatten());
            let forces = mesh.iter().map(|both| both[s].bending());
            let heaviest = forces.reduce(|a, b| if b.abs() > a.abs() { b } else { a });
            let teeth = &mut fatigue.standing[s];
            if rolled {
                teeth.change(rating);
            }
            teeth.bend(rating, heaviest.unwrap_or_default());
        }
    }

    /// Records the largest stresses by their strengths, and the first that exceed them. A planet has its idler strength while it
    /// rolls.
    fn watch(&self, fatigue: &mut Fatigue, step: &RolledStep) {
        let rating = &self.rating;
        for (g, both) in step.mesh.iter().enumerate() {
            let planet = &fatigue.planets[g].rolling;
            let rolls = (planet.place + step.spin[g]).abs() > 0.5 * rating.pitch[0];
            for (side, load) in both.iter().enumerate() {
                let at = |stress: f64, strength: f64| Overload { time: step.time, stress, strength, group: g, side };
                let root = |i: usize| load.largest(|flank| rating.root[i].stress(flank.bending));
                let pressure = load.largest(|flank| self.rated_pressure(flank));
                let Fatigue { overloads, utilisation, .. } = fatigue;
                let loads = [
                    (Stressed::PlanetRoot, at(root(0), rating.bending[usize::from(!rolls)].strength)),
                    (Stressed::SideRoot, at(root(1), rating.bending[1].strength)),
                    (Stressed::Flanks, at(pressure, rating.pitting.strength)),
                ];
                for (what, load) in loads {
                    overloads.watch(what, load);
                    let largest = if what == Stressed::Flanks { &mut utilisation.flank } else { &mut utilisation.root };
                    *largest = largest.max(load.stress / load.strength);
                }
            }
        }
    }
}
