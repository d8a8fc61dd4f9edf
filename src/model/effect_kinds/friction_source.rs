//! Contribution of an effect to the dry friction of bodies: limit torques that depend on the loads on the surfaces.

use super::dry_friction::DAMPING_TIME;
use super::{Pressed, PvLimit, Ramps, SlipLaw, SlipSpec, TorqueCurve};
use crate::model::scene::Inputs;
use crate::model::thermal::{NODES, OIL};

/// Dry friction between a side gear and the carrier. The limit torque is a constant plus parts in proportion to the
/// mesh loads.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SideFriction {
    /// Constant torque [N·m].
    pub constant: f64,
    /// Torque per thrust on the side gear [m].
    pub per_thrust: f64,
    /// Torque per mesh torque that presses the surface.
    pub per_torque: f64,
    /// Parts that convert mesh torque to pressure.
    pub ramps: Ramps,
    /// Torque over slip in addition, with a breakaway torque.
    pub curve: Option<TorqueCurve>,
    /// Stiffness while stuck [N·m/rad].
    pub stiffness: f64,
    /// Mean radius of the surface [m].
    pub radius: f64,
    /// Pressure on the surface.
    pub pressed: Pressed,
}

/// Dry friction between a planet and its pin and seat.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlanetFriction {
    /// Torque per force across the pin [m].
    pub per_pin_force: f64,
    /// Torque per thrust on the planet [m].
    pub per_thrust: f64,
    /// Stiffness while stuck [N·m/rad].
    pub stiffness: f64,
    /// Radii of pin and washer [m].
    pub radius: [f64; 2],
    /// Pressures on pin and washer.
    pub pressed: [Pressed; 2],
}

/// Dry friction of a brake, between a wheel and the ground.
#[derive(Clone, Copy, Debug)]
pub struct WheelFriction {
    /// Function that returns the limit torques of left and right wheel [N·m].
    pub limit: fn(&Inputs) -> [f64; 2],
    /// Stiffness while stuck [N·m/rad].
    pub stiffness: f64,
    /// Damping over stiffness while stuck, left and right [s].
    pub damping_time: [f64; 2],
    /// Mean radius of the surface [m].
    pub radius: f64,
    /// Pressure on the surface, whose load is the limit torque.
    pub pressed: Pressed,
}

/// Surfaces that a source may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SurfaceKind {
    /// Surface between side gear and carrier.
    Side,
    /// Surface between side gear and carrier, with a torque from a measured curve.
    SideCurve,
    /// Surface between a planet and its pin.
    Pin,
    /// Surface of a planet's washer.
    PlanetWasher,
    /// Surface of a wheel's brake.
    Wheel,
}

/// Origin of the temperature of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SurfaceTemperature {
    /// Temperature of a node of the thermal network.
    Node(usize),
    /// Given temperature [K].
    Given(f64),
}

/// Contribution of one effect to the dry friction of bodies.
#[derive(Clone, Copy, Debug)]
pub struct FrictionSource {
    /// Name of the effect.
    pub effect: &'static str,
    /// Index of its heat in the ledger.
    pub heat_index: usize,
    /// Friction on each side gear.
    pub side: SideFriction,
    /// Friction on each planet.
    pub planet: PlanetFriction,
    /// Friction on the wheels.
    pub wheel: Option<WheelFriction>,
    /// Damping of the springs on side gears and planets over their stiffness [s].
    pub damping_time: f64,
    /// Parameters of sliding.
    pub sliding: SlipSpec,
    /// Origin of the temperature of its surfaces.
    pub temperature: SurfaceTemperature,
    /// True if the command of the lock presses the surfaces.
    pub by_lock: bool,
}

impl FrictionSource {
    /// No friction; its heat has the index `heat_index`.
    pub fn new(heat_index: usize) -> Self {
        let (side, planet) = (SideFriction::default(), PlanetFriction::default());
        Self {
            effect: "",
            heat_index,
            side,
            planet,
            wheel: None,
            damping_time: DAMPING_TIME,
            sliding: SlipSpec::default(),
            temperature: SurfaceTemperature::Node(OIL),
            by_lock: false,
        }
    }

    /// Friction at the `temperatures` of all nodes [K], relative to the friction at the reference temperature.
    pub fn factor(&self, temperatures: &[f64; NODES]) -> f64 {
        self.sliding.factor_at(match self.temperature {
            SurfaceTemperature::Node(node) => temperatures[node],
            SurfaceTemperature::Given(temperature) => temperature,
        })
    }

    /// Mean radius of a surface [m], and the pressure on it.
    fn surface(&self, kind: SurfaceKind) -> (f64, Pressed) {
        let PlanetFriction { radius: [pin, washer], pressed: [on_pin, on_washer], .. } = self.planet;
        match kind {
            SurfaceKind::Side => (self.side.radius, self.side.pressed),
            // the load behind a measured torque is unknown
            SurfaceKind::SideCurve => (0.0, Pressed::NONE),
            SurfaceKind::Pin => (pin, on_pin),
            SurfaceKind::PlanetWasher => (washer, on_washer),
            SurfaceKind::Wheel => self.wheel.map_or((0.0, Pressed::NONE), |wheel| (wheel.radius, wheel.pressed)),
        }
    }

    /// Law of friction over slip speed on a surface.
    pub fn law(&self, kind: SurfaceKind) -> SlipLaw {
        let SlipSpec { stribeck_speed, slip_slope, .. } = self.sliding;
        SlipLaw {
            radius: self.surface(kind).0,
            excess: self.sliding.static_ratio - 1.0,
            stribeck_speed,
            slope: slip_slope,
        }
    }

    /// Pressure on a surface.
    pub fn pressed(&self, kind: SurfaceKind) -> Pressed {
        self.surface(kind).1
    }

    /// Limit of p·v at which friction changes, if there is one.
    pub fn pv_limit(&self) -> Option<PvLimit> {
        let SlipSpec { pv_limit: limit, beyond_limit: beyond, .. } = self.sliding;
        Some(PvLimit { limit, beyond }).filter(PvLimit::acts)
    }

    /// True if friction changes with slip.
    pub fn varies_with_slip(&self) -> bool {
        !self.law(SurfaceKind::Side).is_constant() || self.pv_limit().is_some() || self.side.curve.is_some()
    }

    /// True if friction depends on the loads of the meshes.
    pub fn depends_on_load(&self) -> bool {
        let (s, p) = (&self.side, &self.planet);
        [s.per_thrust, s.per_torque, p.per_pin_force, p.per_thrust].iter().any(|x| *x != 0.0)
    }
}
