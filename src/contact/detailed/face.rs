//! How evenly a pair's load is spread over its face, looked at between and beyond the slices too.
//!
//! A load per width w = ωR is what aligned teeth carry, ω the same at every R. Where errors or displacements open the flanks
//! by e(R), ω follows the law of a slice at the arc a − g − e(R)/R. The face load factor is the largest ω of the face over its
//! mean with the weight R², which is that of the torque:
//!
//!   K_Hβ = ω_max ∫R² dR / ∫ω R² dR
//!
//! The mean is the sum over the slices that the simulation makes, the largest that at the arc which is the largest of the
//! whole face. All openings are polynomials of second degree in R, so e/R is c₀/R + c₁ + c₂R: it is least at an end of
//! the face or at R² = c₀/c₂.

use super::Detailed;
use crate::contact::spring::Spring;
use crate::numeric::sqrt;

/// A loaded slice of the pair.
#[derive(Clone, Copy, Debug)]
pub struct KnownSlice {
    /// Cone distance [m].
    pub cone: f64,
    /// Penetration arc [rad].
    pub arc: f64,
    /// Place on the path [rad].
    pub s: f64,
}

impl<S: Spring> Detailed<S> {
    /// Moment ∫R² dR of the slices, by which ω is the torque of a pair [m³].
    pub fn moment_of_face(&self) -> f64 {
        self.whole
    }

    /// K_Hβ of the pair of which `known` is a loaded slice, by the elastic part of its load: damping is spread with it.
    ///
    /// `opening` is the gap at a cone distance [m], a polynomial of second degree on each of the `pieces` of the face [m].
    pub fn face_load_factor(&self, known: &KnownSlice, opening: impl Fn(f64) -> f64, pieces: &[[f64; 2]]) -> f64 {
        let approach = known.arc + opening(known.cone) / known.cone;
        let load = |open: f64| {
            let arc = approach - open;
            if arc > 0.0 { self.spring.at(arc, known.s).torque } else { 0.0 }
        };
        let torque: f64 = self.slices.iter().map(|j| j.weight * load(opening(j.cone) / j.cone)).sum();
        let least = pieces.iter().map(|&piece| least_arc(&opening, piece)).fold(f64::INFINITY, f64::min);
        let factor = load(least) * self.whole / torque;
        // written so that NaN gives 1
        if factor > 1.0 && factor.is_finite() { factor } else { 1.0 }
    }
}

/// The least arc e(R)/R [rad] on the closed interval of cone distances `[low, high]` [m] within which e is a polynomial of
/// second degree; its ends, where e may jump, are not evaluated.
fn least_arc(opening: impl Fn(f64) -> f64, [low, high]: [f64; 2]) -> f64 {
    let (middle, step) = (0.5 * (low + high), 0.25 * (high - low));
    let [a, b, c] = [middle - step, middle, middle + step].map(opening);
    // e = b + slope (R − middle) + half the curvature (R − middle)²
    let (slope, curve) = ((c - a) / (2.0 * step), (a - 2.0 * b + c) / (2.0 * step * step));
    let at = |r: f64| (b + (r - middle) * (slope + curve * (r - middle))) / r;
    let ends = at(low).min(at(high));
    let inner = sqrt((b - slope * middle) / curve + middle * middle);
    if inner > low && inner < high { ends.min(at(inner)) } else { ends }
}

#[cfg(test)]
mod tests {
    use super::least_arc;

    const FACE: [f64; 2] = [22.4e-3, 42.4e-3];

    #[test]
    fn the_least_arc_is_that_of_a_fine_search() {
        let middle = 0.5 * (FACE[0] + FACE[1]);
        for offset in [-3e-5, 0.0, 2e-5] {
            for lean in [-2e-3, 0.0, 1e-3] {
                for crown in [-4e-5, 0.0, 1e-5, 6e-5] {
                    let e = |r: f64| offset + lean * (r - middle) + crown * ((r - middle) / 10e-3).powi(2);
                    let search = (0..=20_000)
                        .map(|i| FACE[0] + (FACE[1] - FACE[0]) * f64::from(i) / 20_000.0)
                        .map(|r| e(r) / r)
                        .fold(f64::INFINITY, f64::min);
                    let found = least_arc(e, FACE);
                    assert!((found - search).abs() < 1e-10, "{offset} {lean} {crown}: {found} {search}");
                }
            }
        }
    }

    #[test]
    fn nothing_open_is_nothing_and_a_piece_without_width_is_left_out() {
        assert_eq!(least_arc(|_| 0.0, FACE), 0.0);
        assert_eq!(f64::INFINITY.min(least_arc(|_| 1e-5, [30e-3; 2])), f64::INFINITY);
    }
}
