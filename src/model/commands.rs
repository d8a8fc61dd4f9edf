//! Commands that take effect at the begin of a step: imposed speeds jump, a tooth breaks.

use super::constants::{Gears, Model};
use super::layout::{CARRIER, PLANET};
use super::parameters::Inputs;
use super::state::State;

/// Longest stretch integrated before positions are wrapped [s].
const STRETCH: f64 = 1.0;

/// Where to stop for wrapping positions, or for a tooth that breaks by itself [s].
pub fn end_of_stretch(model: &Model, state: &State, until: f64) -> f64 {
    let time = state.time;
    let end = if until - time > 1.5 * STRETCH { time + STRETCH } else { until };
    let p = &model.parameters;
    let onset = p.tooth_fault.onset;
    let breaks = p.effects.tooth_fault && !state.fault && onset > time && onset < end;
    if breaks { onset } else { end }
}

/// Whether a tooth breaks now, by its time or by the trigger.
pub fn breaks_tooth(model: &Model, inputs: &Inputs, state: &State) -> bool {
    let p = &model.parameters;
    let onset = p.tooth_fault.onset;
    p.effects.tooth_fault && !state.fault && (inputs.fault > 0.5 || onset > 0.0 && state.time >= onset)
}

/// Whether imposed speeds are what they are commanded to be.
pub fn are_followed(model: &Model, inputs: &Inputs, state: &State) -> bool {
    let (plan, layout) = (&model.ideal.plan, &model.layout);
    (!plan.carrier_imposed || state.carrier_command == inputs.carrier_speed)
        && (!plan.spin_imposed || state.v[layout.planet(0)] == inputs.planet_spin)
        && (0..2).all(|s| !plan.side_imposed[s] || state.v[layout.end(s)] == inputs.side_speed[s])
}

/// Sets imposed speeds to their commands and leaves everything else as it is.
pub fn follow(model: &Model, inputs: &Inputs, state: &mut State) {
    state.carrier_command = inputs.carrier_speed;
    let ideal = &model.ideal;
    let (plan, layout) = (&ideal.plan, &model.layout);
    for s in (0..2).filter(|&s| plan.side_imposed[s]) {
        state.v[layout.end(s)] = inputs.side_speed[s];
    }
    if plan.carrier_imposed {
        state.v[CARRIER] = match &model.gears {
            Gears::Rigid(rigid) => rigid.carrier_speed(state, inputs.carrier_speed),
            Gears::Teeth(teeth) => teeth.full.carrier_speed(state, inputs.carrier_speed),
        };
    }
    for g in (0..layout.groups).filter(|_| plan.spin_imposed) {
        state.v[layout.planet(g)] = inputs.planet_spin;
    }
    if let Gears::Rigid(rigid) = &model.gears {
        rigid.constrain(state);
    }
}

/// Whether free speeds of gears without teeth have a jump of imposed ones to follow, from `followed` to `inputs`.
pub fn impels(model: &Model, followed: &Inputs, inputs: &Inputs) -> bool {
    let [by_carrier, by_spin] = model.ideal.impulse();
    matches!(&model.gears, Gears::Rigid(_))
        && (by_carrier != 0.0 && followed.carrier_speed != inputs.carrier_speed
            || by_spin != 0.0 && followed.planet_spin != inputs.planet_spin)
}

/// Lets free speeds of gears without teeth follow such a jump.
pub fn impel(model: &Model, followed: &Inputs, inputs: &Inputs, state: &mut State) {
    if let (Gears::Rigid(rigid), true) = (&model.gears, impels(model, followed, inputs)) {
        let [by_carrier, by_spin] = model.ideal.impulse();
        let carrier = |command: f64| rigid.carrier_speed(state, command);
        let jump = carrier(inputs.carrier_speed) - carrier(followed.carrier_speed);
        state.v[PLANET] += by_carrier * jump;
        state.v[CARRIER] += by_spin * (inputs.planet_spin - followed.planet_spin);
        rigid.constrain(state);
    }
}

/// Lets imposed speeds jump to their commands; the energy of the jump is impulsive work of the input.
pub fn apply(model: &Model, inputs: &Inputs, state: &mut State) {
    state.carrier_command = inputs.carrier_speed;
    let ideal = &model.ideal;
    let plan = &ideal.plan;
    let mut work = 0.0;
    let mut jump = |v: &mut f64, command: f64, inertia: f64| {
        if *v != command {
            work += 0.5 * inertia * (command * command - *v * *v);
            *v = command;
        }
    };
    for s in (0..2).filter(|&s| plan.side_imposed[s]) {
        jump(&mut state.v[plan.layout().end(s)], inputs.side_speed[s], ideal.inertia.end[s]);
    }
    match &model.gears {
        Gears::Rigid(rigid) => {
            state.work += work;
            let carrier_speed = rigid.carrier_speed(state, inputs.carrier_speed);
            state.work += ideal.jump(state, &Inputs { carrier_speed, ..*inputs });
        }
        Gears::Teeth(teeth) => {
            let layout = &teeth.layout;
            if plan.carrier_imposed {
                let command = teeth.full.carrier_speed(state, inputs.carrier_speed);
                jump(&mut state.v[CARRIER], command, teeth.inertia[CARRIER]);
            }
            for g in (0..layout.groups).filter(|_| plan.spin_imposed) {
                let i = layout.planet(g);
                jump(&mut state.v[i], inputs.planet_spin, layout.members[g] * teeth.inertia[i]);
            }
            state.work += work;
        }
    }
}
