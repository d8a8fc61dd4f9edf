//! Declaration of the effect: parameters, their rows, and the readings of stress and damage.

use crate::declaration::prelude::*;
use crate::friction::ToothFrictionSpec;
use crate::model::effect_kinds::{Class, Declare, Effect, Needs, Reading, readings};
use crate::model::effects::warm_up::WarmUpSpec;
use crate::model::scene::GearContact;
use crate::strength::{SnCurve, ToothStrength};

parameters! {
    /// Strength of the gears.
    pub struct StrengthSpec in "strength" {
        /// Tip radius per module of the tool that cuts the tooth roots
        tool_radius: f64 = 0.25, ONE, 0.0..=0.6;
        /// Bending strength of the tooth roots under pulsating load at the knee of the S-N curve (carburised MQ, 2 x 500
        /// MPa in ISO 6336-5)
        bending_strength: f64 = 1e9, PASCAL | MPA, 1e6..=1e11;
        /// Number of cycles at the knee of the S-N curve for bending
        bending_cycles: f64 = 3e6, ONE, 1e4..=1e12;
        /// Life factor of bending at 1e3 cycles (ISO 6336-3)
        bending_life_factor: f64 = 2.5, ONE, 1.05..=10.0;
        /// Factor on the bending strength of teeth loaded on alternate flanks
        idler_factor: f64 = 0.7, ONE, 0.5..=1.0;
        /// Contact strength of the flanks at the knee of the S-N curve (carburised MQ, 1500 MPa in ISO 6336-5)
        contact_strength: f64 = 1.5e9, PASCAL | MPA, 1e6..=1e11;
        /// Number of cycles at the knee of the S-N curve for pitting
        contact_cycles: f64 = 5e7, ONE, 1e6..=1e12;
        /// Life factor of pitting at 1e5 cycles (ISO 6336-2)
        contact_life_factor: f64 = 1.6, ONE, 1.05..=10.0;
        /// Application factor, the ratio of real to simulated tooth load: covers loads that the scene leaves out
        application_factor: f64 = 1.0, ONE, 0.1..=10.0;
        /// Thermal contact coefficient of the flanks (steel)
        thermal_contact_coefficient: f64 = 13_800.0, EFFUSIVITY, 100.0..=1e5, when(on!(ToothFrictionSpec));
        /// Contact temperature at which flanks scuff, from an oil test (FZG; ISO/TS 10300-20)
        scuffing_temperature: f64 = 673.15, KELVIN | DEG_C, 300.0..=2000.0,
            when(any([on!(ToothFrictionSpec), on!(WarmUpSpec)]));
        /// Time after the start of the run from which safety and damage are evaluated: excludes the settling of a start
        /// outside equilibrium
        rate_from: f64 = 0.0, SECOND, 0.0..=1e9;
    }
}

impl StrengthSpec {
    /// S–N curves of the material.
    pub fn tooth_strength(&self) -> ToothStrength {
        ToothStrength {
            bending: SnCurve::through(self.bending_strength, self.bending_cycles, self.bending_life_factor, 1e3),
            pitting: SnCurve::through(self.contact_strength, self.contact_cycles, self.contact_life_factor, 1e5),
            idler_factor: self.idler_factor,
        }
    }
}

impl Declare for StrengthSpec {
    const DESCRIPTION: &'static str = "Hertz pressure, root stress by ISO 10300, Miner damage, and flash temperature";
    const CLASS: Class = Class::Outputs;
    const RECORDS_STEPS: bool = true;
    const NEEDS: Option<Needs> = Some(Needs {
        contacts: &[GearContact::Lumped, GearContact::Tooth, GearContact::Solid],
        why: "it follows from the forces of the meshes",
    });

    const READINGS: &'static [Reading] = readings! {
        /// Largest Hertz pressure of all tooth pairs at their contact positions
        "stress.contact_max": PASCAL | MPA, Always;
        /// Largest Hertz pressure at the pitch point of all meshes, at the mean section: one tooth pair transmits the
        /// whole mesh load
        "stress.contact_pitch": PASCAL | MPA, Always;
        /// Largest root stress of the planets, from the force and the height of each tooth pair (ISO 6336-3 method B);
        /// for lumped gears from the mesh force (ISO 10300 method B1)
        "stress.root_planet_max": PASCAL | MPA, Always;
        /// Largest root stress of the side gears, from the force and the height of each tooth pair (ISO 6336-3 method
        /// B); for lumped gears from the mesh force (ISO 10300 method B1)
        "stress.root_side_max": PASCAL | MPA, Always;
        /// Largest contact pressure for the flank rating, used by safety.flank_min and damage: one tooth pair
        /// transmits the mesh load at the worse inner point of single contact, with the face load factor
        "stress.contact_rated": PASCAL | MPA, Always;
        /// Largest flash temperature of the flanks over the whole face (Blok); 0 without effects.tooth_friction
        "temperature.flash": KELVIN_DIFFERENCE, Always;
        /// Largest contact temperature of the flanks: temperature.gears, plus temperature.flash with effects.strength
        "temperature.contact": KELVIN | DEG_C, Always;
        /// Instantaneous safety factor S_B against scuffing: strength.scuffing_temperature minus temperature.oil,
        /// divided by temperature.contact minus temperature.oil; at most 1000
        "safety.scuffing": ONE, Always;
        /// Miner sum of root bending of the most damaged tooth of the planets
        "damage.planet": ONE, ByStep;
        /// Miner sum of root bending of the most damaged tooth of the side gears
        "damage.side": ONE, ByStep;
        /// Miner sum of pitting of the most damaged flank of the planets
        "damage.planet_flank": ONE, ByStep;
        /// Miner sum of pitting of the most damaged flank of the side gears
        "damage.side_flank": ONE, ByStep;
        /// Smallest safety factor S_F of all tooth roots so far: bending strength at the knee over the stress of the
        /// pulsating cycle with the same damage, for all load cycles so far; at most 1000, and 1000 before the first
        /// evaluated step
        "safety.root_min": ONE, ByStep;
        /// Smallest safety factor S_H of all flanks so far: contact strength at the knee over stress.contact_rated; at
        /// most 1000, and 1000 before the first evaluated step
        "safety.flank_min": ONE, ByStep;
    };

    fn needs() -> Vec<(Need, Condition)> {
        // flash temperatures are added to it
        vec![(Need::Temperature, on!(Self))]
    }
}

impl Effect for StrengthSpec {}
