//! What an effect on bodies sees, and what it adds.

use std::fmt::Debug;

use crate::integrate::Matrix;
use crate::model::scene::{Inputs, Layout, Viscosity};

/// Positions and velocities of all degrees of freedom, and what the host commands.
pub struct BodyMotion<'a> {
    /// Positions.
    pub q: &'a [f64],
    /// Velocities.
    pub v: &'a [f64],
    /// Index of each degree of freedom.
    pub layout: &'a Layout,
    /// Inputs.
    pub inputs: &'a Inputs,
    /// How fast they change [per s].
    pub input_rates: &'a Inputs,
    /// Viscosity of the oil, where effects ask for it.
    pub oil_viscosity: Option<Viscosity>,
}

/// Forces and torques by degree of freedom (on each planet singly), and heat by cause.
pub struct Action<'a> {
    /// Sums of forces.
    pub force: &'a mut [f64],
    /// Acceleration of a carrier whose motion is imposed, commanded so far [rad/s²].
    pub imposed: &'a mut f64,
    /// Torque of the carrier's drive beyond its command [N·m].
    pub drive: &'a mut f64,
    /// Heat by its index in the ledger [W].
    pub heat: &'a mut [f64],
}

/// Derivatives of the forces, row by row.
pub struct Slopes<'a> {
    /// Degrees of freedom in a row.
    pub n: usize,
    /// ∂force/∂position.
    pub by_position: &'a mut [f64],
    /// ∂force/∂velocity.
    pub by_velocity: &'a mut [f64],
    /// ∂(imposed acceleration of the carrier)/∂position and ∂/∂velocity.
    pub imposed: [&'a mut [f64]; 2],
}

impl<'a> Slopes<'a> {
    /// Derivatives that are added to these; `imposed` stands apart, so that the compiler knows what effects cannot touch.
    #[inline]
    pub fn new<const N: usize>(
        [by_position, by_velocity]: [&'a mut Matrix<N>; 2],
        imposed: &'a mut [[f64; N]; 2],
    ) -> Self {
        Self {
            n: N,
            by_position: by_position.as_flattened_mut(),
            by_velocity: by_velocity.as_flattened_mut(),
            imposed: imposed.each_mut().map(|row| row.as_mut_slice()),
        }
    }

    /// Adds to ∂force_i/∂position_j.
    #[inline]
    pub fn position(&mut self, i: usize, j: usize, value: f64) {
        self.by_position[i * self.n + j] += value;
    }

    /// Adds to ∂force_i/∂velocity_j.
    #[inline]
    pub fn velocity(&mut self, i: usize, j: usize, value: f64) {
        self.by_velocity[i * self.n + j] += value;
    }
}

/// An effect that acts on bodies, apart from the teeth.
pub trait BodyEffect: Debug + Send + Sync {
    /// Adds forces and heat.
    fn act(&self, at: &BodyMotion, out: &mut Action);
    /// Adds the exact derivatives of the forces.
    fn slopes(&self, at: &BodyMotion, out: &mut Slopes);
    /// Whether it is part of the structure that carries static loads.
    fn is_structure(&self) -> bool {
        false
    }
    /// Whether it scales the speed or the torque that the carrier is given.
    fn scales_carrier_inputs(&self) -> bool {
        false
    }
    /// Index of its heat in the ledger if it is nothing but the torques of half-shafts; `None` for all other effects.
    fn heat_of_half_shafts(&self) -> Option<usize> {
        None
    }
    /// Energy it stores [J].
    fn energy(&self, _at: &BodyMotion) -> f64 {
        0.0
    }
    /// Speed that an imposed carrier has instead of `command` [rad/s].
    fn carrier_speed(&self, _q: &[f64], command: f64) -> f64 {
        command
    }
}
