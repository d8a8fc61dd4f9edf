//! Dry friction that truly sticks: a spring while a body is held, a limit torque while it slides.
//!
//! While stuck T = k (z + τ ω) with the turn z since the body was caught, while sliding T = ±T_max (P. R. Dahl's and
//! Jenkins' element: a spring in series with a Coulomb slider). The turn z is a position that the model has anyway, less
//! an anchor, so that holding costs no state and a constant load is held without creep. While sliding the anchor is dragged
//! along by the spring, step by step, so that a body is caught with what the spring holds then, never with more. Transitions are landed on by the
//! integrator; the energy that the spring gives up or takes on at them is booked as heat.

use serde::{Deserialize, Serialize};

use super::causes::CAUSES;
use super::grip::{Grip, PlanetGrip, SideGrip};

/// Ways in which a body can be held.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Mode {
    /// By a spring from its anchor.
    #[default]
    Stuck,
    /// Slides forward.
    Forward,
    /// Slides backward.
    Backward,
}

impl Mode {
    /// +1 or −1 while sliding, 0 while stuck.
    pub fn direction(self) -> f64 {
        match self {
            Mode::Stuck => 0.0,
            Mode::Forward => 1.0,
            Mode::Backward => -1.0,
        }
    }
}

/// How a body is held.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Hold {
    /// Stuck or sliding.
    pub mode: Mode,
    /// Position at which the spring is relaxed [rad]; while sliding, where it would be.
    pub anchor: f64,
    /// Stiffness that the anchor belongs to [N·m/rad]; 0 = not held yet.
    pub stiffness: f64,
}

/// Damping of the spring over its stiffness τ [s].
const DAMPING_TIME: f64 = 1e-4;
/// How closely a limit torque is landed on, relative to it.
const LIMIT_TOLERANCE: f64 = 1e-5;
/// How closely zero speed is landed on [rad/s].
const SPEED_TOLERANCE: f64 = 1e-6;
/// Limit torque below which there is nothing to hold [N·m].
const NOTHING: f64 = 1e-9;
/// Parts of a step within which a switch is looked for.
const FRACTIONS: (f64, f64) = (1e-3, 0.999);
/// Most effects that can hold.
const GRIPS: usize = 3;

/// What presses bodies together.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pressing {
    /// Thrust on a side gear, or on a planet [N].
    pub thrust: f64,
    /// Magnitude of the torque of the meshes on a side gear [N·m], or of the force across a planet's pin [N].
    pub load: f64,
}

/// Motion of a held body against what holds it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    /// Position [rad].
    pub position: f64,
    /// Speed [rad/s].
    pub speed: f64,
}

/// All that holds one kind of body.
#[derive(Clone, Copy, Debug, Default)]
pub struct Clamp {
    parts: [Part; GRIPS],
    count: usize,
    /// Stiffness of all together [N·m/rad].
    pub stiffness: f64,
}

#[derive(Clone, Copy, Debug, Default)]
struct Part {
    constant: f64,
    per_thrust: f64,
    per_load: f64,
    static_ratio: f64,
    cause: usize,
}

impl Clamp {
    fn push(&mut self, part: Part, stiffness: f64) {
        if stiffness > 0.0 && self.count < GRIPS {
            self.parts[self.count] = part;
            self.count += 1;
            self.stiffness += stiffness;
        }
    }

    /// What holds side gears and what holds planets, of `grips`.
    pub fn of<'a>(grips: impl IntoIterator<Item = &'a Grip>) -> [Self; 2] {
        let mut clamps = [Self::default(); 2];
        for grip in grips {
            let SideGrip { constant, per_thrust, per_torque, stiffness } = grip.side;
            let (cause, static_ratio) = (grip.cause as usize, grip.static_ratio);
            clamps[0].push(Part { constant, per_thrust, per_load: per_torque, static_ratio, cause }, stiffness);
            let PlanetGrip { per_pin_force, per_thrust, stiffness } = grip.planet;
            clamps[1].push(Part { constant: 0.0, per_thrust, per_load: per_pin_force, static_ratio, cause }, stiffness);
        }
        clamps
    }

    fn parts(&self) -> &[Part] {
        &self.parts[..self.count]
    }

    /// Whether anything holds at all.
    pub fn is_on(&self) -> bool {
        self.count > 0
    }

    /// Whether what presses matters.
    pub fn depends_on_load(&self) -> bool {
        self.parts().iter().any(|p| p.per_thrust != 0.0 || p.per_load != 0.0)
    }

    /// Limit torque while sliding [N·m].
    pub fn limit(&self, by: &Pressing) -> f64 {
        self.parts().iter().map(|p| p.at(by)).sum()
    }

    /// Its slopes by thrust and load.
    pub fn limit_slopes(&self) -> [f64; 2] {
        self.parts().iter().fold([0.0; 2], |[t, l], p| [t + p.per_thrust, l + p.per_load])
    }

    fn breakaway(&self, by: &Pressing) -> f64 {
        self.parts().iter().map(|p| p.static_ratio * p.at(by)).sum()
    }

    /// Torque against the motion.
    pub fn torque(&self, hold: &Hold, turn: &Turn, by: &Pressing) -> f64 {
        match hold.mode {
            Mode::Stuck => self.stiffness * (turn.position - hold.anchor + DAMPING_TIME * turn.speed),
            Mode::Forward => self.limit(by),
            Mode::Backward => -self.limit(by),
        }
    }

    /// Slopes of the torque by position and speed; by what presses see [`Self::limit_slopes`].
    pub fn torque_slopes(&self, hold: &Hold) -> [f64; 2] {
        match hold.mode {
            Mode::Stuck => [self.stiffness, DAMPING_TIME * self.stiffness],
            _ => [0.0; 2],
        }
    }

    /// Adds the heat to its causes, `count` bodies alike.
    pub fn heat(&self, hold: &Hold, turn: &Turn, by: &Pressing, count: f64, heat: &mut [f64; CAUSES]) {
        let power = match hold.mode {
            Mode::Stuck => self.stiffness * DAMPING_TIME * turn.speed * turn.speed,
            _ => self.torque(hold, turn, by) * turn.speed,
        };
        self.book(count * power, by, heat);
    }

    /// Shares `amount` out to the causes in proportion to what each holds.
    fn book(&self, amount: f64, by: &Pressing, heat: &mut [f64; CAUSES]) {
        let whole = self.limit(by);
        for part in self.parts() {
            let share = if whole > 0.0 { part.at(by) / whole } else { 1.0 / self.count as f64 };
            heat[part.cause] += amount * share;
        }
    }

    /// Energy in the spring [J].
    pub fn energy(&self, hold: &Hold, position: f64) -> f64 {
        let z = position - hold.anchor;
        if hold.mode == Mode::Stuck { 0.5 * self.stiffness * z * z } else { 0.0 }
    }

    /// How far the hold is past its switch, as a fraction of what is allowed: negative before, above 1 too far.
    fn overshoot(&self, hold: &Hold, turn: &Turn, by: &Pressing) -> f64 {
        match hold.mode {
            Mode::Stuck => {
                // a spring past its limit that is being unwound is cut back, it does not slide
                let torque = self.torque(hold, turn, by) * turn.speed.signum();
                let limit = self.breakaway(by);
                (torque - limit) / (LIMIT_TOLERANCE * limit + NOTHING)
            }
            mode => {
                let direction = if mode == Mode::Forward { 1.0 } else { -1.0 };
                -direction * turn.speed / SPEED_TOLERANCE
            }
        }
    }

    /// The fraction of a step to take so that it ends on a switch; `None` if there is none or it is near enough.
    pub fn crossing(&self, hold: &Hold, start: (&Turn, &Pressing), end: (&Turn, &Pressing)) -> Option<f64> {
        let after = self.overshoot(hold, end.0, end.1);
        if after <= 1.0 || self.limit(end.1) <= NOTHING {
            return None;
        }
        // aim at the middle of what is allowed
        let before = self.overshoot(hold, start.0, start.1).min(0.0);
        Some(((0.5 - before) / (after - before)).clamp(FRACTIONS.0, FRACTIONS.1))
    }

    /// Switches the hold where it is due; what its spring gives up is heat of `count` bodies. Whether it switched.
    pub fn settle(&self, hold: &mut Hold, turn: &Turn, by: &Pressing, count: f64, heat: &mut [f64; CAUSES]) -> bool {
        let before = *hold;
        let torque = self.torque(hold, turn, by);
        let due = self.overshoot(hold, turn, by) > 0.0;
        match hold.mode {
            Mode::Stuck if due => hold.mode = if torque > 0.0 { Mode::Forward } else { Mode::Backward },
            Mode::Stuck => {
                let z = turn.position - hold.anchor;
                let most = self.breakaway(by) / self.stiffness;
                if z.abs() > most * (1.0 + LIMIT_TOLERANCE) + NOTHING / self.stiffness {
                    hold.anchor = turn.position - most * z.signum();
                }
            }
            _ if due => hold.mode = Mode::Stuck,
            _ => {}
        }
        if *hold == before {
            return false;
        }
        let lost = self.energy(&before, turn.position) - self.energy(hold, turn.position);
        self.book(count * lost, by, heat);
        true
    }

    /// Anchor of a body that has slid to `turn`: dragged along as far as the spring, wound to the limit torque, drags it.
    /// Where the limit rises faster than the motion winds the spring, the spring is left behind it.
    pub fn drag(&self, anchor: f64, turn: &Turn, by: &Pressing) -> f64 {
        let most = self.limit(by) / self.stiffness;
        turn.position - (turn.position - anchor).max(-most).min(most)
    }

    /// How far the hold is from its switch, positive before: torque left while stuck [N·m], speed while sliding [rad/s].
    pub fn margin(&self, hold: &Hold, turn: &Turn, by: &Pressing) -> f64 {
        match hold.mode {
            Mode::Stuck => self.breakaway(by) - self.torque(hold, turn, by).abs(),
            mode => mode.direction() * turn.speed,
        }
    }

    /// Whether [`Self::settle`] has something to do.
    pub fn is_due(&self, hold: &Hold, turn: &Turn, by: &Pressing) -> bool {
        self.settle(&mut hold.clone(), turn, by, 0.0, &mut [0.0; CAUSES])
    }

    /// Takes a hold over from another stiffness; a body that was not held yet is caught here.
    pub fn take_over(&self, hold: &mut Hold, turn: &Turn, heat: &mut [f64; CAUSES], count: f64) {
        if hold.stiffness == self.stiffness {
            return;
        }
        let wound = turn.position - hold.anchor;
        let before = if hold.mode == Mode::Stuck { 0.5 * hold.stiffness * wound * wound } else { 0.0 };
        if self.stiffness > 0.0 {
            if hold.stiffness == 0.0 {
                hold.mode = match turn.speed {
                    v if v > SPEED_TOLERANCE => Mode::Forward,
                    v if v < -SPEED_TOLERANCE => Mode::Backward,
                    _ => Mode::Stuck,
                };
            }
            // a spring that becomes stiffer keeps its torque, one that becomes softer its twist: neither gains energy
            hold.anchor = turn.position - wound * (hold.stiffness / self.stiffness).min(1.0);
        } else {
            *hold = Hold::default();
        }
        hold.stiffness = self.stiffness;
        let cause = self.parts().first().map_or(super::causes::Cause::Clutch as usize, |p| p.cause);
        heat[cause] += count * (before - self.energy(hold, turn.position));
    }
}

impl Part {
    fn at(&self, by: &Pressing) -> f64 {
        self.constant + self.per_thrust * by.thrust + self.per_load * by.load
    }
}

#[cfg(test)]
mod tests {
    use super::super::causes::Cause;
    use super::*;

    const STIFFNESS: f64 = 1e3;

    /// A clutch that holds as much as presses it.
    fn clutch() -> Clamp {
        let side = SideGrip { per_torque: 1.0, stiffness: STIFFNESS, ..SideGrip::default() };
        Clamp::of([&Grip { cause: Cause::Clutch, side, planet: PlanetGrip::default(), static_ratio: 1.0 }])[0]
    }

    fn pressed(load: f64) -> Pressing {
        Pressing { thrust: 0.0, load }
    }

    #[test]
    fn a_body_is_caught_with_what_its_spring_was_wound_to() {
        let clutch = clutch();
        let turn = |position| Turn { position, speed: 1.0 };
        // slides under 10 N·m: the spring holds as much
        let anchor = clutch.drag(0.0, &turn(0.5), &pressed(10.0));
        assert!((STIFFNESS * (0.5 - anchor) - 10.0).abs() < 1e-9);
        // the load rises a hundredfold while the body slides by 1 mrad, which winds the spring by 1 N·m
        let anchor = clutch.drag(anchor, &turn(0.501), &pressed(1000.0));
        assert!((STIFFNESS * (0.501 - anchor) - 11.0).abs() < 1e-9);
        let mut hold = Hold { mode: Mode::Forward, anchor, stiffness: STIFFNESS };
        let mut heat = [0.0; CAUSES];
        let stopped = Turn { position: 0.501, speed: -1e-7 };
        assert!(clutch.settle(&mut hold, &stopped, &pressed(1000.0), 1.0, &mut heat));
        assert_eq!(hold.mode, Mode::Stuck);
        assert!((clutch.torque(&hold, &Turn { speed: 0.0, ..stopped }, &pressed(1000.0)) - 11.0).abs() < 1e-9);
    }

    #[test]
    fn a_crossing_from_one_limit_to_the_other_is_found_at_once() {
        let (clutch, by) = (clutch(), pressed(10.0));
        // wound to +10 N·m at 0 and turned back: −10 N·m is reached at −20 mrad, a fifth of the way to −100 mrad
        let hold = Hold { mode: Mode::Stuck, anchor: -0.01, stiffness: STIFFNESS };
        let turn = |position| Turn { position, speed: -1.0 };
        let part = clutch.crossing(&hold, (&turn(0.0), &by), (&turn(-0.1), &by)).unwrap();
        let shift = DAMPING_TIME;
        assert!((part * 0.1 - (0.02 - shift)).abs() < 1e-4, "{part}");
    }

    #[test]
    fn no_change_of_stiffness_gives_a_spring_energy() {
        let turn = Turn { position: 0.01, speed: 0.0 };
        for stiffness in [10.0, 1e3, 1e5] {
            let mut hold = Hold { mode: Mode::Stuck, anchor: 0.0, stiffness };
            let before = 0.5 * stiffness * 1e-4;
            let mut heat = [0.0; CAUSES];
            let clutch = clutch();
            clutch.take_over(&mut hold, &turn, &mut heat, 1.0);
            let after = clutch.energy(&hold, turn.position);
            assert!(after <= before * (1.0 + 1e-12), "{stiffness}: {before} J became {after} J");
            assert!((heat.iter().sum::<f64>() - (before - after)).abs() < 1e-12);
        }
    }
}
