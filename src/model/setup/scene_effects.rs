//! Effects of a scene: checks, requirements and actions of all effects that are on.

use super::effect_outputs::{body_index, heat_index};
use crate::model::effect_kinds::{
    Actuator, BUILT, BodyEffect, Changes, Effect, EffectSetting, FlankFriction, Instant, RubbingSurface, ToothEffects,
};
use crate::model::effects::{EffectEntry, EffectParameters, Effects, configured};
use crate::model::scene::{ACTUATED, Plan, Requests};
use crate::problem::Problem;

/// Effects of a scene.
#[derive(Clone, Copy)]
pub struct SceneEffects<'a> {
    /// Switches.
    pub effects: &'a Effects,
    /// Parameters.
    pub parameters: &'a EffectParameters,
    /// The scene.
    pub setting: EffectSetting<'a>,
}

impl<'a> SceneEffects<'a> {
    /// Effects that may act, each with its setting.
    fn acting(&self) -> impl Iterator<Item = (&'static EffectEntry, EffectSetting<'a>, &'a dyn Effect)> + use<'a> {
        let setting = self.setting;
        configured(self.effects, self.parameters)
            .into_iter()
            .filter(|(entry, on, _)| BUILT && (*on || entry.may_act_unswitched))
            .map(move |(entry, on, effect)| {
                (
                    entry,
                    EffectSetting { on, heat_index: heat_index(entry.heat), body_index: body_index(entry), ..setting },
                    effect,
                )
            })
    }

    /// Problems of the effects in this scene.
    pub fn problems(&self) -> Vec<Problem> {
        let mut found = Vec::new();
        for (entry, on, _) in configured(self.effects, self.parameters) {
            if let (false, true, Some(switch)) = (BUILT, on, entry.switch) {
                found.push(Problem::new(switch, "this build has no effects; switch it off or use a full build"));
            }
        }
        let contact = self.setting.scene.gear_contact;
        for (entry, setting, effect) in self.acting() {
            if let (Some(needs), Some(switch)) = (entry.needs, entry.switch)
                && !needs.contacts.contains(&contact)
            {
                let contacts: Vec<&str> = needs.contacts.iter().map(|contact| contact.literal()).collect();
                found.push(problem!(
                    switch,
                    "does not work with scene.gear_contact = {}: {}; it needs scene.gear_contact = {}",
                    contact.literal(),
                    needs.why,
                    contacts.join(" or ")
                ));
            }
            if let (Some(needed), Some(switch)) = (entry.needs_effect, entry.switch)
                && !self.effects.active().any(|name| name == needed)
            {
                found.push(problem!(switch, "needs {needed}: set {needed} = true, or switch {switch} off"));
            }
            effect.check(&setting, &mut found);
        }
        found
    }

    /// Warnings about the effects in this scene.
    pub fn warnings(&self) -> Vec<Problem> {
        self.acting().flat_map(|(_, setting, effect)| effect.warnings(&setting)).collect()
    }

    /// Influence of the effects on single teeth. Fails if their parameters contradict the gears.
    pub fn on_teeth(&self) -> Result<ToothEffects, Problem> {
        let mut teeth = ToothEffects::default();
        for (_, setting, effect) in self.acting() {
            effect.on_teeth(&setting, &mut teeth)?;
        }
        Ok(teeth)
    }

    /// Requirements of the effects for the plan.
    pub fn requests(&self) -> Requests {
        self.acting().fold(Requests::default(), |all, (_, setting, effect)| {
            let request = effect.requests(&setting);
            Requests {
                individual: all.individual || request.individual,
                pins: all.pins || request.pins,
                shafts: [0, 1].map(|s| all.shafts[s] || request.shafts[s]),
                attached: std::array::from_fn(|k| all.attached[k].or(request.attached[k])),
                drive_ratio: all.drive_ratio.or(request.drive_ratio),
                on_carrier: all.on_carrier + request.on_carrier,
                turns: all.turns.max(request.turns),
                dogs: [0, 1].map(|s| all.dogs[s].or(request.dogs[s])),
                clutch_ratio: [0, 1].map(|s| all.clutch_ratio[s].or(request.clutch_ratio[s])),
            }
        })
    }

    /// Forces and torques on bodies, other than dry friction.
    pub fn on_bodies(&self, plan: &Plan) -> Vec<Box<dyn BodyEffect>> {
        self.acting().filter_map(|(_, setting, effect)| effect.on_bodies(&setting, plan)).collect()
    }

    /// Friction along the flanks, if any effect adds it.
    pub fn on_flanks(&self) -> Option<FlankFriction> {
        self.acting().find_map(|(_, setting, effect)| effect.on_flanks(&setting))
    }

    /// True if any effect depends on the viscosity of the oil.
    pub fn oil_acts(&self) -> bool {
        self.acting().any(|(_, _, effect)| effect.is_oiled())
    }

    /// Actuators that commands pass.
    pub fn actuators(&self) -> [Option<Actuator>; ACTUATED] {
        let mut all = [None; ACTUATED];
        for (_, _, effect) in self.acting() {
            if let Some((actuator, commands)) =
                effect.actuator().map(|(of, commands)| (of.effective(), commands)).filter(|(of, _)| !of.is_direct())
            {
                commands.iter().for_each(|&k| all[k] = Some(actuator));
            }
        }
        all
    }

    /// Replaces `surfaces` by those with dry friction.
    pub fn set_surfaces(&self, surfaces: &mut Vec<RubbingSurface>) {
        surfaces.clear();
        for (entry, setting, effect) in self.acting() {
            let before = surfaces.len();
            effect.add_surfaces(&setting, surfaces);
            surfaces[before..].iter_mut().for_each(|surface| surface.effect = entry.name);
        }
        RubbingSurface::remove_replaced(surfaces);
    }
}

/// Sets the readings of all effects that change at any instant.
pub fn read(effects: &Effects, parameters: &EffectParameters, at: &Instant, out: &mut [f64]) {
    let mut out = out.iter_mut();
    for (entry, on, effect) in configured(effects, parameters) {
        for reading in entry.readings.iter().filter(|reading| reading.changes == Changes::Always) {
            if let (Some(out), Some(read)) = (out.next(), reading.read) {
                *out = read(effect, &Instant { on, ..*at });
            }
        }
    }
}
