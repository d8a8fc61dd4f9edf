//! Effects that a scene may switch, and how it stands to each.

use bevel_differential::model::{EFFECTS, Inputs, Parameters};
use bevel_differential::problem::Problem;
use bevel_differential::variables::{Access, Variable, named, table, value_of};

use crate::scene::Scene;
use crate::scene::run::SceneRun;

/// Beginning of the names of all switches.
const PREFIX: &str = "effects.";

/// Effects that say what is built in, broken or driven, and not how closely it is looked at: whether a differential has
/// clutch packs or a broken tooth, and how it is excited, is part of the question. They are not put into a scene that
/// does not have them.
const PART_OF_THE_QUESTION: [&str; 4] =
    ["effects.limited_slip", "effects.tooth_fault", "effects.final_drive", "effects.wheel_brake"];

/// Effects that change no motion and only give outputs, with parts of the names of those. Zero is an answer of
/// theirs, such as a damage of 0, and differs from not asking.
const ONLY_GIVE_OUTPUTS: [(&str, &[&str]); 2] =
    [("effects.strength", &["stress.", "damage.", "safety."]), ("effects.mesh_history", &["_peak_to_peak"])];

/// How a scene stands to an effect.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// On.
    On,
    /// Off, as it is unless switched on.
    Off,
    /// Set off by the scene: its author says that it is not there.
    SetOff,
    /// Off, and part of the question.
    NotInScene,
    /// Only gives outputs, and none of them is wanted.
    NotAsked,
}

/// The switch of an effect.
#[derive(Clone, Copy)]
pub struct Switch {
    row: &'static Variable,
}

/// A scene, and the effects that had to go as they do not go with the rest.
#[derive(Clone)]
pub struct Settled {
    /// The scene.
    pub scene: Scene,
    /// Effects that went.
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

    /// Whether it is that of gear bodies, which go with a law.
    pub fn is_bodies(&self) -> bool {
        self.name() == "body_compliance"
    }

    /// Whether the effect is on in `p`.
    pub fn is_on(&self, p: &Parameters) -> bool {
        value_of(self.row, p, &Inputs::ZERO) == Some(1.0)
    }

    /// Switches the effect in `p`.
    pub fn set(&self, p: &mut Parameters, on: bool) {
        if let Access::Boolean(access) = self.row.access {
            *access(p) = on;
        }
    }

    /// How `scene` stands to it.
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

    /// Whether it only gives outputs, and `outputs` have one of them.
    pub fn is_asked_for(&self, outputs: &[&Variable]) -> bool {
        let own = ONLY_GIVE_OUTPUTS.iter().filter(|(name, _)| *name == self.row.name).flat_map(|(_, own)| own.iter());
        own.into_iter().any(|own| outputs.iter().any(|output| output.name.contains(own)))
    }

    /// `scene` with this effect on or off.
    pub fn turned(&self, scene: &Scene, on: bool) -> Scene {
        let mut scene = scene.clone();
        self.set(&mut scene.parameters, on);
        scene
    }

    /// Values by which the effect would show, with their variables: those that the scene leaves or sets at zero.
    pub fn typical(&self, scene: &Scene) -> Vec<(&'static Variable, f64)> {
        let is_shown = |&(row, value): &(&Variable, f64)| is_zero(row, scene) && value != 0.0;
        self.showing(scene).into_iter().filter(is_shown).collect()
    }

    /// Whether all values by which the effect would show are zero in the scene.
    pub fn is_at_zero(&self, scene: &Scene) -> bool {
        let showing = self.showing(scene);
        !showing.is_empty() && showing.iter().all(|(row, _)| is_zero(row, scene))
    }

    /// Values by which the effect would show, with their variables.
    fn showing(&self, scene: &Scene) -> Vec<(&'static Variable, f64)> {
        // bodies give way without bores, too
        if self.is_bodies() {
            return Vec::new();
        }
        let declared = EFFECTS.iter().filter(|effect| effect.switch == Some(self.row.name));
        let examples =
            declared.flat_map(|effect| effect.example).filter_map(|&(name, value)| Some((named(name)?, value)));
        // an own parameter that the scene sets to zero has its start value for a typical one
        let own = scene.settings.iter().map(|setting| setting.row).filter(|row| group(row.name) == self.name());
        let starts = own.filter_map(|row| Some((row, number(row, &Parameters::default(), &Inputs::default())?)));
        examples.chain(starts).collect()
    }
}

/// Whether a scene leaves or sets a value at zero.
fn is_zero(row: &Variable, scene: &Scene) -> bool {
    number(row, &scene.parameters, &scene.inputs) == Some(0.0)
}

/// The part of a name before its first dot.
fn group(name: &str) -> &str {
    name.split('.').next().unwrap_or(name)
}

/// Value of a real or integer parameter, or of an input at the start.
fn number(row: &Variable, p: &Parameters, i: &Inputs) -> Option<f64> {
    let is_number = !matches!(row.access, Access::Boolean(_) | Access::Enumeration(..));
    value_of(row, p, i).filter(|_| is_number)
}

/// `scene` without the effects that are refused by name beside the rest; or what else is refused.
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
