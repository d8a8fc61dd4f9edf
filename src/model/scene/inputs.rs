//! Inputs, which the host sets at communication points. Each is declared once, with its start value and its limits.

use serde::{Deserialize, Serialize};

#[cfg(doc)]
use super::Plan;
use crate::numeric::finite;

/// Largest command of a speed [rad/s], far beyond any differential, but small enough that no intermediate result overflows.
pub const MAX_SPEED: f64 = 1e5;
/// Largest command of a torque [N·m], far beyond any differential, but small enough that no intermediate result
/// overflows.
pub const MAX_TORQUE: f64 = 1e8;
/// Limits of an input that may have either sign.
const FREE: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];
/// Limits of a torque that only resists.
const RESISTING: [f64; 2] = [0.0, f64::INFINITY];
/// Limits of a command: 0 none, 1 full.
const COMMAND: [f64; 2] = [0.0, 1.0];

/// Number of commands that may pass actuators.
pub const ACTUATED: usize = 3;
/// Indices of the commands of the clutches among these, left and right.
pub const ACTUATED_CLUTCHES: [usize; 2] = [0, 1];
/// Index of the command of the lock among these.
pub const ACTUATED_LOCK: usize = 2;

/// One value, or one for the left and one for the right side.
trait Value: Copy {
    const ZERO: Self;
    fn combine(self, other: Self, of: impl Fn(f64, f64) -> f64) -> Self;
    fn pick(self, other: Self, mask: Self) -> Self;
    fn visit(self, other: Self, see: &mut impl FnMut(f64, f64));
    fn follow(&mut self, rates: [&mut Self; 2], follow: impl Fn(&mut f64, [&mut f64; 2]));
}

impl Value for f64 {
    const ZERO: Self = 0.0;
    fn combine(self, other: Self, of: impl Fn(f64, f64) -> f64) -> Self {
        of(self, other)
    }
    fn pick(self, other: Self, mask: Self) -> Self {
        if mask == 0.0 { self } else { other }
    }
    fn visit(self, other: Self, see: &mut impl FnMut(f64, f64)) {
        see(self, other);
    }
    #[inline]
    fn follow(&mut self, rates: [&mut f64; 2], follow: impl Fn(&mut f64, [&mut f64; 2])) {
        // most inputs are constant, which one comparison of bits detects
        let [first, second] = rates;
        if (first.to_bits() | second.to_bits()) << 1 != 0 {
            follow(self, [first, second]);
        }
    }
}

impl Value for [f64; 2] {
    const ZERO: Self = [0.0; 2];
    fn combine(self, other: Self, of: impl Fn(f64, f64) -> f64) -> Self {
        [of(self[0], other[0]), of(self[1], other[1])]
    }
    fn pick(self, other: Self, mask: Self) -> Self {
        [self[0].pick(other[0], mask[0]), self[1].pick(other[1], mask[1])]
    }
    fn visit(self, other: Self, see: &mut impl FnMut(f64, f64)) {
        see(self[0], other[0]);
        see(self[1], other[1]);
    }
    #[inline]
    fn follow(&mut self, rates: [&mut [f64; 2]; 2], follow: impl Fn(&mut f64, [&mut f64; 2])) {
        let [first, second] = rates;
        let sides = self.iter_mut().zip(first.iter_mut().zip(second));
        sides.for_each(|(value, (first, second))| value.follow([first, second], &follow));
    }
}

macro_rules! inputs {
    ($($(#[$doc:meta])+ $name:ident: $type:ty = $start:expr, $limits:ident;)+) => {
        /// Inputs, which the host sets at communication points.
        #[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
        pub struct Inputs {
            $($(#[$doc])+ pub $name: $type,)+
        }

        finite!(Inputs { $($name),+ });

        impl Default for Inputs {
            fn default() -> Self {
                Self { $($name: $start),+ }
            }
        }

        impl Inputs {
            /// All inputs 0.
            pub const ZERO: Self = Self { $($name: Value::ZERO),+ };

            /// Returns self + factor · other.
            pub fn plus(&self, factor: f64, other: &Self) -> Self {
                Self { $($name: self.$name.combine(other.$name, |a, b| a + factor * b)),+ }
            }

            /// Returns the inputs, each clamped to its limits.
            pub fn limited(&self) -> Self {
                Self { $($name: self.$name.combine(Value::ZERO, |a, _| a.clamp($limits[0], $limits[1]))),+ }
            }

            /// Calls `follow` with each value, its first and second rate, and its limits, unless both rates are 0.
            pub fn follow(&mut self, rates: &mut [Self; 2], follow: impl Fn(&mut f64, [&mut f64; 2], [f64; 2])) {
                let [first, second] = rates;
                $(self.$name.follow([&mut first.$name, &mut second.$name], |value, rates| follow(value, rates, $limits));)+
            }

            /// Returns each value, taken from `other` if its `mask` is not 0.
            pub fn pick(&self, other: &Self, mask: &Self) -> Self {
                Self { $($name: self.$name.pick(other.$name, mask.$name)),+ }
            }

            /// Rates at which these inputs become `later` in `time` [s].
            pub fn rates_to(&self, later: &Self, time: f64) -> Self {
                Self { $($name: self.$name.combine(later.$name, |from, to| (to - from) / time)),+ }
            }

            /// Calls `see` with each value and the corresponding value of `other`.
            pub fn visit(&self, other: &Self, mut see: impl FnMut(f64, f64)) {
                $(self.$name.visit(other.$name, &mut see);)+
            }
        }
    };
}

inputs! {
    /// Commanded speed of the carrier, or its initial speed when torque-driven [rad/s].
    carrier_speed: f64 = 2861f64.to_radians(), FREE;
    /// Commanded torque of the carrier [N·m].
    carrier_torque: f64 = 1670.0, FREE;
    /// Commanded speed of the pinion or its propeller shaft, or its initial speed when torque-driven [rad/s].
    pinion_speed: f64 = 200.0, FREE;
    /// Commanded torque of the pinion or its propeller shaft [N·m].
    pinion_torque: f64 = 400.0, FREE;
    /// Speed of the drive, referred to the carrier [rad/s]. It follows from a command by [`Plan::refer`].
    drive_speed: f64 = 0.0, FREE;
    /// Torque of the drive, referred to the carrier [N·m]. It follows from a command by [`Plan::refer`].
    drive_torque: f64 = 0.0, FREE;
    /// Loads on the left and right half-shafts; positive values resist positive rotation [N·m].
    load_torque: [f64; 2] = [835.0; 2], FREE;
    /// Imposed speeds of the wheel-side ends of the half-shafts [rad/s].
    side_speed: [f64; 2] = [2861f64.to_radians(); 2], FREE;
    /// Imposed planet spin relative to the carrier; positive values speed up the left side [rad/s].
    planet_spin: f64 = 0.0, FREE;
    /// Command of the lock, from 0 (open) to 1 (locked).
    lock: f64 = 0.0, COMMAND;
    /// Brake torques at left and right wheel, 0 or more [N·m].
    brake_torque: [f64; 2] = [0.0; 2], RESISTING;
    /// Commands of the clutches, left and right, from 0 (open) to 1 (full torque).
    clutch_command: [f64; 2] = [0.0; 2], COMMAND;
    /// Commands of the dog clutches, left and right: closed above one half.
    dog_command: [f64; 2] = [1.0; 2], COMMAND;
    /// Triggers the tooth fault when it rises above one half.
    fault: f64 = 0.0, COMMAND;
    /// Change of the ambient temperature from its parameter [K].
    ambient_change: f64 = 0.0, FREE;
    /// Change of a given sump temperature from its parameter `oil.temperature` [K].
    sump_change: f64 = 0.0, FREE;
}

impl Inputs {
    /// Changes since `before` of the left and right load torques and of the torque of the drive [N·m].
    pub fn torques_since(&self, before: &Self) -> [f64; 3] {
        let [left, right] = [0, 1].map(|s| self.load_torque[s] - before.load_torque[s]);
        [left, right, self.drive_torque - before.drive_torque]
    }

    /// Values that limit commanded friction: brake torques and clutch commands.
    pub fn friction_commands(&self) -> [[f64; 2]; 2] {
        [self.brake_torque, self.clutch_command]
    }

    /// Values that limit commanded friction, to be changed.
    pub fn friction_commands_mut(&mut self) -> [&mut [f64; 2]; 2] {
        [&mut self.brake_torque, &mut self.clutch_command]
    }

    /// Commands that may pass actuators.
    pub fn actuated(&self) -> [f64; ACTUATED] {
        let [left, right] = self.clutch_command;
        [left, right, self.lock]
    }

    /// Commands that may pass actuators, to be changed.
    pub fn actuated_mut(&mut self) -> [&mut f64; ACTUATED] {
        let [left, right] = &mut self.clutch_command;
        [left, right, &mut self.lock]
    }

    /// Changes of the outside temperatures: ambient and a given sump [K].
    pub fn changes_outside(&self) -> [f64; 2] {
        [self.ambient_change, self.sump_change]
    }
}
