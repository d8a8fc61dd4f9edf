//! Events: what happens by itself on the way from one communication point to the next.

use serde::{Deserialize, Serialize};

use crate::model::effect_kinds::{FrictionState, Mode};
use crate::model::scene::{FRICTION_BODIES, FRICTION_PLANETS, FRICTION_WHEELS, Inputs};

/// What happens.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[repr(u8)]
pub enum Happening {
    /// Nothing has happened yet.
    #[default]
    Nothing = 0,
    /// A wheel comes to rest and its brake holds it.
    WheelStops = 1,
    /// A wheel begins to turn against its brake.
    WheelBreaksLoose = 2,
    /// A clutch, washer or lock begins to stick.
    ClutchSticks = 3,
    /// It begins to slip.
    ClutchSlips = 4,
    /// The tooth of the tooth fault breaks.
    ToothBreaks = 5,
}

/// The last event.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Event {
    /// What happened.
    pub what: Happening,
    /// Number of the friction surface: side gears, groups of planets, wheels; 0 for teeth.
    pub place: u8,
    /// Time [s].
    pub time: f64,
    /// How many events there were so far.
    pub count: u32,
}

/// Where the motion stopped on its way to a communication point, and from where the rest of the way is reckoned: the last
/// communication point, so that a stop between changes no rounding.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pause {
    /// The last communication point on the integrator's clock [s].
    pub now: f64,
    /// Its time [s].
    pub time: f64,
    /// Inputs that act on the way.
    pub inputs: Inputs,
}

impl Pause {
    /// Whether all numbers are finite.
    pub fn is_finite(&self) -> bool {
        self.now.is_finite() && self.time.is_finite() && self.inputs.is_finite()
    }
}

/// How far the motion goes in one call.
#[derive(Clone, Copy, Debug, Default)]
pub struct Way {
    /// Whether it stops at the first event.
    pub pauses: bool,
    /// Whether more of the way to the next communication point follows.
    pub is_part: bool,
}

impl Event {
    /// Records what happens at `time` [s].
    pub fn record(&mut self, what: Happening, place: usize, time: f64) {
        *self = Self { what, place: place as u8, time, count: self.count.wrapping_add(1) };
    }

    /// Number of the side (1 left, 2 right) or of the group of planets at which it happened; 0 for teeth.
    pub fn number(&self) -> i32 {
        let place = usize::from(self.place);
        let first = match self.what {
            Happening::Nothing | Happening::ToothBreaks => return 0,
            _ if place >= FRICTION_WHEELS => FRICTION_WHEELS,
            _ if place >= FRICTION_PLANETS => FRICTION_PLANETS,
            _ => 0,
        };
        (place - first) as i32 + 1
    }

    /// Records how friction changes at `time` [s]. Returns whether a surface begins or ceases to stick.
    pub fn record_friction(&mut self, [before, after]: [&[FrictionState; FRICTION_BODIES]; 2], time: f64) -> bool {
        let sticks = |of: &[FrictionState; FRICTION_BODIES], i: usize| of[i].mode == Mode::Stuck;
        let count = self.count;
        for i in (0..FRICTION_BODIES).filter(|&i| sticks(before, i) != sticks(after, i)) {
            let happening = match (i >= FRICTION_WHEELS, sticks(after, i)) {
                (true, true) => Happening::WheelStops,
                (true, false) => Happening::WheelBreaksLoose,
                (false, true) => Happening::ClutchSticks,
                (false, false) => Happening::ClutchSlips,
            };
            self.record(happening, i, time);
        }
        self.count != count
    }
}
