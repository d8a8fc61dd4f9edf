//! Clutch packs of a scene from the dimensions of their plates and of the ramps that press them.
//!
//! ```toml
//! [clutch]                # or in one line: clutch = { faces = 8, … }
//! faces = 8
//! friction = 0.1
//! inner = "38 mm"
//! outer = "58 mm"
//! ramp_drive = "45 deg"
//! ramp_coast = "60 deg"
//! ramp_radius = "40 mm"
//! spring_force = "800 N"  # without springs, this line may be left out
//! gear_thrust = true      # the side gears press the plates; otherwise, this line may be left out
//! ```
//!
//! With uniform wear, the mean radius of n faces is r_m = (r_i + r_o)/2, and the axial force F gives a pack the torque
//! n μ r_m F. The carrier's torque T pushes the cross-shaft on the ramps with the force T/r. Each of the two pressure
//! rings bears half of it and converts it to the axial force T/(2 r tan β). The torque of a pack is then κ times the
//! mean T/2 of both mesh torques, with κ = n μ r_m/(r tan β). A side gear that presses the plates adds n μ r_m times its
//! thrust.

use std::f64::consts::{FRAC_PI_2, PI};

use bevel_differential::variables::named;
use toml::{Table, Value};

use super::set::{Setting, real};
use super::units;
use super::value::{self, written};
use crate::problem::{Problem, Problems};
use crate::text::near;

/// A ramp is parallel to the axis if its angle differs from 90° by less than this [rad].
const PARALLEL: f64 = 1e-9;
/// Keys, each with a variable of the same unit. All but the last are required.
const KEYS: [(&str, &str); 8] = [
    ("faces", "limited_slip.torque_coefficient"),
    ("friction", "limited_slip.plate_coefficient"),
    ("inner", "limited_slip.mean_radius"),
    ("outer", "limited_slip.mean_radius"),
    ("ramp_drive", "geometry.pressure_angle"),
    ("ramp_coast", "geometry.pressure_angle"),
    ("ramp_radius", "limited_slip.mean_radius"),
    ("spring_force", "planet[1].thrust_force"),
];
/// Key that says if the side gears press the plates.
const GEAR_THRUST: &str = "gear_thrust";

/// Settings of the packs with the dimensions in `table`. Fails with all problems of the dimensions.
pub fn settings(table: &Table) -> Result<Vec<Setting>, Problems> {
    let mut problems = Problems::default();
    let known = || KEYS.map(|(key, _)| key).into_iter().chain([GEAR_THRUST]);
    for key in table.keys().filter(|key| !known().any(|known| known == key.as_str())) {
        let all = known().collect::<Vec<_>>().join(", ");
        problems.push(format!("there is no dimension {key}{}; known: {all}", near::hint(key, known())));
    }
    let missing: Vec<_> = known().take(KEYS.len() - 1).filter(|key| !table.contains_key(*key)).collect();
    if !missing.is_empty() {
        let are = if missing.len() > 1 { "are" } else { "is" };
        problems.push(format!("{} {are} missing", missing.join(", ")));
    }
    let values = KEYS.map(|(key, like)| match table.get(key) {
        Some(value) => dimension(key, value, like).map_err(|problem| problems.push(problem)).unwrap_or(f64::NAN),
        None => 0.0,
    });
    let gear_thrust = match table.get(GEAR_THRUST) {
        None | Some(Value::Boolean(false)) => false,
        Some(Value::Boolean(true)) => true,
        Some(other) => {
            let text = written(other);
            problems.push(Problem::of(
                GEAR_THRUST,
                text.clone(),
                format!("{GEAR_THRUST} = {text}: it must be true or false"),
            ));
            false
        }
    };
    problems.or(())?;
    packs(values, gear_thrust)
}

/// SI value of the dimension `key`, in the unit of the variable `like`.
fn dimension(key: &str, value: &Value, like: &str) -> Result<f64, Problem> {
    let problem = |what: String| Problem::of(key, written(value), format!("{key} = {}: {what}", written(value)));
    let row = named(like).ok_or_else(|| problem(format!("there is no variable {like}")))?;
    if key == "friction" {
        return real(row, value).map_err(problem);
    }
    let number = value::real(value, row.unit.map(|unit| unit.name), false).map_err(problem)?;
    let (is_allowed, allowed) = match key {
        "faces" => (number >= 1.0 && number.fract() == 0.0, "a whole number of 1 or more"),
        "spring_force" => (number >= 0.0, "0 N or more"),
        "ramp_drive" | "ramp_coast" => {
            (number > 0.0 && number <= FRAC_PI_2 + PARALLEL, "above 0 deg and at most 90 deg; numbers are in rad")
        }
        _ => (number > 0.0, "above 0 mm; numbers are in m"),
    };
    if number.is_finite() && is_allowed { Ok(number) } else { Err(problem(format!("it must be {allowed}"))) }
}

/// Settings of the packs from all dimensions, in SI and in the order of `KEYS`. `gear_thrust`: true if the side gears press
/// the plates.
fn packs(
    [faces, friction, inner, outer, drive, coast, lever, spring]: [f64; 8],
    gear_thrust: bool,
) -> Result<Vec<Setting>, Problems> {
    if inner >= outer {
        let [inner, outer] = [inner, outer].map(|radius| units::six_digits(1e3 * radius));
        return Err(Problem::from(format!(
            "inner = {inner} mm is not below outer = {outer} mm; both are radii of the faces, in m if they are numbers"
        ))
        .into());
    }
    let (by_drive, by_coast) = (cotangent(drive), cotangent(coast));
    if by_drive == 0.0 && by_coast > 0.0 {
        let coast = units::six_digits(coast.to_degrees());
        return Err(Problem::from(format!(
            "ramp_drive = 90 deg presses nothing, but ramp_coast = {coast} deg presses the packs: the FMU refers the \
             coast ramps to the drive ramps, so these must press; turn the signs of all torques and speeds of the \
             scene, and exchange ramp_drive and ramp_coast"
        ))
        .into());
    }
    let mean = 0.5 * (inner + outer);
    let per_force = faces * friction * mean;
    let presses = by_drive > 0.0;
    let values: [(&str, Value, &str); 8] = [
        ("effects.limited_slip", true.into(), ""),
        ("limited_slip.preload", (per_force * spring).into(), "faces, friction, inner, outer and spring_force"),
        (
            "limited_slip.torque_coefficient",
            (per_force / lever * by_drive).into(),
            "faces, friction, inner, outer, ramp_drive and ramp_radius",
        ),
        // without any ramp that presses, the start values of both are right
        ("limited_slip.pressed_by", if presses { "both_sides" } else { "own_side" }.into(), ""),
        (
            "limited_slip.coast_ratio",
            if presses { by_coast / by_drive } else { 1.0 }.into(),
            "ramp_drive and ramp_coast",
        ),
        ("limited_slip.mean_radius", mean.into(), "inner and outer"),
        ("limited_slip.friction_area", (faces * PI * (outer * outer - inner * inner)).into(), "faces, inner and outer"),
        ("limited_slip.plate_coefficient", friction.into(), ""),
    ];
    let mut problems = Problems::default();
    let from = |problem: Problem, causes: &str| match causes {
        "" => problem,
        causes => Problem { message: format!("{}; it is calculated from {causes}", problem.message), ..problem },
    };
    let thrust = gear_thrust.then(|| ("limited_slip.thrust_arm", per_force.into(), "faces, friction, inner and outer"));
    let set = values.iter().chain(thrust.iter()).filter_map(|(name, value, causes)| {
        Setting::new(name, value).map_err(|problem| problems.push(from(problem, causes))).ok()
    });
    let set = set.collect();
    problems.or(set)
}

/// 1/tan of the angle of a ramp; exactly 0 at 90°.
fn cotangent(angle: f64) -> f64 {
    if FRAC_PI_2 - angle < PARALLEL { 0.0 } else { 1.0 / angle.tan() }
}
