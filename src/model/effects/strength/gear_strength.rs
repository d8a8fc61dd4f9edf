//! Stress and fatigue of the gears, evaluated after each accepted step.

use super::fatigue::Fatigue;
use super::mesh_load::MeshLoad;
use super::overload::{Overload, Stressed};
use super::spec::StrengthSpec;
use crate::contact::pairs::Flank;
use crate::contact::tooth_load::ToothLoad;
use crate::model::effect_kinds::effect::Setting;
use crate::problem::Problem;
use crate::strength::{Load, LoadCycle, LoadFactors, Rainflow, Rating, loaded_flank, pulsating_range};

/// Reversals of stress up to this part of the strength are no cycles.
const GATE: f64 = 0.01;

/// Constants of the strength of planet and side gear.
#[derive(Clone, Copy, Debug)]
pub struct GearStrength {
    pub(super) rating: Rating,
    sensitivity: f64,
    pub(super) mean_cone: f64,
}

/// An accepted step of teeth that roll under load.
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
        let rating = Rating::new(setting.pair, elastic, &material, spec.tool_radius, &LoadFactors::default());
        let Some(rating) = rating else {
            return Err(Problem::new(
                "strength.tool_radius",
                format!(
                    "{} m_n: a tooth cut with this tool has no sound root section; choose a smaller radius or more teeth",
                    spec.tool_radius
                ),
            ));
        };
        let sensitivity = material.mean_stress_sensitivity();
        Ok(Self { rating, sensitivity, mean_cone: setting.pair.mean_cone })
    }

    /// Adds the load of a pair to that of its mesh.
    pub fn add_load(&self, mesh: &mut MeshLoad, load: &ToothLoad) {
        // referred to the mean cone distance, as in the formulas of strength
        mesh.normal += load.normal * load.cone / self.mean_cone;
        mesh.driving = load.flank == Flank::Drive;
        let pressure = self.rating.contact.pressure_at(load.line_load, load.cone, load.s);
        mesh.pressure = mesh.pressure.max(pressure.unwrap_or(0.0));
    }

    /// Sets the readings of stress from the loads of all meshes at an instant.
    pub fn read_stresses(&self, meshes: impl Iterator<Item = MeshLoad>, readings: &mut [f64]) {
        for mesh in meshes {
            let stresses = [
                mesh.pressure,
                self.rating.contact.pressure(mesh.normal, 0.0).unwrap_or(0.0),
                self.rating.root[0].stress(mesh.normal),
                self.rating.root[1].stress(mesh.normal),
            ];
            for (reading, stress) in readings.iter_mut().zip(stresses) {
                *reading = reading.max(stress);
            }
        }
    }

    /// Counts an accepted step.
    pub fn count(&self, fatigue: &mut Fatigue, step: &RolledStep) {
        let RolledStep { spin, roll, mesh, members, .. } = *step;
        self.watch(fatigue, step);
        let rating = &self.rating;
        let load = |i: usize, far: bool, m: &MeshLoad| Load {
            flank: loaded_flank(far, m.driving),
            root: rating.root[i].stress(m.normal),
            pressure: rating.contact.rated_pressure(m.normal).unwrap_or(0.0),
        };
        for (g, both) in mesh.iter().enumerate() {
            let loads = [load(0, false, &both[0]), load(0, true, &both[1])];
            fatigue.planets[g].add((&rating.bending[0], &rating.pitting), spin[g], rating.pitch[0], loads);
        }
        for s in 0..2 {
            let side = &mut fatigue.sides[s];
            let rolled = (side.rolling.place + roll[s]).abs() > 0.5 * rating.pitch[1];
            let loads = mesh
                .iter()
                .zip(members)
                .flat_map(|(both, members)| std::iter::repeat_n(load(1, false, &both[s]), *members as usize));
            side.add((&rating.bending[1], &rating.pitting), roll[s], rating.pitch[1], loads);
            let heaviest = mesh.iter().map(|both| both[s]).reduce(|a, b| if b.normal > a.normal { b } else { a });
            self.stand(fatigue, s, &heaviest.unwrap_or_default(), rolled);
        }
    }

    /// Records the first stresses that exceed their strength. A planet has its idler strength while it rolls.
    fn watch(&self, fatigue: &mut Fatigue, step: &RolledStep) {
        let rating = &self.rating;
        for (g, both) in step.mesh.iter().enumerate() {
            let planet = &fatigue.planets[g].rolling;
            let rolls = (planet.place + step.spin[g]).abs() > 0.5 * rating.pitch[0];
            for (side, load) in both.iter().enumerate() {
                let at = |stress: f64, strength: f64| Overload { time: step.time, stress, strength, group: g, side };
                let root = |i: usize| rating.root[i].stress(load.normal);
                let pressure = rating.contact.rated_pressure(load.normal).unwrap_or(0.0);
                let overloads = &mut fatigue.overloads;
                overloads.watch(Stressed::PlanetRoot, at(root(0), rating.bending[usize::from(!rolls)].strength));
                overloads.watch(Stressed::SideRoot, at(root(1), rating.bending[1].strength));
                overloads.watch(Stressed::Flanks, at(pressure, rating.pitting.strength));
            }
        }
    }

    /// Rainflow of the force on the teeth that stand in the heaviest mesh of side `s`, for the roots of both gears.
    fn stand(&self, fatigue: &mut Fatigue, s: usize, mesh: &MeshLoad, rolled: bool) {
        let rating = &self.rating;
        let (flow, damage) = (&mut fatigue.standing[s], &mut fatigue.stood[s]);
        let mut add = |cycle: LoadCycle| {
            // each tooth stands on one flank: the planet's idler strength is for teeth that roll
            let range = pulsating_range(&cycle, self.sensitivity);
            for (i, damage) in damage.iter_mut().enumerate() {
                damage.add(&rating.bending[1], rating.root[i].stress(range), cycle.count);
            }
        };
        if rolled {
            flow.rest(&mut add);
            let weakest = rating.root[0].per_force.max(rating.root[1].per_force);
            *flow = Rainflow::new(GATE * rating.bending[1].strength / weakest);
        }
        flow.push(if mesh.driving { mesh.normal } else { -mesh.normal }, &mut add);
    }
}
