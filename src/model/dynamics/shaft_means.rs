//! Means of the shaft torques over whole mesh cycles, from which the torque bias follows.

use serde::{Deserialize, Serialize};

use crate::integrate::Curve;
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

/// Rolling and torques within a completed step, as curves over the step.
pub struct StepCurves {
    /// Position of rolling in mesh cycles, from any origin.
    pub rolling: Curve,
    /// Torques of left and right half-shaft [N·m].
    pub torque: [Curve; 2],
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
    /// Position of rolling in mesh cycles, from the angles of left and right side gear relative to the carrier [rad].
    /// Half the difference of both angles is the rolling angle, which does not contain deflections of the teeth.
    pub fn rolling(&self, [left, right]: [f64; 2]) -> f64 {
        0.5 * (left - right) / self.pitch
    }

    /// Adds the impulses `torque` [N·m·s] of a step of size `h` [s]. The side gears turned by `turned` [rad] relative
    /// to the carrier. If a cycle begins within the step, `curves` divides the step there.
    #[inline]
    pub fn add(
        &self,
        means: &mut TorqueMeans,
        turned: [f64; 2],
        (h, torque): (f64, [f64; 2]),
        curves: impl FnOnce() -> StepCurves,
    ) {
        let cycles = means.cycles + self.rolling(turned);
        // a new cycle begins at the end of a cycle, and when rolling returns past its beginning
        if libm::trunc(cycles) != 0.0 || cycles * means.cycles < 0.0 {
            means.divide(cycles, h, &curves());
            return;
        }
        means.cycles = cycles;
        means.elapsed += h;
        means.since += h;
        for s in 0..2 {
            means.sum[s] += torque[s];
        }
    }
}

impl TorqueMeans {
    /// Adds a step of size `h` [s] at whose end `cycles` have been rolled since the mesh cycle began. A step may
    /// contain any number of whole cycles; only the last one gives means.
    #[inline(never)]
    fn divide(&mut self, cycles: f64, h: f64, StepCurves { rolling, torque }: &StepCurves) {
        let begin = rolling.at(0.0) - self.cycles;
        let whole = libm::trunc(cycles);
        let mut from = 0.0;
        if cycles * self.cycles < 0.0 {
            from = rolling.crossing(begin, [from, 1.0]);
            self.restart();
        }
        if whole != 0.0 {
            if whole.abs() > 1.0 {
                from = rolling.crossing(begin + (whole - whole.signum()), [from, 1.0]);
                self.restart();
            }
            let to = rolling.crossing(begin + whole, [from, 1.0]);
            let (before, within) = (self.elapsed, (to - from) * h);
            // a cycle that the position does not resolve has the torque at its end
            let share = if before + within > 0.0 { within / (before + within) } else { 1.0 };
            let mean = [0, 1].map(|s| {
                let earlier = if before > 0.0 { self.sum[s] / before } else { 0.0 };
                (1.0 - share) * earlier + share * torque[s].mean([from, to])
            });
            (self.last, self.since) = (Some((mean, before + within)), -to * h);
            self.restart();
            from = to;
        }
        self.cycles = cycles - whole;
        self.elapsed += (1.0 - from) * h;
        self.since += h;
        for s in 0..2 {
            self.sum[s] += (1.0 - from) * h * torque[s].mean([from, 1.0]);
        }
    }

    /// Starts the mesh cycle again.
    fn restart(&mut self) {
        (self.sum, self.elapsed) = ([0.0; 2], 0.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rolls through `positions`, in cycles, with steps of 0.1 s. Torques are `torque` at the middle of
    /// each step.
    fn rolled(positions: &[f64], torque: impl Fn(f64) -> [f64; 2]) -> TorqueMeans {
        let (cycle, mut means) = (CycleCounter { pitch: 2.0 }, TorqueMeans::default());
        for pair in positions.windows(2) {
            let by = 2.0 * (pair[1] - pair[0]);
            let torque = torque(0.5 * (pair[0] + pair[1]));
            cycle.add(&mut means, [by, -by], (0.1, torque.map(|t| 0.1 * t)), || StepCurves {
                rolling: Curve::line(pair[0], pair[1]),
                torque: torque.map(|t| Curve::line(t, t)),
            });
        }
        means
    }

    #[test]
    fn a_whole_cycle_in_either_direction_from_any_position_gives_its_means() {
        for (sign, begin) in [(1.0, 0.0), (-1.0, 0.0), (1.0, 0.37), (-1.0, 0.37)] {
            let positions: Vec<f64> = (0..30).map(|i| sign * (begin + 0.1 * f64::from(i))).collect();
            let ([left, right], took) = rolled(&positions, |_| [7.0, 3.0]).last.unwrap();
            assert!((left - 7.0).abs() < 1e-12 && (right - 3.0).abs() < 1e-12 && (took - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn rolling_backward_is_counted_like_rolling_forward() {
        // uneven steps, a ripple that the means depend on, and a return past the beginning
        let steps = (0..80).map(|i| if i < 9 { -0.03 } else { 0.04 + 0.01 * f64::from(i % 7) });
        let positions: Vec<f64> = steps.scan(0.0, |at, by| Some(std::mem::replace(at, *at + by))).collect();
        let mirrored: Vec<f64> = positions.iter().map(|x| -x).collect();
        let ripple = |x: f64| [5.0 + (7.0 * x).sin(), 4.0 + (5.0 * x).cos()];
        let (forward, backward) = (rolled(&positions, ripple), rolled(&mirrored, |x| ripple(-x)));
        assert!(forward.last.is_some());
        assert_eq!(backward, TorqueMeans { cycles: -forward.cycles, ..forward });
    }

    /// Adds a step of 1 s from `start` to `end`, in cycles, in which torques follow `torque`.
    fn stepped(means: &mut TorqueMeans, [start, end]: [f64; 2], torque: [Curve; 2]) {
        let turned = 2.0 * (end - start);
        let impulse = torque.map(|curve| curve.mean([0.0, 1.0]));
        CycleCounter { pitch: 2.0 }
            .add(means, [turned, -turned], (1.0, impulse), || StepCurves { rolling: Curve::line(start, end), torque });
    }

    #[test]
    fn a_step_over_several_cycles_gives_the_mean_of_the_last() {
        for sign in [1.0, -1.0] {
            let mut means = TorqueMeans::default();
            // the torque falls by 200 N·m per cycle
            stepped(&mut means, [0.0, 3.25 * sign], [Curve::line(1000.0, 350.0), Curve::line(7.0, 7.0)]);
            let ([left, right], took) = means.last.unwrap();
            assert!((left - 500.0).abs() < 1e-9 && (right - 7.0).abs() < 1e-12, "{left} {right}");
            assert!((took - 1.0 / 3.25).abs() < 1e-12 && (means.since - 0.25 / 3.25).abs() < 1e-12);
            assert!((means.cycles - 0.25 * sign).abs() < 1e-15);
            assert!((means.sum[0] - 0.25 / 3.25 * 375.0).abs() < 1e-9);
        }
    }

    #[test]
    fn the_size_of_the_steps_does_not_change_the_means() {
        // torque and position over 1 s, in one step and in 17
        let (torque, path) = (|t: f64| 900.0 - 500.0 * t + 80.0 * t * t, |t: f64| 5.7 * t);
        let of = |steps: u32| {
            let mut means = TorqueMeans::default();
            for k in 0..steps {
                let at = [0.0, 0.5, 1.0].map(|part| (f64::from(k) + part) / f64::from(steps));
                let (h, curve) = (1.0 / f64::from(steps), Curve::parabola(at.map(torque)));
                let curves = || StepCurves { rolling: Curve::line(path(at[0]), path(at[2])), torque: [curve; 2] };
                let (turned, impulse) = (2.0 * (path(at[2]) - path(at[0])), h * curve.mean([0.0, 1.0]));
                CycleCounter { pitch: 2.0 }.add(&mut means, [turned, -turned], (h, [impulse; 2]), curves);
            }
            means.last.unwrap()
        };
        let ([whole, _], ([parts, _], took)) = (of(1).0, of(17));
        assert!((whole - parts).abs() < 1e-9 && (took - 1.0 / 5.7).abs() < 1e-12, "{whole} {parts}");
    }

    #[test]
    fn any_number_of_cycles_in_a_step_gives_finite_means() {
        for cycles in [1e6 + 0.5, 1e17, 1e300] {
            let mut means = TorqueMeans::default();
            stepped(&mut means, [0.0, cycles], [Curve::line(100.0, 300.0); 2]);
            let ([left, _], _) = means.last.unwrap();
            assert!((left - 300.0).abs() < 200.0 * 2.0 / cycles + 1e-9, "{cycles}: {left}");
        }
    }

    #[test]
    fn an_oscillation_about_a_cycle_boundary_counts_no_cycle() {
        let positions: Vec<f64> = (0..30).map(|i| if i % 2 == 0 { 1e-9 } else { -1e-9 }).collect();
        assert_eq!(rolled(&positions, |_| [7.0, 3.0]).last, None);
        // rolling forward and back to the start counts no cycle either
        assert_eq!(rolled(&[-0.1, 0.1, 0.5, 0.8, 0.5, 0.1, -0.1], |_| [7.0, 3.0]).last, None);
    }

    #[test]
    fn means_are_kept_until_rolling_has_nearly_stopped() {
        let mut positions = vec![0.0, 0.5, 1.0, 1.5, 2.0, 2.1];
        assert!(rolled(&positions, |_| [7.0, 3.0]).mean().is_some());
        // an oscillation about the end of the last cycle does not renew them
        positions.extend((0..5).map(|i| if i % 2 == 0 { 1.9 } else { 2.1 }));
        assert_eq!(rolled(&positions, |_| [7.0, 3.0]).mean(), None);
    }
}
