//! What can be switched in a scene: the effects of the table of variables, and the levels of tooth contact.

use bevel_differential::model::Parameters;
use bevel_differential::problem::Problem;
use bevel_differential::variables::{Access, Choice, Variable, table};

use crate::gears::scene::Scene;
use crate::gears::scene::run::SceneRun;

/// Beginning of the names of all switches.
const PREFIX: &str = "effects.";
/// The level of tooth contact.
const LEVEL: &str = "scene.gear_contact";

/// Effects that say what is built in, broken or driven, and not how closely it is looked at: whether a differential has
/// clutch packs or a broken tooth, and how it is excited, is part of the question. They are not put into a scene that
/// does not have them.
const PART_OF_THE_QUESTION: [&str; 4] =
    ["effects.limited_slip", "effects.tooth_fault", "effects.final_drive", "effects.wheel_brake"];

/// Effects that change no motion and only give outputs, with the beginnings of the names of those. Zero is an answer of
/// theirs, such as a damage of 0, and differs from not asking.
const ONLY_TELL: [(&str, &[&str]); 1] = [("effects.strength", &["stress.", "damage."])];

/// One thing to switch.
#[derive(Clone, Copy)]
pub enum Switch {
    /// An effect.
    Effect(&'static Variable),
    /// A level of tooth contact below that of the scene.
    Level(Choice),
}

/// How a scene stands to an effect.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// On.
    On,
    /// Off, as it is unless switched on.
    Off,
    /// Set off by the scene: its author says that it is not there.
    SetOff,
    /// Off, and part of the question.
    NotThere,
}

impl Switch {
    /// Short name: that of the variable without its beginning, or of the level.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Effect(row) => row.name.strip_prefix(PREFIX).unwrap_or(row.name),
            Self::Level(choice) => choice.name,
        }
    }

    /// Whether the effect is on in `p`; a lower level is never.
    pub fn is_on(&self, p: &Parameters) -> bool {
        match self {
            Self::Effect(row) => value(row, p),
            Self::Level(_) => false,
        }
    }

    /// How `scene` stands to it.
    pub fn standing(&self, scene: &Scene) -> Standing {
        let Self::Effect(row) = self else { return Standing::Off };
        if self.is_on(&scene.parameters) {
            Standing::On
        } else if scene.settings.iter().any(|setting| setting.row.name == row.name) {
            Standing::SetOff
        } else if PART_OF_THE_QUESTION.contains(&row.name) {
            Standing::NotThere
        } else {
            Standing::Off
        }
    }

    /// Whether it only gives outputs, and `outputs` ask for one of them.
    pub fn is_asked_for(&self, outputs: &[&Variable]) -> bool {
        let Self::Effect(row) = self else { return false };
        let own = ONLY_TELL.iter().filter(|(name, _)| *name == row.name).flat_map(|(_, own)| own.iter());
        own.into_iter().any(|own| outputs.iter().any(|output| output.name.starts_with(own)))
    }

    /// `scene` with this effect the other way round, or on this level without what the level does not know.
    pub fn turned(&self, scene: &Scene) -> Result<Turned, Vec<Problem>> {
        match self {
            Self::Effect(row) => {
                let turned = with(scene, row, !self.is_on(&scene.parameters));
                SceneRun::attempt(&turned, turned.step)?;
                Ok(Turned { scene: turned, without: Vec::new() })
            }
            Self::Level(choice) => on_level(scene, choice.value),
        }
    }
}

/// A scene with something switched.
#[derive(Clone)]
pub struct Turned {
    /// The scene.
    pub scene: Scene,
    /// Effects that went with it, as they are refused together.
    pub without: Vec<&'static str>,
}

/// All effects of the table of variables.
pub fn effects() -> impl Iterator<Item = Switch> {
    let rows = table().rows.iter();
    rows.filter(|row| row.name.starts_with(PREFIX) && matches!(row.access, Access::Boolean(_))).map(Switch::Effect)
}

/// Levels of tooth contact below that of `scene`, the plainest first.
pub fn levels(scene: &Scene) -> Vec<Switch> {
    let Some((row, present)) = level(&scene.parameters) else { return Vec::new() };
    let Access::Enumeration(kind, ..) = row.access else { return Vec::new() };
    kind.choices.iter().filter(|choice| choice.value < present).map(|&choice| Switch::Level(choice)).collect()
}

/// Name of the level of `p`, as a file says it.
pub fn level_name(p: &Parameters) -> &'static str {
    level(p).and_then(|(row, value)| crate::gears::scene::set::literal(row, value)).map_or("", |(name, _)| name)
}

/// Name of the variable that holds the level.
pub fn level_variable() -> &'static str {
    LEVEL
}

/// `scene` with an effect on or off.
pub fn with(scene: &Scene, row: &Variable, on: bool) -> Scene {
    let mut scene = scene.clone();
    if let Access::Boolean(access) = row.access {
        *access(&mut scene.parameters) = on;
    }
    scene
}

/// `scene` with all effects on that it allows, and those that it refuses.
pub fn fullest(scene: &Scene) -> (Scene, Vec<(Switch, Vec<Problem>)>) {
    let (mut full, mut refused) = (scene.clone(), Vec::new());
    for switch in effects().filter(|switch| switch.standing(scene) == Standing::Off) {
        match switch.turned(&full) {
            Ok(turned) => full = turned.scene,
            Err(problems) => refused.push((switch, problems)),
        }
    }
    (full, refused)
}

fn level(p: &Parameters) -> Option<(&'static Variable, i32)> {
    let row = table().rows.iter().find(|row| row.name == LEVEL)?;
    let Access::Enumeration(_, get, _) = row.access else { return None };
    Some((row, get(p)))
}

/// Effects that the level refuses by name are switched off; what else it refuses is told.
fn on_level(scene: &Scene, value: i32) -> Result<Turned, Vec<Problem>> {
    let mut turned = Turned { scene: scene.clone(), without: Vec::new() };
    if let Some((Variable { access: Access::Enumeration(.., set), .. }, _)) = level(&scene.parameters) {
        set(&mut turned.scene.parameters, value);
    }
    loop {
        let Err(problems) = SceneRun::attempt(&turned.scene, turned.scene.step) else { return Ok(turned) };
        let named =
            |switch: &Switch| matches!(switch, Switch::Effect(row) if problems.iter().any(|p| p.variable == row.name));
        let known: Vec<Switch> = effects().filter(|s| named(s) && s.is_on(&turned.scene.parameters)).collect();
        if known.is_empty() {
            return Err(problems);
        }
        for switch in known {
            if let Switch::Effect(row) = switch {
                turned.scene = with(&turned.scene, row, false);
                turned.without.push(switch.name());
            }
        }
    }
}

fn value(row: &Variable, p: &Parameters) -> bool {
    // the table gives access to what it may change
    let mut p = *p;
    match row.access {
        Access::Boolean(access) => *access(&mut p),
        _ => false,
    }
}
