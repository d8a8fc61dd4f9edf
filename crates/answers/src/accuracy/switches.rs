//! Effects that a scene may switch, and the status of each in the scene.

use bevel_differential::model::{EFFECTS, Inputs, Parameters};
use bevel_differential::problem::Problem;
use bevel_differential::variables::effective::Situation;
use bevel_differential::variables::{Access, Variable, named, table, value_of};

use crate::scene::Scene;
use crate::scene::acting::acts;
use crate::scene::run::SceneRun;

/// Common prefix of all switches.
const PREFIX: &str = "effects.";

/// Effects that say what is built in, broken or driven, rather than how accurately it is modelled. Clutch packs, a
/// broken tooth and the excitation are part of the question, so these effects are not added to a scene without them.
const PART_OF_THE_QUESTION: [&str; 4] =
    ["effects.limited_slip", "effects.tooth_fault", "effects.final_drive", "effects.wheel_brake"];

/// Effects that change no motion and only add outputs, with parts of the names of these outputs. A scene can ask for
/// such an output even if it is zero, such as a damage of 0.
const ONLY_GIVE_OUTPUTS: [(&str, &[&str]); 3] = [
    ("effects.strength", &["stress.", "damage.", "safety."]),
    ("effects.mesh_history", &["_peak_to_peak"]),
    ("effects.coupling_advice", &["coupling."]),
];

/// Status of an effect in a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// On.
    On,
    /// Off because nothing switches it on.
    Off,
    /// Switched off by the scene: its author says that it is not there.
    SetOff,
    /// Off, and part of the question.
    NotInScene,
    /// Only adds outputs, none of which is wanted.
    NotAsked,
}

/// The switch of an effect.
#[derive(Clone, Copy)]
pub struct Switch {
    row: &'static Variable,
}

/// A scene without the effects that do not fit it.
#[derive(Clone)]
pub struct Settled {
    /// The scene.
    pub scene: Scene,
    /// Effects that were left out.
    pub without: Vec<&'static str>,
}

/// All effects of the table of variables.
pub fn effects() -> impl Iterator<Item = Switch> {
    let rows = table().rows.iter();
    rows.filter(|row| row.name.starts_with(PREFIX) && matches!(row.access, Access::Boolean(_)))
        .map(|row| Switch { row })
}

impl Switch {
    /// Short name.
    pub fn name(&self) -> &'static str {
        self.row.name.strip_prefix(PREFIX).unwrap_or(self.row.name)
    }

    /// True for the elastic gear bodies, which are part of a level ([`super::gears`]).
    pub fn is_bodies(&self) -> bool {
        self.name() == "body_compliance"
    }

    /// True if the effect is on in `p`.
    pub fn is_on(&self, p: &Parameters) -> bool {
        value_of(self.row, p, &Inputs::ZERO) == Some(1.0)
    }

    /// Switches the effect in `p`.
    pub fn set(&self, p: &mut Parameters, on: bool) {
        if let Access::Boolean(access) = self.row.access {
            *access(p) = on;
        }
    }

    /// Status of the effect in `scene`.
    pub fn status(&self, scene: &Scene) -> Status {
        if self.only_gives_outputs() && !self.is_asked_for(&scene.outputs) {
            Status::NotAsked
        } else if self.is_on(&scene.parameters) {
            Status::On
        } else if scene.settings.iter().any(|setting| setting.row.name == self.row.name) {
            Status::SetOff
        } else if PART_OF_THE_QUESTION.contains(&self.row.name) {
            Status::NotInScene
        } else {
            Status::Off
        }
    }

    fn only_gives_outputs(&self) -> bool {
        ONLY_GIVE_OUTPUTS.iter().any(|(name, _)| *name == self.row.name)
    }

    /// True if the effect only adds outputs and `outputs` contains one of them.
    pub fn is_asked_for(&self, outputs: &[&Variable]) -> bool {
        let own = ONLY_GIVE_OUTPUTS.iter().filter(|(name, _)| *name == self.row.name).flat_map(|(_, own)| own.iter());
        own.into_iter().any(|own| outputs.iter().any(|output| output.name.contains(own)))
    }

    /// Returns `scene` with this effect on or off.
    pub fn turned(&self, scene: &Scene, on: bool) -> Scene {
        let mut scene = scene.clone();
        self.set(&mut scene.parameters, on);
        scene
    }

    /// Typical values through which the effect would act, with their variables, for those that are zero in the scene.
    /// Empty if the effect acts through other values, such as a clutch without preload that has viscous torque.
    pub fn typical(&self, scene: &Scene) -> Vec<(&'static Variable, f64)> {
        if self.acts_otherwise(scene) {
            return Vec::new();
        }
        let is_shown = |&(row, value): &(&Variable, f64)| is_zero(row, scene) && value != 0.0;
        self.showing(scene).into_iter().filter(is_shown).collect()
    }

    /// True if a value of the effect that is zero at the start of the FMU is not zero in the scene, and takes effect.
    fn acts_otherwise(&self, scene: &Scene) -> bool {
        let own = table().rows.iter().filter(|row| group(row.name) == self.name());
        own.filter(|row| number(row, &Parameters::default(), &Inputs::default()) == Some(0.0))
            .any(|row| !is_zero(row, scene) && acts(row, scene, Situation::START))
    }

    /// True if all values through which the effect would act are zero in the scene.
    pub fn is_at_zero(&self, scene: &Scene) -> bool {
        let showing = self.showing(scene);
        !showing.is_empty() && showing.iter().all(|(row, _)| is_zero(row, scene))
    }

    /// Values through which the effect acts, with their variables.
    fn showing(&self, scene: &Scene) -> Vec<(&'static Variable, f64)> {
        // gear bodies are elastic without bores, too
        if self.is_bodies() {
            return Vec::new();
        }
        let declared = EFFECTS.iter().filter(|effect| effect.switch == Some(self.row.name));
        let examples =
            declared.flat_map(|effect| effect.example).filter_map(|&(name, value)| Some((named(name)?, value)));
        // for a parameter of the effect that the scene sets to zero, the start value is the typical one
        let own = scene.settings.iter().map(|setting| setting.row).filter(|row| group(row.name) == self.name());
        let starts = own.filter_map(|row| Some((row, number(row, &Parameters::default(), &Inputs::default())?)));
        examples.chain(starts).collect()
    }
}

/// True if the value is zero in the scene.
fn is_zero(row: &Variable, scene: &Scene) -> bool {
    number(row, &scene.parameters, &scene.inputs) == Some(0.0)
}

/// Part of a name before its first dot.
fn group(name: &str) -> &str {
    name.split('.').next().unwrap_or(name)
}

/// Value of a real or integer parameter, or of an input at the start.
fn number(row: &Variable, p: &Parameters, i: &Inputs) -> Option<f64> {
    let is_number = !matches!(row.access, Access::Boolean(_) | Access::Enumeration(..));
    value_of(row, p, i).filter(|_| is_number)
}

/// Returns `scene` without the effects that are refused by name, or the other problems of the scene.
pub fn settled(scene: &Scene) -> Result<Settled, Vec<Problem>> {
    let mut settled = Settled { scene: scene.clone(), without: Vec::new() };
    loop {
        let Err(problems) = SceneRun::attempt(&settled.scene, settled.scene.step) else { return Ok(settled) };
        let named = |switch: &Switch| problems.iter().any(|problem| problem.variable == switch.row.name);
        let known: Vec<Switch> = effects().filter(|s| named(s) && s.is_on(&settled.scene.parameters)).collect();
        if known.is_empty() {
            return Err(problems);
        }
        for switch in known {
            switch.set(&mut settled.scene.parameters, false);
            settled.without.push(switch.name());
        }
    }
}
