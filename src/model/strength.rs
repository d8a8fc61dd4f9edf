//! Stress and fatigue of a running differential, looked at after each accepted step.
//!
//! Damage of rolling teeth is counted by relative revolutions (`strength::counting`). Teeth that stay in mesh are loaded by
//! what the torque does: their root stress is counted by rainflow until they roll on.

use super::loads::ToothLoad;
use super::parameters::Parameters;
use super::readings::Stresses;
use super::state::Fatigue;
use crate::contact::pairs::Flank;
use crate::geometry::Pair;
use crate::problem::Problem;
use crate::strength::{Load, LoadFactors, Rainflow, Rating, loaded_flank, pulsating_range};

/// Constants of strength.
#[derive(Clone, Copy, Debug)]
pub struct Strength {
    rating: Rating,
    sensitivity: f64,
    mean_cone: f64,
}

/// Loads of one mesh as strength sees them.
#[derive(Clone, Copy, Debug, Default)]
pub struct MeshLoad {
    /// Sum of normal forces referred to the mean cone distance [N].
    pub normal: f64,
    /// Largest pressure of a pair [Pa].
    pub pressure: f64,
    /// Whether the drive flank carries.
    pub driving: bool,
}

impl MeshLoad {
    /// Adds the load of a pair.
    pub fn add(&mut self, strength: &Strength, load: &ToothLoad) {
        // referred to the mean cone distance, where the formulas of strength have it
        self.normal += load.normal * load.cone / strength.mean_cone;
        self.driving = load.flank == Flank::Drive;
        let pressure = strength.rating.contact.pressure_at(load.line_load, load.cone, load.s);
        self.pressure = self.pressure.max(pressure.unwrap_or(0.0));
    }
}

/// Reversals of stress up to this part of the strength are no cycles.
const GATE: f64 = 0.01;

impl Strength {
    /// Strength of the scene, if it asks for it.
    pub fn new(p: &Parameters, pair: &Pair) -> Result<Option<Self>, Problem> {
        if !p.effects.strength {
            return Ok(None);
        }
        let spec = &p.specs.strength;
        let material = spec.material();
        let elastic = (p.material.young_modulus, p.material.poisson_ratio);
        let rating = Rating::new(pair, elastic, &material, spec.tool_radius, &LoadFactors::default());
        let Some(rating) = rating else {
            return Err(Problem::new(
                "strength.tool_radius",
                format!(
                    "{} m_n: a tooth cut with this tool has no sound root section; choose a smaller radius or more teeth",
                    spec.tool_radius
                ),
            ));
        };
        Ok(Some(Self { rating, sensitivity: material.mean_stress_sensitivity(), mean_cone: pair.mean_cone }))
    }

    /// Stresses at an instant, from the loads of all meshes.
    pub fn stresses(&self, meshes: impl Iterator<Item = MeshLoad>) -> Stresses {
        let mut out = Stresses::default();
        for mesh in meshes {
            out.contact_max = out.contact_max.max(mesh.pressure);
            out.contact_pitch = out.contact_pitch.max(self.rating.contact.pressure(mesh.normal, 0.0).unwrap_or(0.0));
            for i in 0..2 {
                out.root_max[i] = out.root_max[i].max(self.rating.root[i].stress(mesh.normal));
            }
        }
        out
    }

    /// Counts an accepted step in which planets of group `g` turned by `spin[g]` and side gears by `roll` [rad] relative to
    /// the carrier under the loads `mesh[g][s]` of `members[g]` planets.
    pub fn count(&self, fatigue: &mut Fatigue, spin: &[f64], roll: [f64; 2], mesh: &[[MeshLoad; 2]], members: &[f64]) {
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

    /// Rainflow of the force on the teeth that stand in the heaviest mesh of side `s`, for the roots of both gears.
    fn stand(&self, fatigue: &mut Fatigue, s: usize, mesh: &MeshLoad, rolled: bool) {
        let rating = &self.rating;
        let (flow, damage) = (&mut fatigue.standing[s], &mut fatigue.stood[s]);
        let mut add = |cycle: crate::strength::LoadCycle| {
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
