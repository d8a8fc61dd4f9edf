//! Effects on bodies: the motion that they depend on, and the forces and derivatives that they add.

use std::fmt::Debug;

use super::Loss;
use crate::integrate::Matrix;
use crate::model::scene::{Dogs, Inputs, Layout, Viscosity};

/// Positions and velocities of all degrees of freedom, and the commands of the host.
pub struct BodyMotion<'a> {
    /// Positions.
    pub q: &'a [f64],
    /// Velocities.
    pub v: &'a [f64],
    /// Index of each degree of freedom.
    pub layout: &'a Layout,
    /// Inputs.
    pub inputs: &'a Inputs,
    /// Rates of the inputs [per s].
    pub input_rates: &'a Inputs,
    /// State of the dog clutches.
    pub dogs: &'a Dogs,
    /// Viscosity of the oil, if an effect needs it.
    pub oil_viscosity: Option<Viscosity>,
}

/// Torques that springs carry at the start [N·m].
#[derive(Clone, Copy, Debug, Default)]
pub struct StaticLoads {
    /// Torque on the carrier from its drive.
    pub ring: f64,
    /// Torque of the propeller shaft, at the carrier's speed.
    pub propeller: f64,
    /// True if the speed of the drive is imposed.
    pub imposed: bool,
}

/// Forces and torques by degree of freedom, for a single planet of each group, and heat by cause.
pub struct Action<'a> {
    /// Sums of forces.
    pub force: &'a mut [f64],
    /// Heat rates by their index in the ledger [W].
    pub heat: &'a mut [f64],
}

/// Derivatives of the forces, row by row.
pub struct Slopes<'a> {
    /// Number of columns of the matrices.
    pub n: usize,
    /// ∂force/∂position.
    pub by_position: &'a mut [f64],
    /// ∂force/∂velocity.
    pub by_velocity: &'a mut [f64],
}

impl<'a> Slopes<'a> {
    /// Collects derivatives in these matrices.
    #[inline]
    pub fn new<const N: usize>([by_position, by_velocity]: [&'a mut Matrix<N>; 2]) -> Self {
        Self { n: N, by_position: by_position.as_flattened_mut(), by_velocity: by_velocity.as_flattened_mut() }
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

/// Effect that acts on bodies instead of teeth.
pub trait BodyEffect: Debug + Send + Sync {
    /// Adds forces and heat.
    fn act(&self, at: &BodyMotion, out: &mut Action);
    /// Adds the exact derivatives of the forces.
    fn slopes(&self, at: &BodyMotion, out: &mut Slopes);
    /// True if the effect is part of the structure that supports static loads.
    fn is_structure(&self) -> bool {
        false
    }
    /// Index of its heat in the ledger if it consists only of springs with dampers, `None` otherwise.
    fn heat_of_springs(&self) -> Option<usize> {
        None
    }
    /// Fraction of a step of `h` [s] after which its force has the first kink, if one is expected.
    fn kink(&self, _at: &BodyMotion, _h: f64) -> Option<f64> {
        None
    }
    /// Sets positions and velocities of its bodies so that it carries `loads` at rest relative to the carrier.
    fn wind_up(&self, _loads: &StaticLoads, _motion: [&mut [f64]; 2]) {}
    /// True if it acts on the pinion from in front of the mesh.
    fn is_in_front(&self) -> bool {
        false
    }
    /// Friction of the pinion in proportion to the torque of its mesh.
    fn loss(&self) -> Option<Loss> {
        None
    }
    /// Torque of an elastic mesh of pinion and ring gear at the carrier's speed [N·m].
    fn mesh_torque(&self, _at: &BodyMotion) -> Option<f64> {
        None
    }
    /// Derivatives of [`Self::mesh_torque`]: degrees of freedom with the derivatives by position and by velocity.
    fn mesh_slopes(&self, _at: &BodyMotion) -> [(usize, [f64; 2]); 2] {
        [(0, [0.0; 2]); 2]
    }
    /// Speed of the pinion over the speed of the drive at the start.
    fn speed_ratio(&self) -> f64 {
        1.0
    }
    /// Torque of a shaft on the pinion, at the carrier's speed [N·m].
    fn shaft_torque(&self, _at: &BodyMotion) -> Option<f64> {
        None
    }
    /// Torque on the carrier [N·m], given the torque `driven` that is left of the pinion's after acceleration and dry
    /// friction.
    fn carrier_torque(&self, _at: &BodyMotion, driven: f64) -> f64 {
        driven
    }
    /// Stored energy [J].
    fn energy(&self, _at: &BodyMotion) -> f64 {
        0.0
    }
}
