//! Where the body of a gear is held.

use super::cone::Held;
use crate::geometry::Pair;
use crate::numeric::sin;
use crate::problem::Problem;

/// A body without a bore is held this many modules below its root.
const DEPTH: f64 = 2.0;
/// Least thickness of the rim between bore and root [modules].
const THINNEST: f64 = 0.25;

/// How the body of a gear is held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Support {
    /// On the cone two modules below its root.
    NearRoot,
    /// On a bore of a diameter [m]; a solid body, 0, near its root.
    Bore(f64),
    /// The same, but the bore takes no torque: the body turns with the mean of its root.
    FreeBore(f64),
}

impl Support {
    /// Diameter that a bore of gear `i` of `pair` must stay below [m].
    pub fn widest(pair: &Pair, i: usize) -> f64 {
        let rim = THINNEST * pair.module * pair.inner_cone / pair.outer_cone;
        2.0 * (pair.inner_cone * sin(pair.gears[i].root) - rim)
    }

    /// Where gear `i` of `pair` is held; `name` is what a problem names.
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
                "a bore of {:.3} mm leaves no body below the teeth: it must be within 0 and {:.3} mm",
                diameter * 1e3,
                thickest * 1e3
            ));
        }
        Ok(Held::Cylinder(0.5 * diameter))
    }

    /// Whether it leaves the body free to turn.
    pub fn turns(self) -> bool {
        matches!(self, Self::FreeBore(_))
    }
}
