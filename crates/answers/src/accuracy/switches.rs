//! What a plainer model may leave out: effects, and refinements of the models of effects. The status of each in a scene.

use bevel_differential::model::effects::EffectEntry;
use bevel_differential::model::{Class, EFFECTS, Inputs, Parameters};
use bevel_differential::problem::Problem;
use bevel_differential::variables::effective::{self, Situation};
use bevel_differential::variables::{Access, Causality, Variable, assign, index_of, named, table, value_of};

use crate::scene::Scene;
use crate::scene::acting::acts;
use crate::scene::run::SceneRun;

/// Common prefix of the switches of effects.
const PREFIX: &str = "effects.";

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
    /// A refinement that the scene does not have.
    Plain,
}

/// An effect, or a refinement of its model.
#[derive(Clone, Copy)]
pub struct Switch {
    name: &'static str,
    kind: Kind,
}

#[derive(Clone, Copy)]
enum Kind {
    /// Effect with its switch. Backlash and corner contact have no entry in the list of effects.
    Effect(&'static Variable, Option<&'static EffectEntry>),
    /// Refinement with its parameters and their values in the plainer model.
    Refinement(&'static [(&'static str, f64)]),
}

/// A scene without the effects that do not fit it.
#[derive(Clone)]
pub struct Settled {
    /// The scene.
    pub scene: Scene,
    /// Effects that were left out.
    pub without: Vec<&'static str>,
}

/// All effects of the table of variables, and all refinements.
pub fn effects() -> impl Iterator<Item = Switch> {
    let rows = table().rows.iter().filter(|row| matches!(row.access, Access::Boolean(_)));
    let effects = rows.filter_map(|row| {
        let entry = EFFECTS.iter().find(|effect| effect.switch == Some(row.name));
        Some(Switch { name: row.name.strip_prefix(PREFIX)?, kind: Kind::Effect(row, entry) })
    });
    let refinements = EFFECTS.iter().flat_map(|effect| effect.refinements);
    effects.chain(refinements.map(|part| Switch { name: part.name, kind: Kind::Refinement(part.plain) }))
}

impl Switch {
    /// Short name.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// True for the elastic gear bodies, which are part of a level ([`super::gears`]).
    pub fn is_bodies(&self) -> bool {
        self.name() == "body_compliance"
    }

    /// True if the effect is on in `p`, or the refinement acts.
    pub fn is_on(&self, p: &Parameters) -> bool {
        match self.kind {
            Kind::Effect(row, _) => value_of(row, p, &Inputs::ZERO) == Some(1.0),
            Kind::Refinement(plain) => plain.iter().any(|&(name, value)| {
                named(name).is_some_and(|row| value_of(row, p, &Inputs::ZERO) != Some(value))
                    && index_of(name).is_some_and(|index| effective::acts(index, p, Situation::START))
            }),
        }
    }

    /// Switches the effect in `p`, or leaves out the refinement. Nothing adds a refinement.
    pub fn set(&self, p: &mut Parameters, on: bool) {
        match self.kind {
            Kind::Effect(row, _) => {
                if let Access::Boolean(access) = row.access {
                    *access(p) = on;
                }
            }
            Kind::Refinement(plain) => {
                for (row, value) in plain.iter().filter_map(|&(name, value)| Some((named(name)?, value))) {
                    // plain values are within their ranges
                    let fits = assign(row, value, p, &mut Inputs::default());
                    debug_assert_eq!((on, fits), (false, Ok(())));
                }
            }
        }
    }

    /// Entry of the effect in the list of effects.
    fn entry(&self) -> Option<&'static EffectEntry> {
        if let Kind::Effect(_, entry) = self.kind { entry } else { None }
    }

    /// Meaning of the effect for the question.
    fn class(&self) -> Class {
        self.entry().map_or(Class::Refinement, |effect| effect.class)
    }

    /// Variable of the switch.
    fn row(&self) -> Option<&'static Variable> {
        if let Kind::Effect(row, _) = self.kind { Some(row) } else { None }
    }

    /// Input that commands `scene` and has no influence without this part of the machine. The scene without it is another
    /// question.
    pub fn commands(&self, scene: &Scene) -> Option<&'static str> {
        if self.class() != Class::Machine {
            return None;
        }
        let off = self.turned(scene, false);
        let set = scene.settings.iter().map(|setting| setting.row);
        let inputs = set.chain(scene.input_tables.iter().map(|table| table.row));
        let mut inputs = inputs.filter(|row| row.causality == Causality::Input);
        inputs.find(|row| acts(row, scene, Situation::START) && !acts(row, &off, Situation::START)).map(|row| row.name)
    }

    /// Status of the effect in `scene`.
    pub fn status(&self, scene: &Scene) -> Status {
        if self.only_gives_outputs() && !self.is_asked_for(&scene.outputs) {
            Status::NotAsked
        } else if self.is_on(&scene.parameters) {
            Status::On
        } else if self.row().is_some_and(|row| scene.settings.iter().any(|setting| setting.row.name == row.name)) {
            Status::SetOff
        } else if self.row().is_none() {
            Status::Plain
        } else if self.class() == Class::Machine {
            Status::NotInScene
        } else {
            Status::Off
        }
    }

    fn only_gives_outputs(&self) -> bool {
        self.class() == Class::Outputs
    }

    /// True if the effect only adds outputs and `outputs` contains one of them.
    pub fn is_asked_for(&self, outputs: &[&Variable]) -> bool {
        let own = self.entry().filter(|_| self.only_gives_outputs()).map_or(&[][..], |effect| effect.readings);
        own.iter().any(|own| outputs.iter().any(|output| output.name == own.name))
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
        let examples = self.entry().map_or(&[][..], |effect| effect.example);
        let examples = examples.iter().filter_map(|&(name, value)| Some((named(name)?, value)));
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
        let named = |switch: &Switch| {
            switch.row().is_some_and(|row| problems.iter().any(|problem| problem.variable == row.name))
        };
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
