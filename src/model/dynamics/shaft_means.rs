//! Means of the shaft torques over whole mesh cycles, from which the torque bias follows.

use serde::{Deserialize, Serialize};

use crate::numeric::finite;

/// Time integrals of the shaft torques over the present mesh cycle, and their means over the last whole cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TorqueMeans {
    /// ∫T dt of left and right since the mesh cycle began [N·m·s].
    pub sum: [f64; 2],
    /// Time since the mesh cycle began [s].
    pub elapsed: f64,
    /// Fraction of a mesh cycle rolled since the mesh cycle began; negative if rolled backward.
    pub cycles: f64,
    /// Means over the last whole mesh cycle [N·m], and its duration [s].
    pub last: Option<([f64; 2], f64)>,
    /// Time since the last whole cycle ended [s].
    pub since: f64,
}

finite!(TorqueMeans { sum, elapsed, cycles, last, since });

impl TorqueMeans {
    /// Means over the last whole mesh cycle [N·m], or `None` if rolling has nearly stopped since.
    pub fn mean(&self) -> Option<[f64; 2]> {
        self.last.filter(|(_, took)| self.since <= 2.0 * took).map(|(mean, _)| mean)
    }
}

/// Counter of mesh cycles, which stores the means of shaft torques over whole cycles.
///
/// Cycles begin at the position of the start, and at whole pitches from it. Forward and backward rolling therefore
/// divide time identically, and so does a differential with exchanged sides.
pub struct CycleCounter {
    /// Pitch of a side gear [rad].
    pub pitch: f64,
}

impl CycleCounter {
    /// Adds the impulses `torque` [N·m·s] of a step of size `h` [s]. Left and right side gear turned by `turned` [rad]
    /// relative to the carrier. Half the difference of both angles is the rolling angle, which does not contain
    /// deflections of the teeth.
    pub fn add(&self, means: &mut TorqueMeans, turned: [f64; 2], h: f64, torque: [f64; 2]) {
        let by = 0.5 * (turned[0] - turned[1]) / self.pitch;
        let cycles = means.cycles + by;
        let whole = libm::trunc(cycles);
        // a new cycle begins at the end of a cycle, and when rolling returns past its beginning
        let begins = whole != 0.0 || cycles * means.cycles < 0.0;
        let mut left = 1.0;
        if begins {
            let before = ((whole - means.cycles) / by).clamp(0.0, 1.0);
            left = 1.0 - before;
            let time = means.elapsed + before * h;
            if whole != 0.0 {
                let mean = [0, 1].map(|s| (means.sum[s] + before * torque[s]) / time);
                (means.last, means.since) = (Some((mean, time)), -before * h);
            }
            *means = TorqueMeans { last: means.last, since: means.since, ..TorqueMeans::default() };
        }
        means.cycles = cycles - whole;
        means.elapsed += left * h;
        means.since += h;
        for s in 0..2 {
            means.sum[s] += left * torque[s];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rolls through the positions `places`, in cycles, with steps of 0.1 s. Torques are `torque` at the middle of each
    /// step.
    fn rolled(places: &[f64], torque: impl Fn(f64) -> [f64; 2]) -> TorqueMeans {
        let (cycle, mut means) = (CycleCounter { pitch: 2.0 }, TorqueMeans::default());
        for pair in places.windows(2) {
            let by = 2.0 * (pair[1] - pair[0]);
            cycle.add(&mut means, [by, -by], 0.1, torque(0.5 * (pair[0] + pair[1])).map(|t| 0.1 * t));
        }
        means
    }

    #[test]
    fn a_whole_cycle_in_either_direction_from_any_position_gives_its_means() {
        for (sign, begin) in [(1.0, 0.0), (-1.0, 0.0), (1.0, 0.37), (-1.0, 0.37)] {
            let places: Vec<f64> = (0..30).map(|i| sign * (begin + 0.1 * f64::from(i))).collect();
            let ([left, right], took) = rolled(&places, |_| [7.0, 3.0]).last.unwrap();
            assert!((left - 7.0).abs() < 1e-12 && (right - 3.0).abs() < 1e-12 && (took - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn rolling_backward_is_counted_like_rolling_forward() {
        // uneven steps, a ripple that the means depend on, and a return past the beginning
        let steps = (0..80).map(|i| if i < 9 { -0.03 } else { 0.04 + 0.01 * f64::from(i % 7) });
        let places: Vec<f64> = steps.scan(0.0, |at, by| Some(std::mem::replace(at, *at + by))).collect();
        let mirrored: Vec<f64> = places.iter().map(|x| -x).collect();
        let ripple = |x: f64| [5.0 + (7.0 * x).sin(), 4.0 + (5.0 * x).cos()];
        let (forward, backward) = (rolled(&places, ripple), rolled(&mirrored, |x| ripple(-x)));
        assert!(forward.last.is_some());
        assert_eq!(backward, TorqueMeans { cycles: -forward.cycles, ..forward });
    }

    #[test]
    fn a_step_over_several_cycles_gives_their_common_mean() {
        let means = rolled(&[0.0, 0.25, 3.25], |x| if x < 0.2 { [8.0, 0.0] } else { [2.0, 0.0] });
        let ([left, _], took) = means.last.unwrap();
        // 0.1 s up to 0.25 cycles, and 2.75/3 of another 0.1 s up to 3 cycles
        let second = 0.1 * 2.75 / 3.0;
        assert!((took - (0.1 + second)).abs() < 1e-15);
        assert!((left - (0.1 * 8.0 + second * 2.0) / took).abs() < 1e-12);
        assert!((means.cycles - 0.25).abs() < 1e-15 && (means.elapsed - (0.1 - second)).abs() < 1e-15);
    }

    #[test]
    fn an_oscillation_about_a_cycle_boundary_counts_no_cycle() {
        let places: Vec<f64> = (0..30).map(|i| if i % 2 == 0 { 1e-9 } else { -1e-9 }).collect();
        assert_eq!(rolled(&places, |_| [7.0, 3.0]).last, None);
        // rolling forward and back to the start counts no cycle either
        assert_eq!(rolled(&[-0.1, 0.1, 0.5, 0.8, 0.5, 0.1, -0.1], |_| [7.0, 3.0]).last, None);
    }

    #[test]
    fn means_are_kept_until_rolling_has_nearly_stopped() {
        let mut places = vec![0.0, 0.5, 1.0, 1.5, 2.0, 2.1];
        assert!(rolled(&places, |_| [7.0, 3.0]).mean().is_some());
        // an oscillation about the end of the last cycle does not renew them
        places.extend((0..5).map(|i| if i % 2 == 0 { 1.9 } else { 2.1 }));
        assert_eq!(rolled(&places, |_| [7.0, 3.0]).mean(), None);
    }
}
