//! A tooth that bends too far, which ends a run: it would leave its gap.

use super::hints;
use crate::model::assembly::{Gears, Model};

/// A tooth bent beyond the limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExcessiveDeflection {
    /// Approach of the flanks, as an arc along the line of action [rad].
    pub deflection: f64,
    /// Planet of the mesh.
    pub planet: usize,
    /// Side gear of the mesh.
    pub side: usize,
}

impl ExcessiveDeflection {
    /// Which tooth bends how far, and what helps.
    pub fn message(&self, model: &Model) -> String {
        let (limit, cone) = match &model.gears {
            Gears::Teeth(teeth) => (teeth.deflection_limit, teeth.mesh.cone),
            Gears::Rigid(_) => (0.0, model.pair.mean_cone),
        };
        format!(
            "tooth deflection exceeds {} between planet[{}] and the {} side gear: {:.3} mm along the line of action, \
             at most {:.3} mm; reduce the load or {}",
            limit_name(model),
            self.planet + 1,
            ["left", "right"][self.side],
            self.deflection * cone * 1e3,
            limit * cone * 1e3,
            hints::stiffer_teeth(&model.parameters)
        )
    }
}

/// What limits the deflection of teeth.
pub fn limit_name(model: &Model) -> &'static str {
    if model.pair.working_depth() <= 0.5 * model.pair.base_pitch { "the working depth" } else { "half the base pitch" }
}
