//! Torques of teeth and half-shafts at the start, while the gears move as an ideal differential.

use crate::model::assembly::{Ideal, IdealMotion, Model, SIGMA};
use crate::model::dynamics::State;
use crate::model::effect_kinds::dry_friction::DryFriction;
use crate::model::effect_kinds::{Action, BodyMotion, Friction, StaticLoads, SurfaceLoad};
use crate::model::scene::{CARRIER, InputDerivatives, Inputs, MAX_DOF, PINION_PAIR, RubbingKind};
use crate::model::setup::HEATS;

/// Number of rounds in which the friction of the pinion and the torque of its mesh find each other.
const ROUNDS: usize = 100;

/// Torques at the start, and the corresponding accelerations.
#[derive(Clone, Copy, Debug)]
pub struct Carried {
    /// Torque of the teeth on each side gear [N·m].
    pub teeth: [f64; 2],
    /// Torque that each half-shaft delivers to its wheel [N·m].
    pub shaft: [f64; 2],
    /// Torques in front of the carrier.
    pub in_front: StaticLoads,
    /// Acceleration of each side gear [rad/s²].
    pub side_acceleration: [f64; 2],
    /// Acceleration of the carrier [rad/s²].
    pub carrier_acceleration: f64,
    /// Acceleration of the planets' spin [rad/s²].
    pub spin_acceleration: f64,
}

impl Carried {
    /// Torques under `inputs` at the speeds of `state`, for gears that move as the differential `ideal`: the ideal
    /// differential of the scene, or its variant with imposed planet spin.
    pub fn new(model: &Model, ideal: &Ideal, inputs: &Inputs, state: &State) -> Self {
        let mut held = 0.0;
        let mut carried = Self::with_pinion_held(model, ideal, (inputs, state), held);
        // the friction of the pinion depends on the torque that it leaves to the mesh
        for _ in 0..ROUNDS {
            let friction = sliding_pinion(model, inputs, state, carried.in_front.ring);
            if friction == held {
                break;
            }
            held = friction;
            carried = Self::with_pinion_held(model, ideal, (inputs, state), held);
        }
        carried
    }

    /// Torques if friction holds the pinion back by `held` [N·m].
    fn with_pinion_held(model: &Model, ideal: &Ideal, (inputs, state): (&Inputs, &State), held: f64) -> Self {
        let joint = model.body_effects().speed_ratio();
        let effect_torques = effect_torques(model, inputs, state);
        let brakes = sliding_brakes(model, inputs, state);
        let load = [0, 1].map(|s| inputs.load_torque[s] + brakes[s] - effect_torques[s]);
        let drive = inputs.drive_torque / joint + effect_torques[CARRIER] - held;
        // shaft torques are quasi-static: wheels at their ends accelerate with their side gears
        let mut rigid = *ideal;
        rigid.plan.shafts = [false; 2];
        rigid.inertia.carrier = ideal.inertia.carrier + ideal.plan.drive_inertia(joint);
        let j = &model.ideal.inertia;
        let mut motion = IdealMotion::default();
        let teeth = match ideal.plan.side_imposed {
            // a differential shares the torque of its carrier equally
            [true, true] => [0.5 * drive; 2],
            [false, false] => {
                motion = rigid.motion(&Inputs { load_torque: load, drive_torque: drive, ..*inputs });
                let a = rigid.side_accelerations(&motion);
                [0, 1].map(|s| load[s] + j.side[s] * a[s])
            }
            [imposed_left, _] => {
                let s = usize::from(!imposed_left);
                let (other, mut teeth) = (load[1 - s], [load[1 - s]; 2]);
                if !ideal.plan.drive_imposed {
                    if ideal.plan.spin_imposed {
                        teeth[s] = drive - other;
                    } else {
                        // side s keeps its speed, and the other side accelerates twice as fast as the carrier
                        let planets = j.planets * j.planet / (ideal.ratio * ideal.ratio);
                        motion.carrier =
                            (drive - 2.0 * other) / (rigid.inertia.carrier + 4.0 * j.side[1 - s] + planets);
                        motion.spin = -SIGMA[s] * motion.carrier / ideal.ratio;
                        teeth[1 - s] += 2.0 * j.side[1 - s] * motion.carrier;
                        teeth[s] = teeth[1 - s] + planets * motion.carrier;
                    }
                }
                teeth
            }
        };
        let side_acceleration = rigid.side_accelerations(&motion);
        let shaft = [0, 1].map(|s| teeth[s] + effect_torques[s] - (j.side[s] - j.end[s]) * side_acceleration[s]);
        // what the drive delivers to the carrier: the torques of the teeth and of effects, and the carrier's own inertia
        let ring = teeth[0] + teeth[1] - effect_torques[CARRIER] + (j.carrier - ideal.plan.on_carrier) * motion.carrier;
        let imposed = ideal.plan.drive_imposed;
        let in_front =
            StaticLoads { imposed, ring, propeller: ring + held + ideal.plan.pinion_inertia() * motion.carrier };
        let (carrier_acceleration, spin_acceleration) = (motion.carrier, motion.spin);
        Self { teeth, shaft, in_front, side_acceleration, carrier_acceleration, spin_acceleration }
    }
}

/// Torque with which friction holds a turning pinion back, under the `torque` of its mesh [N·m].
fn sliding_pinion(model: &Model, inputs: &Inputs, state: &State, torque: f64) -> f64 {
    let load = model.body_effects().loss.map_or(0.0, |loss| loss.of(torque));
    sliding_friction(model, inputs, state, PINION_PAIR, |_| SurfaceLoad { load, ..SurfaceLoad::default() })
}

/// Brake torques on turning wheels [N·m].
fn sliding_brakes(model: &Model, inputs: &Inputs, state: &State) -> [f64; 2] {
    [0, 1].map(|s| {
        let number = RubbingKind::Wheel.number(s);
        sliding_friction(model, inputs, state, number, |friction| friction.commanded_loads(inputs)[number])
    })
}

/// Torque of dry friction on the pair with this `number` at its speed in `state`, under the load that `load` returns; 0
/// at standstill [N·m].
fn sliding_friction(
    model: &Model,
    inputs: &Inputs,
    state: &State,
    number: usize,
    load: impl Fn(&Friction) -> SurfaceLoad,
) -> f64 {
    let effects = model.body_effects();
    let Some(pair) = &effects.pairs[number] else { return 0.0 };
    let friction = effects.friction((state.lock, &state.sums.thermal.used), inputs, &InputDerivatives::ZERO);
    let speed = state.v[pair.body];
    let direction = if speed == 0.0 { 0.0 } else { speed.signum() };
    let on_pair = DryFriction::new(friction.on(number), &effects.surfaces);
    direction * on_pair.sliding_limit(direction * speed, &load(&friction))[0]
}

/// Torques of effects, such as drag, on side gears and carrier at the speeds of `state` [N·m]. Half-shafts, pins and
/// seats are not wound up yet.
fn effect_torques(model: &Model, inputs: &Inputs, state: &State) -> [f64; CARRIER + 1] {
    let (q, mut v) = ([0.0; MAX_DOF], state.v);
    for (i, to) in model.layout.attached() {
        v[i] = v[to];
    }
    let oil_viscosity = model.body_effects().oil_viscosity(&state.sums.thermal.used);
    let (layout, input_rates) = (&model.layout, &Inputs::ZERO);
    let motion = BodyMotion { q: &q, v: &v, layout, inputs, input_rates, dogs: &state.dogs, oil_viscosity };
    let (mut force, mut heat) = ([0.0; MAX_DOF], [0.0; HEATS]);
    let mut out = Action { force: &mut force, heat: &mut heat };
    for effect in model.body_effects().forces.iter() {
        effect.act(&motion, &mut out);
    }
    [force[0], force[1], force[CARRIER]]
}
