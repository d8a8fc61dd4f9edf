//! How strongly dry friction can hold a body, by what presses it.

use super::causes::Cause;

/// Hold on a side gear against the carrier: a limit torque made of a constant and of what the meshes press.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SideGrip {
    /// Constant part [N·m].
    pub constant: f64,
    /// Per thrust on the side gear [m].
    pub per_thrust: f64,
    /// Per torque of the meshes on the side gear.
    pub per_torque: f64,
    /// Stiffness while stuck [N·m/rad].
    pub stiffness: f64,
}

/// Hold on a planet against its pin and seat.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlanetGrip {
    /// Per force across the pin [m].
    pub per_pin_force: f64,
    /// Per thrust on the planet [m].
    pub per_thrust: f64,
    /// Stiffness while stuck [N·m/rad].
    pub stiffness: f64,
}

/// What one effect contributes to the hold on side gears and planets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grip {
    /// Where its heat is booked.
    pub cause: Cause,
    /// On each side gear.
    pub side: SideGrip,
    /// On each planet.
    pub planet: PlanetGrip,
    /// Limit while stuck over limit while sliding.
    pub static_ratio: f64,
}

impl Grip {
    /// Whether what the meshes press matters.
    pub fn depends_on_load(&self) -> bool {
        let (s, p) = (&self.side, &self.planet);
        [s.per_thrust, s.per_torque, p.per_pin_force, p.per_thrust].iter().any(|x| *x != 0.0)
    }

    /// The same pressed by a part of the force.
    pub fn scaled(self, part: f64) -> Self {
        let side = SideGrip {
            constant: part * self.side.constant,
            per_thrust: part * self.side.per_thrust,
            per_torque: part * self.side.per_torque,
            stiffness: part * self.side.stiffness,
        };
        let planet = PlanetGrip {
            per_pin_force: part * self.planet.per_pin_force,
            per_thrust: part * self.planet.per_thrust,
            stiffness: part * self.planet.stiffness,
        };
        Self { side, planet, ..self }
    }
}
