//! Rows of material, oil and moments of inertia.

use crate::declaration::units::{self, DEG_C, MM2_PER_S, MPA};
use crate::declaration::{Parameter, Row, row};
use crate::model::Parameters;

/// Condition under which the dynamic viscosity of the oil has an effect, and therefore its density.
macro_rules! dynamic {
    () => {
        "effects.tooth_friction = true and tooth_friction.viscosity_from_oil = true and tooth_friction.law != coulomb_stribeck \
         or effects.bearing_drag = true and bearing_drag.viscosity_from_oil = true"
    };
}

/// Condition under which the density of the oil has an effect.
const DENSE: &str = dynamic!();
/// Condition under which the viscosity of the oil has an effect.
macro_rules! oiled {
    () => {
        concat!(
            dynamic!(),
            " or effects.bearing_drag = true and bearing_drag.churning_from_geometry = true and bearing_drag.oil_level > 0"
        )
    };
}

/// Condition under which the viscosity of the oil has an effect, as a constant.
const OILED: &str = oiled!();

/// Condition under which the friction of an effect depends on temperature.
macro_rules! over_temperature {
    ($effect:literal) => {
        concat!("effects.", $effect, " = true and (", $effect, ".cold_factor != 1 or ", $effect, ".hot_factor != 1)")
    };
}

/// Condition under which `oil.temperature` affects more than the outputs `temperature.*`. The flash temperatures of
/// rated teeth are added to it.
const OIL_TEMPERATURE_ACTS: &str = concat!(
    "effects.warm_up = true or effects.strength = true or ",
    over_temperature!("limited_slip"),
    " or ",
    over_temperature!("thrust_friction"),
    " or ",
    oiled!()
);

/// Rows of `material.…`, `oil.…` and `inertia.…`.
pub fn rows() -> Vec<Row<Parameter<Parameters>>> {
    vec![
        row("material.young_modulus", "Young's modulus of both gears").when("scene.gear_contact != ideal").real(
            (units::PASCAL, MPA),
            (1e8, 1e13),
            |p| &mut p.material.young_modulus,
        ),
        row("material.poisson_ratio", "Poisson's ratio of both gears").when("scene.gear_contact != ideal").real(
            units::ONE,
            (0.0, 0.499),
            |p| &mut p.material.poisson_ratio,
        ),
        row("material.density", "Density of the gears")
            .real(units::KG_PER_M3, (100.0, 3e4), |p| &mut p.material.density),
        row(
            "oil.temperature",
            "Temperature of the oil and of all friction surfaces in it; with effects.warm_up, the temperature at \
             the start or of a given sump",
        )
        .tunable()
        .when("effects.warm_up = false or warm_up.sump_given = true or initialisation")
        .acts_when(OIL_TEMPERATURE_ACTS)
        .real((units::KELVIN, DEG_C), units::TEMPERATURES, |p| &mut p.oil.temperature),
        row("oil.viscosity_40", "Kinematic viscosity of the oil at 40 degC").when(OILED).real(
            (units::M2_PER_S, MM2_PER_S),
            (1e-6, 0.1),
            |p| &mut p.oil.viscosity_40,
        ),
        row("oil.viscosity_100", "Kinematic viscosity of the oil at 100 degC").when(OILED).real(
            (units::M2_PER_S, MM2_PER_S),
            (1e-6, 0.1),
            |p| &mut p.oil.viscosity_100,
        ),
        row("oil.density", "Density of the oil at 15 degC")
            .when(DENSE)
            .real(units::KG_PER_M3, (1.0, 1e5), |p| &mut p.oil.density),
        row("oil.density_fall", "Decrease of the oil density per temperature").when(DENSE).real(
            units::KG_PER_M3_K,
            (0.0, 1e3),
            |p| &mut p.oil.density_fall,
        ),
        row("inertia.from_geometry", "Inertias of side gears and planets from their geometry; false: given values")
            .switch(|p| &mut p.inertia.from_geometry),
        row("inertia.carrier", "Inertia of the carrier with ring gear and cross-shaft, without planets").real(
            units::KG_M2,
            (1e-9, 1e6),
            |p| &mut p.inertia.carrier,
        ),
        row("inertia.side_gear", "Inertia of a side gear about its axis, if not from geometry")
            .when("inertia.from_geometry = false")
            .real(units::KG_M2, (1e-12, 1e6), |p| &mut p.inertia.side_gear),
        row(
            "inertia.side_gear_mass",
            "Mass of a side gear for its axial motion, if not from geometry; 0 = geometry.side_mass",
        )
        .when("inertia.from_geometry = false and effects.pin_compliance = true")
        .real(units::KILOGRAM, (0.0, 1e6), |p| &mut p.inertia.side_gear_mass),
        row("inertia.planet", "Inertia of a planet about its axis, if not from geometry")
            .when("inertia.from_geometry = false")
            .real(units::KG_M2, (1e-12, 1e6), |p| &mut p.inertia.planet),
        row(
            "inertia.left_end",
            "Inertia at the wheel side of the left half-shaft; fixed to the side gear without effects.half_shaft",
        )
        .real(units::KG_M2, (0.0, 1e6), |p| &mut p.inertia.left_end),
        row(
            "inertia.right_end",
            "Inertia at the wheel side of the right half-shaft; fixed to the side gear without effects.half_shaft",
        )
        .real(units::KG_M2, (0.0, 1e6), |p| &mut p.inertia.right_end),
    ]
}
