//! What an effect contributes to the dry friction of a body: limit torques, by what presses the surfaces.

use super::{Pressed, PvLimit, SlipLaw, SlipSpec};
use crate::model::scene::Inputs;
use crate::model::thermal::{NODES, OIL};

/// Dry friction between a side gear and the carrier: a limit torque made of a constant and of the loads of the meshes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SideFriction {
    /// Constant part [N·m].
    pub constant: f64,
    /// Per thrust on the side gear [m].
    pub per_thrust: f64,
    /// Per torque of the meshes on the side gear.
    pub per_torque: f64,
    /// Stiffness while stuck [N·m/rad].
    pub stiffness: f64,
    /// Mean radius of the surface [m].
    pub radius: f64,
    /// What presses it.
    pub pressed: Pressed,
}

/// Dry friction between a planet and its pin and seat.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlanetFriction {
    /// Per force across the pin [m].
    pub per_pin_force: f64,
    /// Per thrust on the planet [m].
    pub per_thrust: f64,
    /// Stiffness while stuck [N·m/rad].
    pub stiffness: f64,
    /// Radii of pin and washer [m].
    pub radius: [f64; 2],
    /// What presses them.
    pub pressed: [Pressed; 2],
}

/// Dry friction between a wheel and the axle it turns on.
#[derive(Clone, Copy, Debug)]
pub struct WheelFriction {
    /// Limit torques of left and right wheel [N·m].
    pub limit: fn(&Inputs) -> [f64; 2],
    /// Stiffness while stuck [N·m/rad].
    pub stiffness: f64,
    /// Damping over stiffness while stuck, left and right [s].
    pub damping_time: [f64; 2],
    /// Mean radius of the surface [m].
    pub radius: f64,
    /// What presses it; the load is its limit torque.
    pub pressed: Pressed,
}

/// Where the temperature of a surface is found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SurfaceTemperature {
    /// At a node of the thermal network.
    Node(usize),
    /// It is given [K].
    Given(f64),
}

/// What one effect contributes to the dry friction of bodies.
#[derive(Clone, Copy, Debug)]
pub struct FrictionSource {
    /// Name of the effect.
    pub effect: &'static str,
    /// Index of its heat in the ledger.
    pub heat_index: usize,
    /// On each side gear.
    pub side: SideFriction,
    /// On each planet.
    pub planet: PlanetFriction,
    /// On the wheels.
    pub wheel: Option<WheelFriction>,
    /// Limit while stuck over limit while sliding.
    pub static_ratio: f64,
    /// How it slides.
    pub sliding: SlipSpec,
    /// Where its temperature is found.
    pub temperature: SurfaceTemperature,
    /// Whether the command of the lock presses it.
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
            static_ratio: 1.0,
            sliding: SlipSpec::default(),
            temperature: SurfaceTemperature::Node(OIL),
            by_lock: false,
        }
    }

    /// Its friction at the `temperatures` of all nodes [K], over that at the reference.
    pub fn factor(&self, temperatures: &[f64; NODES]) -> f64 {
        self.sliding.factor_at(match self.temperature {
            SurfaceTemperature::Node(node) => temperatures[node],
            SurfaceTemperature::Given(temperature) => temperature,
        })
    }

    /// Its friction by speed on a surface of the mean radius `radius` [m].
    pub fn law(&self, radius: f64) -> SlipLaw {
        let SlipSpec { stribeck_speed, slip_slope, .. } = self.sliding;
        SlipLaw { radius, excess: self.static_ratio - 1.0, stribeck_speed, slope: slip_slope }
    }

    /// The limit of p·v of a surface that is `pressed`, where friction changes at one.
    pub fn pv_limit(&self, pressed: Pressed) -> Option<(Pressed, PvLimit)> {
        let SlipSpec { pv_limit: limit, beyond_limit: beyond, .. } = self.sliding;
        Some((pressed, PvLimit { limit, beyond })).filter(|(_, limit)| limit.acts())
    }

    /// Whether the loads of the meshes matter.
    pub fn depends_on_load(&self) -> bool {
        let (s, p) = (&self.side, &self.planet);
        [s.per_thrust, s.per_torque, p.per_pin_force, p.per_thrust].iter().any(|x| *x != 0.0)
    }

    /// The same on side gears and planets, pressed by a part of the force.
    pub fn scaled(self, part: f64) -> Self {
        let side = SideFriction {
            constant: part * self.side.constant,
            per_thrust: part * self.side.per_thrust,
            per_torque: part * self.side.per_torque,
            stiffness: part * self.side.stiffness,
            pressed: self.side.pressed.times(part),
            ..self.side
        };
        let planet = PlanetFriction {
            per_pin_force: part * self.planet.per_pin_force,
            per_thrust: part * self.planet.per_thrust,
            stiffness: part * self.planet.stiffness,
            pressed: self.planet.pressed.map(|pressed| pressed.times(part)),
            ..self.planet
        };
        Self { side, planet, ..self }
    }
}
