//! Dry friction on one kind of body, from all sources together.

use super::{FrictionPart, SurfaceLoad};

/// Most parts of the friction on one body.
pub const PARTS: usize = 3;

/// Limit torques of all parts, and the spring that holds the body.
#[derive(Clone, Copy, Debug)]
pub struct BodyFriction {
    parts: [FrictionPart; PARTS],
    count: usize,
    /// Whether the friction of any part changes with slip.
    pub(super) feels_slip: bool,
    /// Stiffness of all sources together [N·m/rad].
    pub stiffness: f64,
    /// Damping of the spring over its stiffness [s].
    pub(super) damping_time: f64,
    /// Whether the limit torque is a command: it may fall while a body is held.
    pub(super) commanded: bool,
    /// Index of the heat to which the spring's energy goes when the last source is switched off.
    pub(super) released_heat_index: usize,
}

impl BodyFriction {
    /// No source.
    pub const NONE: Self = Self {
        parts: [FrictionPart::NONE; PARTS],
        count: 0,
        feels_slip: false,
        stiffness: 0.0,
        damping_time: 0.0,
        commanded: false,
        released_heat_index: 0,
    };

    /// No source yet. `damping_time` [s] is the spring's damping over its stiffness.
    pub fn new(damping_time: f64, released_heat_index: usize) -> Self {
        Self { damping_time, released_heat_index, ..Self::NONE }
    }

    /// The same for a limit torque that is a command.
    pub fn commanded(damping_time: f64, released_heat_index: usize) -> Self {
        Self { commanded: true, ..Self::new(damping_time, released_heat_index) }
    }

    /// Adds parts that share a spring of `stiffness` [N·m/rad]; `feels_slip`: their friction changes with slip.
    pub fn push(&mut self, parts: &[FrictionPart], stiffness: f64, feels_slip: bool) {
        if stiffness > 0.0 && self.count + parts.len() <= PARTS {
            self.parts[self.count..self.count + parts.len()].copy_from_slice(parts);
            self.count += parts.len();
            self.feels_slip |= feels_slip;
            self.stiffness += stiffness;
        }
    }

    /// Parts of all sources.
    pub fn parts(&self) -> &[FrictionPart] {
        &self.parts[..self.count]
    }

    /// Whether there is any source.
    pub fn is_on(&self) -> bool {
        self.count > 0
    }

    /// Whether the limit torque depends on loads.
    pub fn depends_on_load(&self) -> bool {
        self.parts().iter().any(|p| p.per_thrust != 0.0 || p.per_load != 0.0)
    }

    /// Kinetic limit torque before any change with speed [N·m].
    pub fn limit(&self, by: &SurfaceLoad) -> f64 {
        self.parts().iter().map(|p| p.at(by)).sum()
    }

    /// Slopes of the limit torque by thrust and load.
    pub(super) fn limit_slopes(&self) -> [f64; 2] {
        self.parts().iter().fold([0.0; 2], |[t, l], p| [t + p.per_thrust, l + p.per_load])
    }

    /// The limit torque [N·m]. Adds `sliding` times the torque of each part to the heat of its cause.
    pub(super) fn rub(&self, sliding: f64, by: &SurfaceLoad, heat: &mut [f64]) -> f64 {
        self.parts().iter().fold(0.0, |limit, part| {
            let torque = part.at(by);
            heat[part.heat_index] += sliding * torque;
            limit + torque
        })
    }
}
