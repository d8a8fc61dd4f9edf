//! Means of the shaft torques over whole mesh cycles: what the torque bias is read from.

use crate::model::dynamics::bias::Bias;

/// Detects the boundaries of mesh cycles, and keeps the means of shaft torques over whole ones.
///
/// Wrapping takes out whole pitches, so that the boundaries of cycles stay where they are.
pub struct Cycle {
    /// Pitch of the planet [rad].
    pub pitch: f64,
}

/// Cycles that separate a completed one from a return to its beginning.
const HALF: f64 = 0.5;

impl Cycle {
    /// Adds the impulses `torque` [N·m·s] of a step of size `h` in which the planet went from one position to another.
    pub fn add(&self, bias: &mut Bias, position: [f64; 2], h: f64, torque: [f64; 2]) {
        let place = position.map(|q| q / self.pitch);
        let cycle = place.map(libm::floor);
        let mut left = 1.0;
        if cycle[0] != cycle[1] {
            // the part of the step before the boundary belongs to the cycle that ends
            let boundary = cycle[0].max(cycle[1]);
            let part = ((boundary - place[0]) / (place[1] - place[0])).clamp(0.0, 1.0);
            let time = bias.time + part * h;
            let sum = [0, 1].map(|s| bias.sum[s] + part * torque[s]);
            // a planet that returns to where the cycle began has not completed it
            if bias.whole && (bias.rolled + boundary - place[0]).abs() > HALF {
                bias.last = Some((sum.map(|x| x / time), time));
            }
            *bias = Bias { whole: true, last: bias.last, ..Bias::default() };
            bias.rolled = place[1] - boundary;
            left = 1.0 - part;
        } else {
            bias.rolled += place[1] - place[0];
        }
        bias.time += left * h;
        for s in 0..2 {
            bias.sum[s] += left * torque[s];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rolls from place to place in steps of 0.1 s under the torques `torque`.
    fn rolled(places: &[f64], torque: [f64; 2]) -> Bias {
        let (cycle, mut bias) = (Cycle { pitch: 1.0 }, Bias::default());
        for pair in places.windows(2) {
            cycle.add(&mut bias, [pair[0], pair[1]], 0.1, torque.map(|t| 0.1 * t));
        }
        bias
    }

    #[test]
    fn a_whole_cycle_either_way_gives_its_means() {
        for sign in [1.0, -1.0] {
            let places: Vec<f64> = (0..30).map(|i| sign * (0.05 + 0.1 * f64::from(i))).collect();
            let ([left, right], took) = rolled(&places, [7.0, 3.0]).last.unwrap();
            assert!((left - 7.0).abs() < 1e-12 && (right - 3.0).abs() < 1e-12 && (took - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn trembling_about_a_boundary_is_no_cycle() {
        let places: Vec<f64> = (0..30).map(|i| if i % 2 == 0 { 1e-9 } else { -1e-9 }).collect();
        assert_eq!(rolled(&places, [7.0, 3.0]).last, None);
        // nor is a way out and back again that ends where it began
        assert_eq!(rolled(&[-0.1, 0.1, 0.5, 0.9, 0.5, 0.1, -0.1], [7.0, 3.0]).last, None);
    }
}
