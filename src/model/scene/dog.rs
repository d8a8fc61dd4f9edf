//! Dog clutch between a side gear and its half-shaft. Its teeth engage where they face gaps, if both sides turn at almost
//! the same speed; it disengages when it transmits almost no torque.

use serde::{Deserialize, Serialize};

use super::Inputs;
use crate::numeric::{Scalar, finite};

/// Speed within which the torque of ratcheting teeth turns round [rad/s].
const RATCHETING: f64 = 0.1;
/// Fraction of the lash, and of the limits of speed and torque, within which a switch is located.
const WITHIN: f64 = 1e-5;

/// Dog clutch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dog {
    /// Pitch of its teeth [rad].
    pub pitch: f64,
    /// Half of its lash [rad].
    pub half_lash: f64,
    /// Difference of speeds up to which it engages [rad/s].
    pub most_speed: f64,
    /// Torque up to which it disengages [N·m].
    pub most_torque: f64,
    /// Mean torque while its teeth ratchet [N·m].
    pub ratchet: f64,
    /// Index of its heat in the ledger.
    pub heat_index: usize,
}

/// State of both dog clutches, left and right.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Dogs {
    /// Twist at which the teeth of a closed clutch are in the middle of their gaps [rad]; `None` if it is open.
    pub closed: [Option<f64>; 2],
    /// True if the command is to close.
    pub commanded: [bool; 2],
}

finite!(Dogs { closed; commanded });

impl Dogs {
    /// State at the start of a scene with these clutches: as commanded, with the teeth in the middle of their gaps.
    pub fn at_start(of: &[Option<Dog>; 2], inputs: &Inputs) -> Self {
        let commanded = Self::commands(inputs);
        Self { closed: [0, 1].map(|s| (of[s].is_some() && commanded[s]).then_some(0.0)), commanded }
    }

    /// State of the clutch of side `s`.
    pub fn of(&self, s: usize) -> DogState {
        (self.closed[s], self.commanded[s])
    }

    /// True if the clutch of side `s`, if it is among `of`, is open.
    pub fn is_open(&self, of: &[Option<Dog>; 2], s: usize) -> bool {
        of[s].is_some() && self.closed[s].is_none()
    }

    /// Twist of the half-shaft of side `s` from which its torque counts [rad].
    #[inline]
    pub fn middle(&self, s: usize) -> f64 {
        self.closed.get(s).copied().flatten().unwrap_or(0.0)
    }

    /// Commands in `inputs`.
    pub fn commands(inputs: &Inputs) -> [bool; 2] {
        inputs.dog_command.map(|command| command > 0.5)
    }
}

/// Twist at which the teeth of a closed clutch are in the middle of their gaps [rad], or `None` if it is open, and true
/// if the command is to close.
pub type DogState = (Option<f64>, bool);

/// Twist across a dog clutch and its half-shaft [rad], the rate of the twist [rad/s], and the torque [N·m].
#[derive(Clone, Copy, Debug)]
pub struct DogMotion {
    /// Twist.
    pub twist: f64,
    /// Rate of the twist.
    pub rate: f64,
    /// Torque.
    pub torque: f64,
}

/// Phase of a dog clutch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DogPhase {
    /// Open, as commanded.
    Open = 0,
    /// It is to close, but the speeds differ too much.
    WaitsForSpeed = 1,
    /// It is to close, but tooth faces tooth.
    WaitsForGap = 2,
    /// Closed, as commanded.
    Closed = 3,
    /// It is to open, but transmits torque.
    WaitsForTorque = 4,
}

impl Dog {
    /// Angle between the teeth and the middle of their nearest gaps [rad].
    fn off_gap(&self, twist: f64) -> f64 {
        twist - self.gap(twist)
    }

    /// Twist at which the teeth are in the middle of their nearest gaps [rad].
    fn gap(&self, twist: f64) -> f64 {
        self.pitch * libm::rint(twist / self.pitch)
    }

    /// Torque of ratcheting teeth against the rate of the twist [N·m].
    pub fn ratcheting<T: Scalar>(&self, rate: T) -> T {
        (rate * (1.0 / RATCHETING)).tanh() * self.ratchet
    }

    /// Phase in this motion.
    pub fn phase(&self, state: DogState, at: &DogMotion) -> DogPhase {
        match state {
            (Some(_), true) => DogPhase::Closed,
            (Some(_), false) => DogPhase::WaitsForTorque,
            (None, false) => DogPhase::Open,
            (None, true) if at.rate.abs() > self.most_speed => DogPhase::WaitsForSpeed,
            (None, true) => DogPhase::WaitsForGap,
        }
    }

    /// Distance from the next switch: negative if it is due, infinite if none can occur.
    pub fn margin(&self, state: DogState, at: &DogMotion) -> f64 {
        match state {
            (None, true) => {
                let speed = at.rate.abs() / self.most_speed - 1.0;
                speed.max(self.off_gap(at.twist).abs() / self.half_lash - 1.0)
            }
            (Some(_), false) => at.torque.abs() / self.most_torque - 1.0,
            _ => f64::INFINITY,
        }
    }

    /// State after a switch that is due, or `None` if none is due.
    pub fn switched(&self, state: DogState, at: &DogMotion) -> Option<Option<f64>> {
        let is_due = self.margin(state, at) <= 0.0;
        is_due.then(|| if state.0.is_some() { None } else { Some(self.gap(at.twist)) })
    }

    /// Fraction of a step at which a switch should end it, or `None` if the step may end where it does.
    pub fn crossing(&self, state: DogState, [start, end]: [&DogMotion; 2]) -> Option<f64> {
        let fraction = match state {
            (None, true) => self.engagement([start, end]),
            (Some(_), false) => self.disengagement([start.torque, end.torque]),
            _ => None,
        };
        fraction.filter(|fraction| (0.0..1.0).contains(fraction))
    }

    /// Fraction of a step at which the teeth are just within a gap and the speeds are close.
    fn engagement(&self, [start, end]: [&DogMotion; 2]) -> Option<f64> {
        let (rates, turned) = ([start.rate, end.rate], end.twist - start.twist);
        let slow = if rates[0].abs() <= self.most_speed {
            0.0
        } else {
            let limit = self.most_speed.copysign(rates[0]);
            if rates[1] * rates[0].signum() > self.most_speed {
                return None;
            }
            // just below the limit
            (rates[0] - (1.0 - WITHIN) * limit) / (rates[0] - rates[1])
        };
        let off = self.off_gap(start.twist + slow * turned);
        if off.abs() <= self.half_lash {
            // a step that ends within the range of speed and gap ends well
            let ends_well =
                self.margin((None, true), end) <= 0.0 && end.rate.abs() >= (1.0 - 2.0 * WITHIN) * self.most_speed;
            return Some(slow).filter(|&slow| slow > 0.0 && !ends_well);
        }
        let ahead = off * turned.signum();
        // way to the edge of the next gap
        let way = if ahead < 0.0 { -ahead } else { self.pitch - ahead } - self.half_lash;
        let past = turned.abs() * (1.0 - slow) - way;
        let lash = 2.0 * self.half_lash;
        (past > WITHIN * lash).then(|| slow + (way + 0.5 * WITHIN * lash) / turned.abs())
    }

    /// Fraction of a step at which the torque has fallen to its limit, given the torques at both ends.
    fn disengagement(&self, [start, end]: [f64; 2]) -> Option<f64> {
        let (limit, falls) = (self.most_torque, end * start.signum());
        let within = (1.0 - WITHIN) * limit..=limit;
        if start.abs() <= limit || falls > limit || within.contains(&falls) {
            return None;
        }
        Some((start.abs() - (1.0 - 0.5 * WITHIN) * limit) / (start.abs() - falls))
    }
}
