//! Dry friction on the pairs of one kind, combined from all its surfaces.

use super::{ActingSurface, RubbingSurface, SurfaceLoad};

/// Maximum number of surfaces of one pair: washer, clutch pack, its measured curve, and lock. The start of a simulation
/// checks it.
pub const MOST_SURFACES: usize = 4;

/// Limit torques of all surfaces, and the spring that holds the body.
#[derive(Clone, Copy, Debug)]
pub struct BodyFriction {
    surfaces: [ActingSurface; MOST_SURFACES],
    count: usize,
    /// True if the friction of any surface changes with slip.
    pub(super) varies_with_slip: bool,
    /// Sum of the stiffnesses of all surfaces [N·m/rad].
    pub stiffness: f64,
    /// Damping of the spring over its stiffness [s].
    pub(super) damping_time: f64,
    /// True if the limit torque is commanded. It may then fall while a body is held.
    pub(super) commanded: bool,
    /// Index of the heat that receives the spring's energy when the last surface is released.
    pub(super) released_heat_index: usize,
}

impl BodyFriction {
    /// No surfaces.
    pub const NONE: Self = Self {
        surfaces: [ActingSurface::NONE; MOST_SURFACES],
        count: 0,
        varies_with_slip: false,
        stiffness: 0.0,
        damping_time: 0.0,
        commanded: false,
        released_heat_index: 0,
    };

    /// No surfaces. `damping_time` [s] is the spring's damping over its stiffness.
    pub fn new(damping_time: f64, released_heat_index: usize) -> Self {
        Self { damping_time, released_heat_index, ..Self::NONE }
    }

    /// No surfaces, for a limit torque that is commanded.
    pub fn commanded(damping_time: f64, released_heat_index: usize) -> Self {
        Self { commanded: true, ..Self::new(damping_time, released_heat_index) }
    }

    /// Adds the surface number `index`, of which the fraction `pressed` acts with `factor` times its friction.
    /// `damping_time` [s] is the damping of its spring over its stiffness.
    pub fn push(&mut self, (index, surface): (u16, &RubbingSurface), [pressed, factor, damping_time]: [f64; 3]) {
        let limit = surface.limit.times(pressed * factor);
        self.surfaces[self.count] = ActingSurface { limit, heat_index: surface.heat_index, surface: index };
        self.count += 1;
        self.varies_with_slip |= surface.varies_with_slip();
        let stiffness = pressed * surface.stiffness;
        if stiffness > 0.0 {
            self.stiffness += stiffness;
            // dampings add up like stiffnesses; equal times remain exactly what they are
            self.damping_time += (damping_time - self.damping_time) * (stiffness / self.stiffness);
        }
    }

    /// Surfaces that act.
    pub fn surfaces(&self) -> &[ActingSurface] {
        &self.surfaces[..self.count]
    }

    /// True if any surface acts.
    pub fn is_on(&self) -> bool {
        self.count > 0
    }

    /// True if the limit torque depends on the loads of the meshes.
    pub fn depends_on_load(&self) -> bool {
        !self.commanded && self.surfaces().iter().any(|surface| surface.limit.varies())
    }

    /// Kinetic limit torque without its change over speed [N·m].
    pub fn limit(&self, by: &SurfaceLoad) -> f64 {
        self.surfaces().iter().map(|surface| surface.limit.at(by)).sum()
    }

    /// Derivatives of the limit torque with respect to thrust and load.
    pub(super) fn limit_slopes(&self) -> [f64; 2] {
        self.surfaces().iter().fold([0.0; 2], |[t, l], of| [t + of.limit.per_thrust, l + of.limit.per_load])
    }

    /// Returns the limit torque [N·m]. Adds `sliding` times the torque of each surface to the heat of its cause;
    /// `sliding` is the slip speed times the number of bodies [rad/s].
    pub(super) fn limit_with_heat(&self, sliding: f64, by: &SurfaceLoad, heat: &mut [f64]) -> f64 {
        self.surfaces().iter().fold(0.0, |limit, surface| {
            let torque = surface.limit.at(by);
            heat[surface.heat_index] += sliding * torque;
            limit + torque
        })
    }
}
