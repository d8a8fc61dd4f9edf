//! The study's data and results: a passenger car's differential modelled in SolidWorks and simulated in Adams.
//!
//! Numbers as printed there, units in the names. Gear data, loads and contact constants are the FMU's start values.

/// The car: mass [kg].
pub const CAR_MASS: f64 = 1455.0;
/// Tyre radius [m].
pub const TYRE_RADIUS: f64 = 0.334;
/// Adhesion coefficient of the road.
pub const ADHESION: f64 = 0.7;
/// Share of the weight on the driven front axle.
pub const FRONT_SHARE: f64 = 0.5;
/// Acceleration of gravity [m/s²].
pub const GRAVITY: f64 = 9.81;

/// Vehicle speeds straight ahead and in the turn [km/h].
pub const VEHICLE_SPEED: [f64; 2] = [60.0, 20.0];
/// Carrier speeds used for them [deg/s].
pub const CARRIER_SPEED: [f64; 2] = [2861.0, 954.0];
/// Planet spin imposed in the turn [deg/s].
pub const PLANET_SPIN: f64 = 200.0;
/// Load on each half-shaft used [N·m].
pub const LOAD: f64 = 835.0;

/// Hertz stiffness as printed [N/mm^1.5].
pub const STIFFNESS_PRINTED: f64 = 5.47e4;
/// Contact stiffness as used [N/mm^1.5].
pub const STIFFNESS_USED: f64 = 5.77e5;

/// Speeds of left and right side gear straight ahead [deg/s].
pub const STRAIGHT_SPEEDS: [f64; 2] = [2858.0, 2859.0];
/// Speeds of left and right side gear in the turn [deg/s].
pub const TURNING_SPEEDS: [f64; 2] = [1082.0, 830.0];
/// Ripple of the speeds, either way [%].
pub const RIPPLE: f64 = 5.0;
/// Mean meshing force [N].
pub const FORCE: f64 = 2.3e4;
/// Meshing frequency claimed for driving straight ahead [Hz].
pub const MESH_FREQUENCY: f64 = 79.5;

/// Simulated time [s] and output interval [s].
pub const DURATION: f64 = 0.5;
/// Output interval [s].
pub const INTERVAL: f64 = 0.001;
