//! Support of a gear's body.

use super::cone::Held;
use crate::geometry::Pair;
use crate::numeric::sin;
use crate::problem::Problem;

/// A body without a bore is held this many modules below its root.
const DEPTH: f64 = 2.0;
/// Smallest rim thickness between bore and root [modules].
const THINNEST: f64 = 0.25;

/// Support of a gear's body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Support {
    /// The body is held on the cone two modules below its root.
    NearRoot,
    /// The body is held in a bore of this diameter [m]. A solid body, with diameter 0, is held near its root.
    Bore(f64),
    /// The body is held in a bore of this diameter [m] that transmits no torque. The body therefore turns with the mean
    /// rotation of its root.
    FreeBore(f64),
}

impl Support {
    /// Upper limit of the bore diameter of gear `i` of `pair`; the bore must be smaller [m].
    pub fn widest(pair: &Pair, i: usize) -> f64 {
        let rim = THINNEST * pair.module * pair.inner_cone / pair.outer_cone;
        2.0 * (pair.inner_cone * sin(pair.gears[i].root) - rim)
    }

    /// Returns the surface on which gear `i` of `pair` is held. Fails if the bore leaves no body below the teeth; the
    /// error names the variable `name`.
    pub fn held(self, pair: &Pair, i: usize, name: &'static str) -> Result<Held, Problem> {
        let root = pair.gears[i].root;
        let diameter = match self {
            Self::NearRoot | Self::Bore(0.0) | Self::FreeBore(0.0) => {
                return Ok(Held::Cone((root - DEPTH * pair.module / pair.outer_cone).max(0.25 * root)));
            }
            Self::Bore(diameter) | Self::FreeBore(diameter) => diameter,
        };
        let thickest = Self::widest(pair, i);
        if !(diameter > 0.0 && diameter < thickest) {
            return Err(problem!(
                name,
                "a bore of {:.3} mm leaves no body below the teeth; it must be between 0 and {:.3} mm",
                diameter * 1e3,
                thickest * 1e3
            ));
        }
        Ok(Held::Cylinder(0.5 * diameter))
    }

    /// True if the support leaves the body free to turn.
    pub fn is_free_to_turn(self) -> bool {
        matches!(self, Self::FreeBore(_))
    }
}
