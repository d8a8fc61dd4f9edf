//! Stress and fatigue of a running differential, evaluated after each accepted step.
//!
//! Damage of rolling teeth is counted by relative revolutions (`strength::counting`). Teeth that stay in mesh are loaded by
//! the torque alone: their root stress is counted by rainflow until they roll on.

use serde::{Deserialize, Serialize};

use crate::contact::pairs::Flank;
use crate::contact::tooth_load::ToothLoad;
use crate::declaration::units::{self, MPA};
use crate::declaration::{Parameter, Row, real};
use crate::model::effect_kinds::effect::{Changes, Declare, Effect, Needs, Reading, Setting};
use crate::model::scene::GearContact;
use crate::model::scene::layout::MAX_GROUPS;
use crate::problem::Problem;
use crate::strength::{
    Damage, Load, LoadFactors, Material, Rainflow, Rating, SnCurve, ToothDamage, loaded_flank, pulsating_range,
};

/// Strength of the gears.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StrengthSpec {
    /// Tip radius of the tool that cuts the roots, in modules.
    pub tool_radius: f64,
    /// Bending strength of the roots at the knee under pulsating load σ_FE [Pa].
    pub bending_strength: f64,
    /// Cycles at the knee of bending.
    pub bending_cycles: f64,
    /// Life factor of bending at 10³ cycles Y_NT.
    pub bending_life_factor: f64,
    /// Part of the bending strength that teeth loaded on alternate flanks keep Y_M.
    pub idler_factor: f64,
    /// Contact strength of the flanks at the knee σ_Hlim [Pa].
    pub contact_strength: f64,
    /// Cycles at the knee of pitting.
    pub contact_cycles: f64,
    /// Life factor of pitting at 10⁵ cycles Z_NT.
    pub contact_life_factor: f64,
}

impl Default for StrengthSpec {
    fn default() -> Self {
        Self {
            tool_radius: 0.25,
            bending_strength: 1e9,
            bending_cycles: 3e6,
            bending_life_factor: 2.5,
            idler_factor: 0.7,
            contact_strength: 1.5e9,
            contact_cycles: 5e7,
            contact_life_factor: 1.6,
        }
    }
}

impl StrengthSpec {
    /// S–N curves of the material.
    pub fn material(&self) -> Material {
        Material {
            bending: SnCurve::through(self.bending_strength, self.bending_cycles, self.bending_life_factor, 1e3),
            pitting: SnCurve::through(self.contact_strength, self.contact_cycles, self.contact_life_factor, 1e5),
            idler_factor: self.idler_factor,
        }
    }
}

impl Declare for StrengthSpec {
    const DESCRIPTION: &'static str = "Hertz pressure, root stress by ISO 10300, and Miner damage";
    const NEEDS: Option<Needs> = Some(Needs {
        contacts: &[GearContact::Lumped, GearContact::Tooth, GearContact::Solid],
        why: "it follows from the forces of the meshes",
    });
    const READINGS: &'static [Reading] = &[
        stress("stress.contact_max", "Largest Hertz pressure of all tooth pairs where they touch"),
        stress(
            "stress.contact_pitch",
            "Hertz pressure at the pitch point of the mean section if one pair carried the whole mesh; largest of all meshes",
        ),
        stress("stress.root_planet_max", "Largest root stress of the planets by ISO 10300 method B1"),
        stress("stress.root_side_max", "Largest root stress of the side gears by ISO 10300 method B1"),
        damage("damage.planet", "Miner sum of the roots of the worst planet"),
        damage("damage.side", "Miner sum of the roots of the worse side gear"),
        damage("damage.planet_flank", "Miner sum of pitting of the worst planet"),
        damage("damage.side_flank", "Miner sum of pitting of the worse side gear"),
    ];

    fn parameters() -> Vec<Row<Parameter<Self>>> {
        vec![
            real(
                "strength.tool_radius",
                units::ONE,
                None,
                (0.0, 0.6),
                |p| &mut p.tool_radius,
                "Tip radius of the tool that cuts the roots, per module",
            ),
            real(
                "strength.bending_strength",
                units::PASCAL,
                Some(MPA),
                (1e6, 1e11),
                |p| &mut p.bending_strength,
                "Bending strength of the roots at the knee under pulsating load (carburised MQ, ISO 6336-5: 2 x 500 MPa)",
            ),
            real(
                "strength.bending_cycles",
                units::ONE,
                None,
                (1e4, 1e12),
                |p| &mut p.bending_cycles,
                "Cycles at the knee of bending",
            ),
            real(
                "strength.bending_life_factor",
                units::ONE,
                None,
                (1.05, 10.0),
                |p| &mut p.bending_life_factor,
                "Life factor of bending at 1e3 cycles (ISO 6336-3)",
            ),
            real(
                "strength.idler_factor",
                units::ONE,
                None,
                (0.5, 1.0),
                |p| &mut p.idler_factor,
                "Part of the bending strength that teeth loaded on alternate flanks keep",
            ),
            real(
                "strength.contact_strength",
                units::PASCAL,
                Some(MPA),
                (1e6, 1e11),
                |p| &mut p.contact_strength,
                "Contact strength of the flanks at the knee (carburised MQ, ISO 6336-5: 1500 MPa)",
            ),
            real(
                "strength.contact_cycles",
                units::ONE,
                None,
                (1e6, 1e12),
                |p| &mut p.contact_cycles,
                "Cycles at the knee of pitting",
            ),
            real(
                "strength.contact_life_factor",
                units::ONE,
                None,
                (1.05, 10.0),
                |p| &mut p.contact_life_factor,
                "Life factor of pitting at 1e5 cycles (ISO 6336-2)",
            ),
        ]
    }
}

impl Effect for StrengthSpec {}

const fn stress(name: &'static str, description: &'static str) -> Reading {
    Reading { name, unit: units::PASCAL, display: Some(MPA), changes: Changes::Always, description }
}

const fn damage(name: &'static str, description: &'static str) -> Reading {
    Reading { name, unit: units::ONE, display: None, changes: Changes::ByStep, description }
}

/// Damage of the teeth so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Fatigue {
    /// Planets, by group.
    pub planets: [ToothDamage; MAX_GROUPS],
    /// Side gears.
    pub sides: [ToothDamage; 2],
    /// Force on the teeth that stand in mesh on each side.
    pub standing: [Rainflow; 2],
    /// Damage to the roots of planet and side gear from it, by side.
    pub stood: [[Damage; 2]; 2],
}

impl Fatigue {
    /// Sets the readings of damage.
    pub fn read(&self, readings: &mut [f64]) {
        let worst = |gears: &[ToothDamage], of: fn(&ToothDamage) -> f64| gears.iter().map(of).fold(0.0, f64::max);
        let stood = |i: usize| self.stood[0][i].sum.max(self.stood[1][i].sum);
        let damage = [
            worst(&self.planets, ToothDamage::worst_root) + stood(0),
            worst(&self.sides, ToothDamage::worst_root) + stood(1),
            worst(&self.planets, ToothDamage::worst_pitting),
            worst(&self.sides, ToothDamage::worst_pitting),
        ];
        readings[STRESSES..].copy_from_slice(&damage);
    }
}

/// Readings of stress, which stand before those of damage.
const STRESSES: usize = 4;

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
