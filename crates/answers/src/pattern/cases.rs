//! Scenes of the contact pattern: the study's turn with solid teeth, aligned and with one deviation at a time.

use std::path::Path;

use anyhow::Result;
use bevel_differential::contact::errors::ToothErrorSpec;

use crate::scene::{Scene, load};

/// The turn of the study. The tolerance is sufficient because the motion is almost static.
const TURN: &str = r#"
description = "the study's turn with solid teeth"
stop_time = 0.7
step = 1e-3
outputs = ["left.speed"]

[set]
carrier.speed_command = "954 deg/s"
scene.planet_spin = "imposed"
spin.command = "200 deg/s"
left.load_torque = "835 N.m"
right.load_torque = "835 N.m"
scene.start = "equilibrium"
scene.gear_contact = "solid"
solver.relative_tolerance = 1e-4
"#;

/// Offset in the figure [m].
pub const OFFSET: f64 = 1e-4;
/// Offset of the pins at which every planet keeps its share of the load [m].
pub const SMALL: f64 = 3e-5;
/// Error of the shaft angle in the figure [rad].
pub const ANGLE: f64 = 0.2 * std::f64::consts::PI / 180.0;
/// Crowning in the figure [m].
pub const CROWNING: f64 = 20e-6;

/// Cases of a quick answer: aligned, and one for each kind of deviation.
pub const QUICK: [&str; 4] = ["aligned", "crowned", "angle_wide", "planet_out"];

/// A scene with its names in files and figures.
#[derive(Clone)]
pub struct PatternCase {
    /// Name in files.
    pub name: String,
    /// Title in the figure.
    pub title: String,
    /// The scene.
    pub scene: Scene,
}

impl PatternCase {
    /// Case of a user's scene.
    pub fn of(scene: Scene) -> Self {
        Self { name: scene.name.clone(), title: scene.name.clone(), scene }
    }
}

/// Scene of the turn with the given errors.
pub fn turn(errors: &ToothErrorSpec) -> Result<Scene> {
    let mut scene = load::parse("turn", Path::new("turn.toml"), TURN)?;
    scene.parameters.effects.tooth_errors = *errors != ToothErrorSpec::default();
    scene.parameters.specs.tooth_errors = *errors;
    Ok(scene)
}

/// Cases of the documentation.
pub fn all() -> Result<Vec<PatternCase>> {
    let none = ToothErrorSpec::default();
    [
        ("aligned", "aligned", none),
        ("crowned", "crowned by 20 µm", ToothErrorSpec { crowning: CROWNING, ..none }),
        ("angle_wide", "shaft angle + 0.2°", ToothErrorSpec { shaft_angle_error: ANGLE, ..none }),
        ("angle_narrow", "shaft angle − 0.2°", ToothErrorSpec { shaft_angle_error: -ANGLE, ..none }),
        ("planet_out", "planet 0.1 mm outward", ToothErrorSpec { planet_axial_offset: OFFSET, ..none }),
        ("planet_in", "planet 0.1 mm inward", ToothErrorSpec { planet_axial_offset: -OFFSET, ..none }),
        ("side_out", "side gear 0.1 mm outward", ToothErrorSpec { side_axial_offset: OFFSET, ..none }),
        ("side_in", "side gear 0.1 mm inward", ToothErrorSpec { side_axial_offset: -OFFSET, ..none }),
        ("pin_ahead", "pin 0.03 mm forward", ToothErrorSpec { axis_offset: SMALL, ..none }),
        ("pin_behind", "pin 0.03 mm backward", ToothErrorSpec { axis_offset: -SMALL, ..none }),
        ("hypoid_forward", "pin 0.1 mm forward", ToothErrorSpec { axis_offset: OFFSET, ..none }),
        ("hypoid_backward", "pin 0.1 mm backward", ToothErrorSpec { axis_offset: -OFFSET, ..none }),
    ]
    .into_iter()
    .map(|(name, title, errors)| Ok(PatternCase { name: name.into(), title: title.into(), scene: turn(&errors)? }))
    .collect()
}
