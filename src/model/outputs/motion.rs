//! Motion of a differential.

use crate::model::scene::MAX_PLANETS;

/// Angles and speeds, read directly from the state.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion {
    /// Carrier angle since the start [rad].
    pub carrier_angle: f64,
    /// Carrier speed [rad/s].
    pub carrier_speed: f64,
    /// Angles of the pinion and of the port since the start [rad]: of the propeller shaft's driven end, or of the
    /// pinion. Without a final drive, both are the angle of the carrier.
    pub drive_angle: [f64; 2],
    /// Speeds of the pinion and of the port [rad/s].
    pub drive_speed: [f64; 2],
    /// Side gear angles, left and right [rad]. They are 0 as assembled, with teeth in mid-gap. They include movement
    /// within the backlash and deflection.
    pub side_angle: [f64; 2],
    /// Side gear speeds, left and right [rad/s].
    pub side_speed: [f64; 2],
    /// Angles of the wheels, left and right [rad]: of the half-shaft end if it is a separate body, and of the side gear
    /// otherwise.
    pub wheel_angle: [f64; 2],
    /// Speeds of the wheels, left and right [rad/s].
    pub wheel_speed: [f64; 2],
    /// Spin angles of the planets relative to the carrier since the start [rad].
    pub spin_angle: [f64; MAX_PLANETS],
    /// Spin speeds of the planets relative to the carrier [rad/s].
    pub spin_speed: [f64; MAX_PLANETS],
    /// Tooth engagements per second of one mesh [Hz].
    pub mesh_frequency: f64,
}
