//! Dry friction on one kind of body, combined from all sources.

use super::{FrictionPart, SurfaceLoad};

/// Maximum number of friction parts on one body: washer, clutch pack, its measured curve, and lock. The start of a
/// simulation checks it ([`super::Friction::part_count`]).
pub const PARTS: usize = 4;

/// Limit torques of all parts, and the spring that holds the body.
#[derive(Clone, Copy, Debug)]
pub struct BodyFriction {
    parts: [FrictionPart; PARTS],
    count: usize,
    /// True if the friction of any part changes with slip.
    pub(super) varies_with_slip: bool,
    /// Sum of the stiffnesses of all sources [N·m/rad].
    pub stiffness: f64,
    /// Damping of the spring over its stiffness [s].
    pub(super) damping_time: f64,
    /// True if the limit torque is commanded. It may then fall while a body is held.
    pub(super) commanded: bool,
    /// Index of the heat that receives the spring's energy when the last source is switched off.
    pub(super) released_heat_index: usize,
}

impl BodyFriction {
    /// Friction without sources.
    pub const NONE: Self = Self {
        parts: [FrictionPart::NONE; PARTS],
        count: 0,
        varies_with_slip: false,
        stiffness: 0.0,
        damping_time: 0.0,
        commanded: false,
        released_heat_index: 0,
    };

    /// Friction without sources. `damping_time` [s] is the spring's damping over its stiffness.
    pub fn new(damping_time: f64, released_heat_index: usize) -> Self {
        Self { damping_time, released_heat_index, ..Self::NONE }
    }

    /// Friction without sources, for a limit torque that is commanded.
    pub fn commanded(damping_time: f64, released_heat_index: usize) -> Self {
        Self { commanded: true, ..Self::new(damping_time, released_heat_index) }
    }

    /// Adds parts that share a spring of `stiffness` [N·m/rad] with the damping `damping_time` [s] over its stiffness.
    /// `varies_with_slip` is true if their friction changes with slip.
    pub fn push(&mut self, parts: &[FrictionPart], (stiffness, damping_time): (f64, f64), varies_with_slip: bool) {
        if stiffness > 0.0 {
            self.parts[self.count..self.count + parts.len()].copy_from_slice(parts);
            self.count += parts.len();
            self.varies_with_slip |= varies_with_slip;
            self.stiffness += stiffness;
            // dampings add up like stiffnesses; equal times remain exactly what they are
            self.damping_time += (damping_time - self.damping_time) * (stiffness / self.stiffness);
        }
    }

    /// Parts of all sources.
    pub fn parts(&self) -> &[FrictionPart] {
        &self.parts[..self.count]
    }

    /// True if there is any source.
    pub fn is_on(&self) -> bool {
        self.count > 0
    }

    /// True if the limit torque depends on loads.
    pub fn depends_on_load(&self) -> bool {
        self.parts().iter().any(|p| p.per_thrust != 0.0 || p.per_load != 0.0)
    }

    /// Kinetic limit torque without its change over speed [N·m].
    pub fn limit(&self, by: &SurfaceLoad) -> f64 {
        self.parts().iter().map(|p| p.at(by)).sum()
    }

    /// Derivatives of the limit torque with respect to thrust and load.
    pub(super) fn limit_slopes(&self) -> [f64; 2] {
        self.parts().iter().fold([0.0; 2], |[t, l], p| [t + p.per_thrust, l + p.per_load])
    }

    /// Returns the limit torque [N·m]. Adds `sliding` times the torque of each part to the heat of its cause; `sliding`
    /// is the slip speed times the number of bodies [rad/s].
    pub(super) fn limit_with_heat(&self, sliding: f64, by: &SurfaceLoad, heat: &mut [f64]) -> f64 {
        self.parts().iter().fold(0.0, |limit, part| {
            let torque = part.at(by);
            heat[part.heat_index] += sliding * torque;
            limit + torque
        })
    }
}
