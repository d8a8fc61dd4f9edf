//! Balance of the angular momentum about the axle at an instant, and over a run.
//!
//! External torques are those of the drive, of the wheels or of what imposes their speeds, of brakes and of drag. A drive
//! that imposes the carrier's speed has the torque that carrier, pins, teeth and rubbing surfaces demand.

use bevel_differential::geometry::Pair;
use bevel_differential::model::{BODIES, Body, GearContact, Parameters, Plan, Simulation};

use super::solids::Solid;
use super::space::UnitForce;

/// Slowest motion that tells in which direction dry friction acts [rad/s].
const SLIDING: f64 = 1e-3;

/// A differential with masses of its own reckoning.
#[derive(Clone, Debug)]
pub struct Differential {
    pub p: Parameters,
    pub pair: Pair,
    pub plan: Plan,
    /// Planet and side gear.
    pub solids: [Solid; 2],
}

/// The balance at an instant.
#[derive(Clone, Copy, Debug, Default)]
pub struct Balance {
    /// Rate of the angular momentum [N·m].
    pub rate: f64,
    /// Sum of the external torques [N·m].
    pub torque: f64,
    /// Torque of the carrier's drive [N·m].
    pub drive: f64,
    /// Magnitudes of all terms, summed [N·m].
    pub scale: f64,
    /// Angular momentum, and the magnitudes of its parts, summed [N·m·s].
    pub momentum: [f64; 2],
}

impl Balance {
    /// Rate less torque over all terms.
    pub fn error(&self) -> f64 {
        (self.rate - self.torque).abs() / self.scale.max(f64::MIN_POSITIVE)
    }
}

/// Balance over a run, torques by Simpson's rule.
#[derive(Clone, Copy, Debug, Default)]
pub struct Tally {
    /// Momentum gained less the impulse of the torques [N·m·s].
    pub off: f64,
    /// Impulse of the magnitudes of all torques, and the largest momentum [N·m·s].
    pub scale: f64,
    /// Largest error at an instant.
    pub worst: f64,
}

impl Tally {
    /// What is off over all that was turned over.
    pub fn error(&self) -> f64 {
        self.off.abs() / self.scale
    }
}

impl Differential {
    pub fn of(simulation: &Simulation) -> Self {
        let p = *simulation.parameters();
        let spec = p.gears();
        let solids = [0, 1].map(|i| Solid::new(&spec, i, p.material.density));
        Self { p, pair: Pair::new(&spec), plan: *simulation.plan(), solids }
    }

    /// Moments of inertia of a planet about the carrier's axis, and of a side gear about its own.
    pub fn inertias(&self) -> [f64; 2] {
        let [planet, side] = &self.solids;
        if self.p.inertia.from_geometry {
            return [planet.transverse, side.axial];
        }
        // a given planet has its solid's proportions
        [planet.transverse * self.p.inertia.planet / planet.axial, self.p.inertia.side_gear]
    }

    /// How many planets the loads of one stand for.
    fn members(&self, planet: usize) -> f64 {
        let group = self.plan.groups().iter().find(|group| group.planet == planet);
        group.expect("a load of a planet that is simulated").members
    }

    /// Moments of all tooth forces on the side gears about the axle, by where the forces act, and their thrusts.
    pub fn tooth_moments(&self, simulation: &Simulation) -> [[f64; 2]; 2] {
        let mut sums = [[0.0; 2]; 2];
        simulation.tooth_loads(|load| {
            let (force, count) = (UnitForce::of(&self.pair, load), self.members(load.planet));
            sums[load.side][0] += count * load.normal * load.cone * force.moments(load.side)[0];
            sums[load.side][1] += count * load.normal * force.parts(load.side)[1];
        });
        sums
    }

    /// Torque of washer and clutch of a side gear against its carrier, sliding at `slip`, pressed by `thrust` and `moment`.
    fn rubbing(&self, slip: f64, [moment, thrust]: [f64; 2]) -> f64 {
        let (mut limit, specs) = (0.0, &self.p.specs);
        if self.p.effects.thrust_friction {
            assert!(!specs.thrust_friction.radii_from_geometry, "radii are given here");
            limit += specs.thrust_friction.coefficient * specs.thrust_friction.side_washer_radius * thrust;
        }
        if self.p.effects.limited_slip {
            limit += specs.limited_slip.preload + specs.limited_slip.torque_coefficient * moment.abs();
        }
        assert!(limit == 0.0 || slip.abs() > SLIDING, "a side gear that sticks");
        limit * slip.signum()
    }

    /// Torque of drag at the speed `speed` of the carrier or of a side gear.
    fn drag(&self, speed: f64, carrier: bool) -> f64 {
        if !self.p.effects.bearing_drag {
            return 0.0;
        }
        let spec = &self.p.specs.bearing_drag;
        let build_up = (speed / spec.breakaway_speed).tanh();
        if carrier {
            let churning = spec.carrier_churning * speed * speed.abs();
            spec.carrier_torque * build_up + spec.carrier_viscous * speed + churning
        } else {
            spec.side_torque * build_up + spec.side_viscous * speed
        }
    }

    /// The balance of `simulation` at its present instant.
    pub fn at(&self, simulation: &Simulation) -> Balance {
        let (states, rates, inputs) = (simulation.states(), simulation.state_rates(), simulation.inputs());
        let place = |body: Body| BODIES.iter().position(|&b| b == body).expect("a body");
        let position = |body: Body| states[place(body)];
        let [speed, gain] = [&states, &rates].map(|of| move |body: Body| of[BODIES.len() + place(body)]);
        let ([orbit, side], plan, effects) = (self.inertias(), &self.plan, &self.p.effects);
        let mut balance = Balance::default();
        let mut turn = |inertia: f64, body: Body| {
            balance.rate += inertia * gain(body);
            balance.scale += (inertia * gain(body)).abs();
            balance.momentum[0] += inertia * speed(body);
            balance.momentum[1] += (inertia * speed(body)).abs();
        };
        turn(self.p.inertia.carrier, Body::Carrier);
        for i in 0..plan.planets {
            turn(orbit, if plan.has_pins { Body::Pin(i) } else { Body::Carrier });
        }
        let frame = balance.rate;
        let mut turn = |inertia: f64, body: Body| {
            balance.rate += inertia * gain(body);
            balance.scale += (inertia * gain(body)).abs();
            balance.momentum[0] += inertia * speed(body);
            balance.momentum[1] += (inertia * speed(body)).abs();
        };
        let mut torques = vec![-self.drag(speed(Body::Carrier), true)];
        let ends = [self.p.inertia.left_end, self.p.inertia.right_end];
        for s in 0..2 {
            turn(side, Body::Side(s));
            torques.push(-self.drag(speed(Body::Side(s)), false));
            let wheel = if plan.shafts[s] { Body::Attached(s) } else { Body::Side(s) };
            if plan.side_imposed[s] {
                // what imposes a speed takes the torque of the shaft, and what its end needs
                let shaft = &self.p.specs.half_shaft;
                let wind_up = speed(Body::Side(s)) - speed(wheel);
                torques.push(-shaft.stiffness[s] * position(wheel) - shaft.damping[s] * wind_up);
                continue;
            }
            turn(ends[s], wheel);
            torques.push(-inputs.load_torque[s]);
            if effects.wheel_brake && inputs.brake_torque[s] > 0.0 {
                assert!(speed(wheel).abs() > SLIDING, "a wheel that its brake holds");
                torques.push(-inputs.brake_torque[s] * speed(wheel).signum());
            }
        }
        balance.drive = if plan.carrier_imposed {
            assert!(plan.contact != GearContact::Ideal, "no teeth that demand a torque");
            let moments = self.tooth_moments(simulation);
            let slip = |s: usize| speed(Body::Side(s)) - speed(Body::Carrier);
            let on_sides: f64 = (0..2).map(|s| moments[s][0] - self.rubbing(slip(s), moments[s])).sum();
            frame + on_sides + self.drag(speed(Body::Carrier), true)
        } else {
            let wave = if effects.final_drive {
                let drive = &self.p.specs.final_drive;
                drive.amplitude * (f64::from(drive.ring_teeth) * position(Body::Carrier)).sin()
            } else {
                0.0
            };
            inputs.carrier_torque * (1.0 + wave)
        };
        torques.push(balance.drive);
        balance.torque = torques.iter().sum();
        balance.scale += torques.iter().map(|torque| torque.abs()).sum::<f64>();
        balance
    }

    /// Integrates to `stop` [s] from communication point to communication point, `step` [s] apart, and sums up.
    pub fn over(&self, simulation: &mut Simulation, stop: f64, step: f64) -> Tally {
        let (begin, mut tally) = (simulation.time(), Tally::default());
        let first = self.at(simulation);
        let (mut last, mut impulse) = (first, 0.0);
        tally.worst = first.error();
        for k in 1..=((stop - begin) / step).round() as u32 {
            let to = begin + f64::from(k) * step;
            let [middle, end] = [to - 0.5 * step, to].map(|time| {
                simulation.advance(time).expect("a step");
                self.at(simulation)
            });
            let simpson = |of: fn(&Balance) -> f64| step / 6.0 * (of(&last) + 4.0 * of(&middle) + of(&end));
            impulse += simpson(|b| b.torque);
            tally.scale += simpson(|b| b.scale);
            tally.worst = tally.worst.max(middle.error()).max(end.error());
            last = end;
        }
        tally.scale += first.momentum[1].max(last.momentum[1]);
        tally.off = last.momentum[0] - first.momentum[0] - impulse;
        tally
    }
}
