//! The signed coefficient of friction by any law, and the check of its published range.

use super::conditions::{limited, magnitude};
use super::{
    Conditions, FrictionLaw, LARGEST, Outside, ToothFrictionSpec, benedict_kelley, coulomb, iso14179, smooth,
    xu_kahraman,
};
use crate::numeric::Scalar;

/// Half-width of the transition around [`LARGEST`]. Coefficients up to 0.2 are unchanged.
const NEAR_LARGEST: f64 = 0.1;

/// Signed coefficient of friction h, odd in the sliding speed and within ±[`LARGEST`]. The friction force on surface 1
/// is −h times the normal force. Its heat, h·v times the normal force, is never negative.
pub fn signed_coefficient<T: Scalar>(spec: &ToothFrictionSpec, conditions: &Conditions<T>) -> T {
    let slowest = spec.slowest();
    if spec.law == FrictionLaw::CoulombStribeck {
        let v = limited(conditions.sliding);
        return coulomb::coefficient(spec, v) * (v / magnitude(v, slowest));
    }
    let at = conditions.regularised(slowest);
    let published = match spec.law {
        FrictionLaw::BenedictKelley => benedict_kelley::coefficient(spec, &at),
        FrictionLaw::Iso14179 => iso14179::coefficient(spec, &at),
        _ => xu_kahraman::coefficient(spec, &at),
    };
    smooth::ceiling(published, LARGEST, NEAR_LARGEST) * (limited(conditions.sliding) / at.sliding)
}

/// Returns the first quantity outside the published range of the chosen law, or `None`.
///
/// Every mesh passes the pitch point, at which the sliding speed is zero and no law was measured. This case is not
/// reported.
pub fn outside(spec: &ToothFrictionSpec, conditions: &Conditions<f64>) -> Option<Outside> {
    match spec.law {
        FrictionLaw::CoulombStribeck => None,
        law => {
            let at = conditions.regularised(spec.slowest());
            match law {
                FrictionLaw::BenedictKelley => benedict_kelley::outside(spec, &at),
                FrictionLaw::Iso14179 => iso14179::outside(&at),
                _ => xu_kahraman::outside(spec, &at),
            }
        }
    }
}
