//! Causes of many steps: rattle, dry friction that switches all the time, or a criterion that keeps rejecting steps.

use super::{hints, six_digits};
use crate::declaration::SIDES;
use crate::integrate::{Point, SecondOrder, Statistics};
use crate::model::assembly::BodyEffects;
use crate::model::assembly::{Gears, Model};
use crate::model::dynamics::rattle::Rattle;
use crate::model::dynamics::with_equations;
use crate::model::dynamics::{FrictionEquations, State};
use crate::model::effect_kinds::Mode;
use crate::model::scene::{CARRIER, GearContact, Inputs, Layout, PAIRS, RubbingKind};
use crate::model::setup::{ATTACHED, Parameters};
use crate::problem::Problem;

/// Number of steps below which rattle is not reported. A start stays below it.
const FEW_STEPS: u64 = 10_000;
/// Number of impacts below which rattle is not reported. A start, or a few reversals of the torque, stay below it.
const FEW_IMPACTS: u64 = 100;

/// Number of switches of dry friction below which they are not reported. Judder of a car stays below it.
const FEW_SWITCHES: u32 = 1_000;
/// Number of steps per switch above which switches do not determine the number of steps.
const STEPS_PER_SWITCH: u64 = 20;

/// Returns a warning if most steps were spent on rattle, with their number and a remedy.
pub fn rattle_warning(model: &Model, state: &State) -> Option<Problem> {
    let (Rattle { impacts, steps, .. }, all) = (state.rattle, state.statistics.accepted);
    if all < FEW_STEPS || impacts < FEW_IMPACTS || 2 * steps < all {
        return None;
    }
    Some(problem!(
        "solver.steps",
        "{:.0} percent of the {all} steps so far went into rattle: unloaded flanks have touched again {impacts} times; \
         {}; reported once",
        100.0 * steps as f64 / all as f64,
        what_ends_rattle(&model.parameters)
    ))
}

/// Remedy for rattle: friction or drag that the scene lacks, or more of it.
fn what_ends_rattle(p: &Parameters) -> &'static str {
    let washers = p.scene.gear_contact != GearContact::Solid;
    let bearings = p.effects.bearing_drag && p.specs.bearing_drag.carrier_torque > 0.0;
    match (washers && !p.effects.thrust_friction, !bearings) {
        (true, true) => {
            "real planets and carriers are braked by washers, pins and bearings, which end the rattle: \
             effects.thrust_friction = true, and effects.bearing_drag = true with bearing_drag.carrier_torque"
        }
        (true, false) => "friction of washers and pins ends the rattle of planets: effects.thrust_friction = true",
        (false, true) => {
            "drag of the carrier's bearings ends the rattle: effects.bearing_drag = true with bearing_drag.carrier_torque"
        }
        (false, false) => {
            "more drag ends the rattle sooner: raise bearing_drag.carrier_torque and bearing_drag.side_torque"
        }
    }
}

/// Returns a warning if dry friction switches so often that this determines the number of steps. It names the spring
/// that winds up least, and a remedy.
pub fn chatter_warning(model: &Model, inputs: &Inputs, state: &State) -> Option<Problem> {
    let (switches, all) = (state.events.count(), state.statistics.accepted);
    if all < FEW_STEPS || switches < FEW_SWITCHES || all > STEPS_PER_SWITCH * u64::from(switches) {
        return None;
    }
    with_equations!(model, state, inputs, |equations| {
        let at: Point<N> = state.point();
        let torques = equations.friction_torques(&at);
        let wound = |number: usize| (torques[number] / state.friction[number].stiffness).abs();
        let acts = |number: &usize| state.friction[*number].stiffness > 0.0 && torques[*number] != 0.0;
        let number = (0..PAIRS).filter(acts).min_by(|&i, &j| wound(i).total_cmp(&wound(j)))?;
        let kind = RubbingKind::of(number).0;
        let on_it = model.body_effects().surfaces.iter().filter(|surface| surface.kind == kind);
        let effect = on_it.max_by(|a, b| a.stiffness.total_cmp(&b.stiffness))?.effect;
        Some(problem!(
            "solver.steps",
            "{switches} times within the {all} steps so far, dry friction has broken away or stuck: the spring with which \
             {effect} holds {} winds up by only {:.1e} rad at {} N.m, so that both alternate quickly; real parts yield more: \
             lower the stiffness of {effect}; reported once",
            model.ideal.plan.rubbing_body(number),
            wound(number),
            six_digits(torques[number].abs())
        ))
    })
}

/// Returns the reason for too many steps: the criterion that rejected most steps since the counts `before`, and the
/// body whose motion changes fastest, with the dry friction on it.
pub fn too_many_steps(model: &Model, inputs: &Inputs, state: &State, before: &Statistics) -> String {
    let now = &state.statistics;
    let rejected = [
        (now.rejected_error - before.rejected_error, "because their error was too large"),
        (now.rejected_ledger - before.rejected_ledger, "because their energy ledger did not close"),
        (now.rejected_invalid - before.rejected_invalid, "because a value was not finite"),
        (now.rejected_switch - before.rejected_switch, "because dry friction switched within them"),
    ];
    let (most, why) = rejected.into_iter().max_by_key(|(count, _)| *count).unwrap_or_default();
    let accepted = now.accepted - before.accepted;
    let all = accepted + rejected.iter().map(|(count, _)| count).sum::<u64>();
    let fastest = fastest(model, inputs, state);
    if most >= accepted {
        format!("{most} of the last {all} were rejected {why}; {fastest}")
    } else {
        let size = state.control.last;
        format!("{accepted} of the last {all} were accepted, the last one with a size of {size:.1e} s; {fastest}")
    }
}

/// Body whose velocity changes fastest in the weights of the error norm, with its motion and its friction.
fn fastest(model: &Model, inputs: &Inputs, state: &State) -> String {
    with_equations!(model, state, inputs, |equations| {
        let at: Point<N> = state.point();
        let (rates, weights) = (equations.evaluate(&at).0, equations.weights(&at).v);
        let change = |i: usize| (rates[i] * weights[i]).abs();
        let Some(i) = (0..equations.degrees_of_freedom()).max_by(|&i, &j| change(i).total_cmp(&change(j))) else {
            return String::new();
        };
        let layout = equations.layout();
        let (name, unit) = name_of(layout, i);
        format!(
            "the motion of {name} changes fastest: {:.1e} {unit}/s and {:.1e} {unit}/s²{}",
            at.v[i],
            rates[i],
            friction_on(model.body_effects(), state, i)
        )
    })
}

/// Name of the body of degree of freedom `i`, and the unit of its position.
fn name_of(layout: &Layout, i: usize) -> (String, &'static str) {
    let mut attached = ATTACHED.iter().enumerate();
    if let Some((_, body)) = attached.find(|&(k, _)| layout.attached[k].is_some() && layout.body(k) == i) {
        return (body.name.into(), "rad");
    }
    let planets = layout.planet(0)..layout.planet(0) + layout.groups;
    let name = match i {
        0 | 1 => format!("the {} side gear", SIDES[i]),
        CARRIER => "the carrier".into(),
        _ if planets.contains(&i) => format!("planet group {}", i - planets.start + 1),
        _ if layout.has_pins && i < planets.start => {
            return (format!("the {} axial seat", SIDES[i - layout.seat(0)]), "m");
        }
        _ => format!("the pins of planet group {}", i - planets.end + 1),
    };
    (name, "rad")
}

/// Names the dry friction that holds or brakes the body of degree of freedom `i`. Empty if none acts.
fn friction_on(effects: &BodyEffects, state: &State, i: usize) -> String {
    let acting = effects.pairs.iter().flatten().filter(|pair| state.friction[pair.number].stiffness > 0.0);
    acting
        .filter(|pair| pair.body == i)
        .map(|pair| {
            let does = if state.friction[pair.number].mode == Mode::Stuck { "holds" } else { "brakes" };
            let kind = RubbingKind::of(pair.number).0;
            let holding = effects.surfaces.iter().filter(|surface| surface.kind == kind && surface.stiffness > 0.0);
            let names: Vec<&str> = holding.map(|surface| surface.effect).collect();
            format!("; {} {does} it", names.join(" or "))
        })
        .collect()
}

/// Remedy for too many attempted steps.
pub fn fewer_steps(model: &Model, state: &State) -> String {
    let has_teeth = matches!(model.gears, Gears::Teeth(_));
    match rattle_warning(model, state) {
        Some(_) => what_ends_rattle(&model.parameters).into(),
        None if has_teeth => hints::fewer_steps(&model.parameters).into(),
        None => "look at the inputs".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Simulation;
    use crate::model::assembly::Given;
    use crate::model::dynamics::event::Happening;
    use crate::model::scene::{CarrierDrive, Start};

    /// Wheels held by brakes, shortly after a torque on the carrier started to act on them.
    fn held() -> (Model, Inputs, State) {
        let (mut parameters, mut inputs) = (Parameters::default(), Inputs::default());
        (parameters.scene.gear_contact, parameters.scene.start) = (GearContact::Ideal, Start::Rest);
        parameters.scene.carrier_drive = CarrierDrive::Torque;
        parameters.effects.wheel_brake = true;
        (parameters.inertia.left_end, parameters.inertia.right_end) = (1.0, 1.0);
        (inputs.carrier_torque, inputs.load_torque, inputs.brake_torque) = (100.0, [0.0; 2], [200.0; 2]);
        let mut simulation = Simulation::start(&parameters, &inputs, 0.0).unwrap();
        simulation.advance(1e-3).unwrap();
        (Model::new(&parameters, &Given::default()).unwrap(), inputs, *simulation.state())
    }

    #[test]
    fn a_failure_names_the_criterion_the_body_its_motion_and_its_friction() {
        let (model, inputs, mut state) = held();
        state.statistics = Statistics { rejected_ledger: 1002, rejected_error: 3, ..Statistics::default() };
        let text = too_many_steps(&model, &inputs, &state, &Statistics::default());
        assert!(
            text.starts_with("1002 of the last 1005 were rejected because their energy ledger did not close"),
            "{text}"
        );
        assert!(text.contains("the motion of the carrier changes fastest") && text.ends_with("rad/s²"), "{text}");
        assert_eq!(friction_on(model.body_effects(), &state, 1), "; wheel_brake holds it");
        assert_eq!(friction_on(model.body_effects(), &state, CARRIER), "");
        let before = state.statistics;
        state.statistics.accepted += 77;
        let text = too_many_steps(&model, &inputs, &state, &before);
        assert!(text.starts_with("77 of the last 77 were accepted, the last one with a size of"), "{text}");
        assert_eq!(fewer_steps(&model, &state), "look at the inputs");
    }

    #[test]
    fn friction_that_switches_all_the_time_is_reported_with_its_spring() {
        let (model, inputs, mut state) = held();
        state.statistics.accepted = 20_000;
        assert_eq!(chatter_warning(&model, &inputs, &state), None);
        (0..2_000).for_each(|k| state.events.record(Happening::WheelStops, 1, f64::from(k)));
        let switches = state.events.count();
        let warning = chatter_warning(&model, &inputs, &state).unwrap().to_string();
        let begin =
            format!("solver.steps: {switches} times within the 20000 steps so far, dry friction has broken away");
        assert!(warning.starts_with(&begin), "{warning}");
        assert!(warning.contains("wheel_brake holds the "), "{warning}");
        assert!(warning.contains("lower the stiffness of wheel_brake;"), "{warning}");
        // judder of a car, whose vibrations take most of the steps
        state.statistics.accepted = 100_000;
        assert_eq!(chatter_warning(&model, &inputs, &state), None);
    }

    #[test]
    fn rattle_is_reported_if_most_of_many_steps_are_spent_on_it() {
        let (model, _, mut state) = held();
        (state.statistics.accepted, state.rattle.impacts, state.rattle.steps) = (20_000, 200, 15_000);
        let warning = rattle_warning(&model, &state).unwrap().to_string();
        assert!(warning.starts_with("solver.steps: 75 percent of the 20000 steps"), "{warning}");
        assert!(warning.contains("200 times") && warning.contains("effects.thrust_friction = true"), "{warning}");
        state.rattle.steps = 9_000;
        assert_eq!(rattle_warning(&model, &state), None);
    }
}
