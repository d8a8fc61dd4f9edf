//! Declaration of the effect: parameters, their rows, and the readings of stress and damage.

use crate::declaration::units::{self, DEG_C, DisplayUnit, MPA, Unit};
use crate::declaration::{Parameter, Row, row};
use crate::model::effect_kinds::{Changes, Declare, Effect, Needs, Reading};
use crate::model::scene::GearContact;
use crate::strength::{SnCurve, ToothStrength};

spec! {
    /// Strength of the gears.
    pub struct StrengthSpec {
        /// Tip radius of the tool that cuts the roots, in modules.
        pub tool_radius: f64 = 0.25,
        /// Application factor K_A: load on the teeth over the simulated load.
        pub application_factor: f64 = 1.0,
        /// Bending strength of the roots at the knee under pulsating load σ_FE [Pa].
        pub bending_strength: f64 = 1e9,
        /// Cycles at the knee of bending.
        pub bending_cycles: f64 = 3e6,
        /// Life factor of bending at 10³ cycles Y_NT.
        pub bending_life_factor: f64 = 2.5,
        /// Idler factor Y_M: fraction of the bending strength of teeth that are loaded on alternate flanks.
        pub idler_factor: f64 = 0.7,
        /// Contact strength of the flanks at the knee σ_Hlim [Pa].
        pub contact_strength: f64 = 1.5e9,
        /// Cycles at the knee of pitting.
        pub contact_cycles: f64 = 5e7,
        /// Life factor of pitting at 10⁵ cycles Z_NT.
        pub contact_life_factor: f64 = 1.6,
        /// Thermal contact coefficient B_M of the flanks [W·√s/(m²·K)].
        pub thermal_contact_coefficient: f64 = 13_800.0,
        /// Contact temperature at which flanks scuff in the oil [K].
        pub scuffing_temperature: f64 = 673.15,
        /// Time after the start of the run from which safety and damage count [s].
        pub rate_from: f64 = 0.0,
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
    const NEEDS: Option<Needs> = Some(Needs {
        contacts: &[GearContact::Lumped, GearContact::Tooth, GearContact::Solid],
        why: "it follows from the forces of the meshes",
    });
    const READINGS: &'static [Reading] = &[
        stress("stress.contact_max", "Largest Hertz pressure of all tooth pairs at their contact positions"),
        stress(
            "stress.contact_pitch",
            "Largest Hertz pressure at the pitch point of all meshes, at the mean section: one tooth pair transmits \
             the whole mesh load",
        ),
        stress(
            "stress.root_planet_max",
            "Largest root stress of the planets, from the force and the height of each tooth pair (ISO 6336-3 method B); \
             for lumped gears from the mesh force (ISO 10300 method B1)",
        ),
        stress(
            "stress.root_side_max",
            "Largest root stress of the side gears, from the force and the height of each tooth pair (ISO 6336-3 method \
             B); for lumped gears from the mesh force (ISO 10300 method B1)",
        ),
        stress(
            "stress.contact_rated",
            "Largest contact pressure for the flank rating, used by safety.flank_min and damage: one tooth pair \
             transmits the mesh load at the worse inner point of single contact, with the face load factor",
        ),
        temperature(
            "temperature.flash",
            (units::KELVIN_DIFFERENCE, None),
            "Largest flash temperature of the flanks over the whole face (Blok); 0 without effects.tooth_friction",
        ),
        temperature(
            "temperature.contact",
            (units::KELVIN, Some(DEG_C)),
            "Largest contact temperature of the flanks: temperature.gears, plus temperature.flash with \
             effects.strength",
        ),
        Reading {
            name: "safety.scuffing",
            unit: units::ONE,
            display: None,
            changes: Changes::Always,
            description: "Instantaneous safety factor S_B against scuffing: strength.scuffing_temperature minus \
                          temperature.oil, divided by temperature.contact minus temperature.oil; at most 1000",
        },
        damage("damage.planet", "Miner sum of root bending of the most damaged tooth of the planets"),
        damage("damage.side", "Miner sum of root bending of the most damaged tooth of the side gears"),
        damage("damage.planet_flank", "Miner sum of pitting of the most damaged flank of the planets"),
        damage("damage.side_flank", "Miner sum of pitting of the most damaged flank of the side gears"),
        safety(
            "safety.root_min",
            "Smallest safety factor S_F of all tooth roots so far: bending strength at the knee over the stress of the \
             pulsating cycle with the same damage, for all load cycles so far; at most 1000, and 1000 before the first \
             evaluated step",
        ),
        safety(
            "safety.flank_min",
            "Smallest safety factor S_H of all flanks so far: contact strength at the knee over \
             stress.contact_rated; at most 1000, and 1000 before the first evaluated step",
        ),
    ];

    fn parameters() -> Vec<Row<Parameter<Self>>> {
        vec![
            row("strength.tool_radius", "Tip radius per module of the tool that cuts the tooth roots").real(
                units::ONE,
                (0.0, 0.6),
                |p| &mut p.tool_radius,
            ),
            row(
                "strength.bending_strength",
                "Bending strength of the tooth roots under pulsating load at the knee of the S-N curve (carburised \
                 MQ, 2 x 500 MPa in ISO 6336-5)",
            )
            .real((units::PASCAL, MPA), (1e6, 1e11), |p| &mut p.bending_strength),
            row("strength.bending_cycles", "Number of cycles at the knee of the S-N curve for bending").real(
                units::ONE,
                (1e4, 1e12),
                |p| &mut p.bending_cycles,
            ),
            row("strength.bending_life_factor", "Life factor of bending at 1e3 cycles (ISO 6336-3)").real(
                units::ONE,
                (1.05, 10.0),
                |p| &mut p.bending_life_factor,
            ),
            row("strength.idler_factor", "Factor on the bending strength of teeth loaded on alternate flanks").real(
                units::ONE,
                (0.5, 1.0),
                |p| &mut p.idler_factor,
            ),
            row(
                "strength.contact_strength",
                "Contact strength of the flanks at the knee of the S-N curve (carburised MQ, 1500 MPa in ISO 6336-5)",
            )
            .real((units::PASCAL, MPA), (1e6, 1e11), |p| &mut p.contact_strength),
            row("strength.contact_cycles", "Number of cycles at the knee of the S-N curve for pitting").real(
                units::ONE,
                (1e6, 1e12),
                |p| &mut p.contact_cycles,
            ),
            row("strength.contact_life_factor", "Life factor of pitting at 1e5 cycles (ISO 6336-2)").real(
                units::ONE,
                (1.05, 10.0),
                |p| &mut p.contact_life_factor,
            ),
            row(
                "strength.application_factor",
                "Application factor, the ratio of real to simulated tooth load: covers loads that the scene leaves \
                 out",
            )
            .real(units::ONE, (0.1, 10.0), |p| &mut p.application_factor),
            row("strength.thermal_contact_coefficient", "Thermal contact coefficient of the flanks (steel)")
                .when("effects.tooth_friction = true")
                .real(units::EFFUSIVITY, (100.0, 1e5), |p| &mut p.thermal_contact_coefficient),
            row(
                "strength.scuffing_temperature",
                "Contact temperature at which flanks scuff, from an oil test (FZG; ISO/TS 10300-20)",
            )
            .when("effects.tooth_friction = true or effects.warm_up = true")
            .real((units::KELVIN, DEG_C), (300.0, 2000.0), |p| &mut p.scuffing_temperature),
            row(
                "strength.rate_from",
                "Time after the start of the run from which safety and damage are evaluated: excludes the settling \
                 of a start outside equilibrium",
            )
            .real(units::SECOND, (0.0, 1e9), |p| &mut p.rate_from),
        ]
    }
}

impl Effect for StrengthSpec {}

const fn temperature(
    name: &'static str,
    (unit, display): (Unit, Option<DisplayUnit>),
    description: &'static str,
) -> Reading {
    Reading { name, unit, display, changes: Changes::Always, description }
}

const fn stress(name: &'static str, description: &'static str) -> Reading {
    Reading { name, unit: units::PASCAL, display: Some(MPA), changes: Changes::Always, description }
}

const fn damage(name: &'static str, description: &'static str) -> Reading {
    Reading { name, unit: units::ONE, display: None, changes: Changes::ByStep, description }
}

const fn safety(name: &'static str, description: &'static str) -> Reading {
    Reading { name, unit: units::ONE, display: None, changes: Changes::ByStep, description }
}
