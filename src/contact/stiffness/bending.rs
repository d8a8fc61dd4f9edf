//! Bending and shear of a loaded tooth as functions of the height y at which the load crosses the tooth's middle.
//!
//! With the chord s of the profile, integrals from the root section to y:
//! B = ∫(y−y')²/s³ dy', T = ∫(y−y')/s³ dy', M = ∫dy'/s³, S = ∫dy'/s. One pass over the profile stores them at the ends
//! of short panels. At y + h, B is B + 2hT + h²M plus the integral over h. A load therefore needs one panel instead of
//! the whole profile.

use std::sync::Arc;

use super::{Piece, Span};

/// Gauss–Legendre quadrature with four points (Abramowitz & Stegun, table 25.4): positive abscissae with their weights.
const GAUSS: [(f64, f64); 2] =
    [(0.339_981_043_584_856_3, 0.652_145_154_862_546_1), (0.861_136_311_594_052_6, 0.347_854_845_137_453_85)];
/// Largest rise of a panel [chords]. The chord of a pointed tooth is zero a little above the load.
const RISE: f64 = 1.0 / 16.0;
/// Smallest number of panels of a span.
const PANELS: f64 = 32.0;
/// Chord of a pointed tooth at which the last panel ends [root chords].
const MIN_CHORD: f64 = 1.0 / 64.0;
/// Largest number of Newton steps. Three suffice for a load on the flank.
const STEPS: usize = 16;
/// A Newton step below this fraction of a panel leaves an error of its square.
const CONVERGED: f64 = 1e-6;

/// Integrals B [1], T [1/m], M [1/m²] and S [1].
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    bending: f64,
    moment: f64,
    cubes: f64,
    shear: f64,
}

/// Short part of the profile: parameters and heights [m] of its ends, and the integrals from the root section to its
/// lower end.
#[derive(Clone, Copy, Debug)]
struct Panel {
    piece: Piece,
    u: [f64; 2],
    heights: [f64; 2],
    below: Sums,
}

impl Panel {
    /// Integrals from the root section to the height `top` [m] at the parameter `end`.
    fn sums(&self, end: f64, top: f64) -> Sums {
        let Sums { bending, moment, cubes, shear } = self.below;
        let (h, half) = (top - self.heights[0], 0.5 * (end - self.u[0]));
        let (bending, moment) = (bending + h * (2.0 * moment + h * cubes), moment + h * cubes);
        let mut sums = Sums { bending, moment, cubes, shear };
        for (x, weight) in GAUSS {
            for x in [-x, x] {
                let point = self.piece.at(self.u[0] + half * (1.0 + x));
                let (arm, per_chord) = (top - point.height, 0.5 / point.half_chord);
                let shear = weight * half * point.rise * per_chord;
                let cubes = shear * per_chord * per_chord;
                sums.bending += cubes * arm * arm;
                sums.moment += cubes * arm;
                sums.cubes += cubes;
                sums.shear += shear;
            }
        }
        sums
    }

    /// Parameter at the height `y` [m], by Newton's method. Above the panel, it is a parameter of the same piece.
    fn parameter(&self, y: f64) -> f64 {
        let ([from, to], [low, high]) = (self.u, self.heights);
        let mut u = from + (to - from) * (y - low) / (high - low);
        for _ in 0..STEPS {
            let point = self.piece.at(u);
            let step = (y - point.height) / point.rise;
            u += step;
            if step.abs() < CONVERGED * (to - from) {
                break;
            }
        }
        u
    }
}

/// B and S over the profile of a tooth.
#[derive(Clone, Debug, Default)]
pub struct Bending {
    panels: Arc<[Panel]>,
}

impl Bending {
    /// Integrates over the profile `spans`, from the root section with the chord `root_chord` [m] upward.
    pub fn new(spans: &[Span], root_chord: f64) -> Self {
        let (mut panels, mut below) = (Vec::new(), Sums::default());
        for &Span { piece, from, to } in spans {
            let (mut u, mut point) = (from, piece.at(from));
            while u < to && 2.0 * point.half_chord > MIN_CHORD * root_chord {
                let longest = (u + (to - from) / PANELS).min(to);
                // on a base circle, the flank does not rise at first
                let next = longest.min(u + RISE * 2.0 * point.half_chord / piece.at(longest).rise);
                let above = piece.at(next);
                let panel = Panel { piece, u: [u, next], heights: [point.height, above.height], below };
                below = panel.sums(next, above.height);
                panels.push(panel);
                (u, point) = (next, above);
            }
        }
        Self { panels: panels.into() }
    }

    /// B and S under a load that crosses the tooth's middle at the height `top` [m], not below the root section.
    pub fn at(&self, top: f64) -> [f64; 2] {
        let above = self.panels.partition_point(|panel| panel.heights[0] < top);
        let Some(panel) = self.panels[..above].last() else { return [0.0; 2] };
        let Sums { bending, shear, .. } = panel.sums(panel.parameter(top), top);
        [bending, shear]
    }
}
