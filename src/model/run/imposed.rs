//! Imposed speeds of a scene, and their jumps to the commands.

use crate::model::assembly::{Gears, Model};
use crate::model::dynamics::State;
use crate::model::scene::{CARRIER, Inputs, MAX_DOF, PLANET};

/// An imposed speed.
pub struct ImposedSpeed {
    /// Index of its degree of freedom.
    pub freedom: usize,
    /// Commanded value [rad/s].
    pub value: f64,
    /// Inertia of all bodies with this speed [kg·m²].
    inertia: f64,
}

/// Imposed speeds under `inputs`.
pub fn imposed_speeds<'a>(model: &'a Model, inputs: &'a Inputs) -> impl Iterator<Item = ImposedSpeed> + 'a {
    let (plan, layout, inertias) = (&model.ideal.plan, &model.layout, &model.ideal.inertia);
    let inertia = move |i: usize| match &model.gears {
        Gears::Ideal(ideal) => ideal.inertia[i],
        Gears::Teeth(teeth) => teeth.inertia[i],
    };
    let ends = (0..2).filter(|&s| plan.side_imposed[s]).map(move |s| ImposedSpeed {
        freedom: layout.end(s),
        value: inputs.side_speed[s],
        inertia: inertias.end[s],
    });
    let drive = plan.drive_imposed.then(|| ImposedSpeed {
        freedom: layout.port,
        value: inputs.drive_speed,
        inertia: inertia(layout.port),
    });
    let planets = (0..layout.groups).filter(|_| plan.spin_imposed).map(move |g| ImposedSpeed {
        freedom: layout.planet(g),
        value: inputs.planet_spin,
        inertia: layout.members[g] * inertia(layout.planet(g)),
    });
    ends.chain(drive).chain(planets)
}

/// True if all imposed speeds equal their commands.
pub fn are_met(model: &Model, inputs: &Inputs, state: &State) -> bool {
    let (plan, layout) = (&model.ideal.plan, &model.layout);
    (!plan.drive_imposed || state.v[layout.port] == inputs.drive_speed)
        && (!plan.spin_imposed || state.v[layout.planet(0)] == inputs.planet_spin)
        && (0..2).all(|s| !plan.side_imposed[s] || state.v[layout.end(s)] == inputs.side_speed[s])
}

/// Sets imposed speeds to their commands. Side gears without teeth follow Willis' equation. Free speeds do not change.
pub fn set(model: &Model, inputs: &Inputs, state: &mut State) {
    for speed in imposed_speeds(model, inputs) {
        state.v[speed.freedom] = speed.value;
    }
    if let Gears::Ideal(_) = &model.gears {
        model.ideal.constrain(&mut state.v);
    }
}

/// True if a jump of imposed speeds from `before` to `inputs` changes free speeds. This happens only with ideal gears.
pub fn is_impulse(model: &Model, before: &Inputs, inputs: &Inputs) -> bool {
    let [by_carrier, by_spin] = model.ideal.impulse();
    matches!(&model.gears, Gears::Ideal(_))
        && (by_carrier != 0.0 && before.drive_speed != inputs.drive_speed
            || by_spin != 0.0 && before.planet_spin != inputs.planet_spin)
}

/// Changes the free speeds of ideal gears in response to a jump of imposed speeds from `before` to `inputs`.
pub fn follow_impulse(model: &Model, before: &Inputs, inputs: &Inputs, state: &mut State) {
    if is_impulse(model, before, inputs) {
        let jump = [inputs.drive_speed - before.drive_speed, inputs.planet_spin - before.planet_spin];
        add_impulse(model, jump, &mut state.v);
        model.ideal.constrain(&mut state.v);
    }
}

/// Adds the response to a jump of carrier speed and spin to the free speeds of ideal gears.
pub fn add_impulse(model: &Model, [carrier, spin]: [f64; 2], v: &mut [f64; MAX_DOF]) {
    let [by_carrier, by_spin] = model.ideal.impulse();
    v[PLANET] += by_carrier * carrier;
    v[CARRIER] += by_spin * spin;
}

/// Sets imposed speeds to their commands and changes free speeds in response. The energy of the jump is impulsive work
/// of the input.
pub fn follow_commands(model: &Model, inputs: &Inputs, state: &mut State) {
    if imposed_speeds(model, inputs).all(|speed| speed.value == state.v[speed.freedom]) {
        return;
    }
    let before = state.v;
    let ideal = matches!(&model.gears, Gears::Ideal(_));
    let mut work = 0.0;
    for ImposedSpeed { freedom, value, inertia } in imposed_speeds(model, inputs) {
        // ideal gears move as one mechanism: the energy of their jump is counted below
        if value != before[freedom] && (!ideal || freedom > PLANET) {
            work += 0.5 * inertia * (value * value - before[freedom] * before[freedom]);
        }
        state.v[freedom] = value;
    }
    let changes = [CARRIER, PLANET].map(|i| state.v[i] - before[i]);
    if ideal && changes != [0.0; 2] {
        add_impulse(model, changes, &mut state.v);
        model.ideal.constrain(&mut state.v);
        work += model.ideal.kinetic_energy(&state.v) - model.ideal.kinetic_energy(&before);
    }
    state.sums.work += work;
}
