//! Torques of teeth and half-shafts at the start, while the gears move as an ideal differential.

use crate::model::assembly::{Ideal, IdealMotion, Model, SIGMA};
use crate::model::dynamics::State;
use crate::model::effect_kinds::{Action, BodyMotion, PairFriction, StaticLoads};
use crate::model::scene::{
    CARRIER, ENDS, Inputs, MAX_DOF, PAIRS, PINION, PINION_PAIR, PROPELLER, RubbingKind, RubbingPair,
};
use crate::model::setup::HEATS;

/// Scene at the start: the gears move as the differential `ideal`, which is the ideal differential of the scene or its
/// variant with imposed planet spin.
pub struct StartingScene<'a> {
    /// Model of the scene.
    pub model: &'a Model,
    /// Inputs.
    pub inputs: &'a Inputs,
    /// Speeds, the lock, and temperatures.
    pub state: &'a State,
    ideal: &'a Ideal,
    /// The differential with everything that turns with it. Shaft torques are quasi-static: wheels at their ends
    /// accelerate with their side gears.
    rigid: Ideal,
    effects: EffectTorques,
    /// True if the side gear turns its wheel. A dog clutch that is open at the start separates them.
    is_connected: [bool; 2],
}

/// Accelerations at the start.
#[derive(Clone, Copy, Debug)]
pub struct Accelerations {
    /// Side gears [rad/s²].
    pub side: [f64; 2],
    /// Carrier [rad/s²].
    pub carrier: f64,
    /// Spin of the planets [rad/s²].
    pub spin: f64,
}

/// Torques at the start, and the corresponding accelerations.
#[derive(Clone, Copy, Debug)]
pub struct Carried {
    /// Torque of the teeth on each side gear [N·m].
    pub teeth: [f64; 2],
    /// Torque that each half-shaft delivers to its wheel [N·m].
    pub shaft: [f64; 2],
    /// Torques in front of the carrier.
    pub in_front: StaticLoads,
    /// Dry friction.
    pub friction: PairFriction,
    /// Accelerations under these torques.
    pub acceleration: Accelerations,
}

/// Torques that do not act between the teeth.
#[derive(Clone, Copy, Default)]
struct Torques {
    /// Loads of the side gears, which resist positive rotation [N·m].
    load: [f64; 2],
    /// The part of the loads that acts on the side gears themselves, not beyond their half-shafts [N·m].
    on_gears: [f64; 2],
    /// Torque on the carrier [N·m].
    drive: f64,
    /// Torque on the spin of the planets, summed over all planets [N·m].
    spin: f64,
}

impl Torques {
    /// Torques of dry friction that holds each pair back by its entry in `friction` [N·m]. A wheel behind an open dog
    /// clutch turns by itself.
    fn of_friction(start: &StartingScene, friction: &[f64; PAIRS]) -> Self {
        let mut all = Self::default();
        for pair in start.model.body_effects().pairs.iter().flatten() {
            let torque = pair.count * friction[pair.number];
            match RubbingKind::of(pair.number) {
                (RubbingKind::Side | RubbingKind::Clutch, s) => {
                    all.load[s] += torque;
                    all.on_gears[s] += torque;
                    all.drive += pair.ratio * torque;
                }
                (RubbingKind::Wheel, s) if start.is_connected[s] => all.load[s] += torque,
                (RubbingKind::Wheel, _) => {}
                (RubbingKind::Pinion, _) => all.drive -= torque,
                (RubbingKind::Planet, _) => all.spin -= torque,
            }
        }
        all
    }
}

impl Carried {
    /// Torques under the dry `friction`.
    pub fn under(start: &StartingScene, friction: &PairFriction) -> Self {
        let StartingScene { model, ideal, inputs, rigid, effects, .. } = start;
        let held = Torques::of_friction(start, &friction.torque);
        let input = inputs.drive_torque / model.body_effects().speed_ratio();
        let drive = input + effects.carrier + effects.in_front + held.drive;
        let of_wheel = |s: usize| if start.is_connected[s] { inputs.load_torque[s] } else { 0.0 };
        let load = [0, 1].map(|s| of_wheel(s) + held.load[s] - effects.side[s]);
        let acceleration = start.accelerations(&Torques { load, drive, ..held });
        let free = [0, 1].map(|s| load[s] + rigid.inertia.side[s] * acceleration.side[s]);
        let teeth = match rigid.plan.side_imposed {
            // a differential shares the torque of its carrier equally
            [true, true] => SIGMA.map(|sigma| 0.5 * (drive + sigma * held.spin / ideal.ratio)),
            [false, false] => free,
            [imposed_left, _] => {
                let s = usize::from(!imposed_left);
                let other = free[1 - s];
                let mut teeth = [other; 2];
                if ideal.plan.drive_imposed || !ideal.plan.spin_imposed {
                    teeth[s] += start.planets_at_side() * acceleration.carrier + SIGMA[s] * held.spin / ideal.ratio;
                } else {
                    teeth[s] = drive - other;
                }
                teeth
            }
        };
        let behind_gear = |s: usize| effects.side[s] - held.on_gears[s];
        let shaft = [0, 1].map(|s| {
            let gear = model.ideal.inertia.side[s] - model.ideal.inertia.end[s];
            if start.is_connected[s] { teeth[s] + behind_gear(s) - gear * acceleration.side[s] } else { 0.0 }
        });
        // what the drive delivers to the carrier: the torques of teeth, effects and friction between the gears, and the
        // carrier's own inertia
        let of_pinion = friction.torque[PINION_PAIR];
        let on_carrier = effects.carrier + held.drive + of_pinion;
        let own = model.ideal.inertia.carrier - ideal.plan.on_carrier;
        let ring = teeth[0] + teeth[1] - on_carrier + own * acceleration.carrier;
        let propeller = ring + of_pinion - effects.in_front + ideal.plan.pinion_inertia() * acceleration.carrier;
        Self {
            teeth,
            shaft,
            in_front: StaticLoads { imposed: ideal.plan.drive_imposed, ring, propeller },
            friction: *friction,
            acceleration,
        }
    }
}

impl<'a> StartingScene<'a> {
    /// Scene of the `model` in which the gears move as `ideal`, at the speeds of `state`.
    pub fn new(model: &'a Model, ideal: &'a Ideal, inputs: &'a Inputs, state: &'a State) -> Self {
        let effects = EffectTorques::new(model, inputs, state);
        let dogs = &model.body_effects().half_shafts.dogs;
        let is_connected = [0, 1].map(|s| !state.dogs.is_open(dogs, s));
        let mut this = Self { model, inputs, state, ideal, rigid: *ideal, effects, is_connected };
        this.rigid.plan.shafts = [false; 2];
        this.rigid.inertia.carrier += ideal.plan.drive_inertia(model.body_effects().speed_ratio());
        for s in (0..2).filter(|&s| !is_connected[s]) {
            this.rigid.inertia.side[s] -= ideal.inertia.end[s];
            this.rigid.plan.side_imposed[s] = false;
        }
        this
    }

    /// Load of the wheel of side `s`; none if its speed is imposed [N·m].
    pub fn load(&self, s: usize) -> f64 {
        if self.model.ideal.plan.side_imposed[s] { 0.0 } else { self.inputs.load_torque[s] }
    }

    /// Load of the wheel of `pair` if it turns by itself, behind an open dog clutch [N·m].
    pub fn lone_wheel(&self, pair: &RubbingPair) -> Option<f64> {
        match RubbingKind::of(pair.number) {
            (RubbingKind::Wheel, s) if !self.is_connected[s] => Some(self.load(s)),
            _ => None,
        }
    }

    /// Inertia of all planets at a side gear that turns while the other one stands [kg·m²].
    fn planets_at_side(&self) -> f64 {
        let j = &self.ideal.inertia;
        j.planets * j.planet / (self.ideal.ratio * self.ideal.ratio)
    }

    /// Accelerations under `torques`, in which they are linear.
    fn accelerations(&self, torques: &Torques) -> Accelerations {
        let (rigid, Torques { load, drive, spin, .. }) = (&self.rigid, *torques);
        let (ratio, j) = (rigid.ratio, &rigid.inertia);
        let motion = match rigid.plan.side_imposed {
            [true, true] => IdealMotion::default(),
            [false, false] => {
                // a torque on the spin acts like a difference of the loads
                let half = 0.5 * spin / ratio;
                let load_torque = [load[0] - half, load[1] + half];
                rigid.motion(&Inputs { load_torque, drive_torque: drive, ..*self.inputs })
            }
            _ if rigid.plan.drive_imposed || rigid.plan.spin_imposed => IdealMotion::default(),
            [imposed_left, _] => {
                let s = usize::from(!imposed_left);
                // side s keeps its speed, and the other side accelerates twice as fast as the carrier
                let inertia = j.carrier + 4.0 * j.side[1 - s] + self.planets_at_side();
                let carrier = (drive - 2.0 * load[1 - s] - SIGMA[s] * spin / ratio) / inertia;
                IdealMotion { carrier, spin: -SIGMA[s] * carrier / ratio, ..IdealMotion::default() }
            }
        };
        Accelerations { side: rigid.side_accelerations(&motion), carrier: motion.carrier, spin: motion.spin }
    }

    /// Accelerations if only dry friction acts, which holds each pair back by its entry in `friction` [N·m].
    pub fn accelerations_by(&self, friction: &[f64; PAIRS]) -> Accelerations {
        self.accelerations(&Torques::of_friction(self, friction))
    }
}

impl Accelerations {
    /// Rate at which the slip of `pair` changes [rad/s²].
    pub fn of_slip(&self, pair: &RubbingPair) -> f64 {
        match RubbingKind::of(pair.number) {
            (RubbingKind::Side | RubbingKind::Clutch, s) => self.side[s] - pair.ratio * self.carrier,
            (RubbingKind::Wheel, s) => self.side[s],
            (RubbingKind::Pinion, _) => self.carrier,
            (RubbingKind::Planet, _) => self.spin,
        }
    }
}

/// Torques of effects, such as drag, at the speeds of the start.
struct EffectTorques {
    /// On the side gears [N·m].
    side: [f64; 2],
    /// On the carrier, without the bodies in front of it [N·m].
    carrier: f64,
    /// In front of the carrier, at its speed [N·m].
    in_front: f64,
}

impl EffectTorques {
    /// Torques at the speeds of `state`. Half-shafts, pins and seats are not wound up yet.
    fn new(model: &Model, inputs: &Inputs, state: &State) -> Self {
        let (layout, all, mut v) = (&model.layout, model.body_effects(), state.v);
        for (i, to) in layout.attached().take(if layout.has_ends() { ENDS } else { 0 }) {
            v[i] = v[to];
        }
        let oil_viscosity = all.oil_viscosity(&state.sums.thermal.used);
        let (q, input_rates) = ([0.0; MAX_DOF], &Inputs::ZERO);
        let motion = BodyMotion { q: &q, v: &v, layout, inputs, input_rates, dogs: &state.dogs, oil_viscosity };
        let mut force = [[0.0; MAX_DOF]; 2];
        for effect in all.forces.iter() {
            let is_in_front = effect.is_in_front() || effect.mesh_torque(&motion).is_some();
            effect.act(&motion, &mut Action { force: &mut force[usize::from(is_in_front)], heat: &mut [0.0; HEATS] });
        }
        let [behind, front] = &force;
        // virtual power over the speed of the carrier; forces between the bodies in front cancel
        let mut in_front = front[CARRIER];
        for i in [PINION, PROPELLER].into_iter().filter(|&k| layout.attached[k].is_some()).map(|k| layout.body(k)) {
            in_front += front[i] * if i == layout.port { 1.0 / all.speed_ratio() } else { 1.0 };
        }
        Self { side: [behind[0], behind[1]], carrier: behind[CARRIER], in_front }
    }
}
