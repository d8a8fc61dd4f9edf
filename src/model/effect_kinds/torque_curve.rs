//! Torque over slip from measured points: piecewise cubic Hermite interpolation that does not overshoot (PCHIP).
//!
//! Slopes at inner points are weighted harmonic means of the secants beside them, and 0 at extrema. Slopes at the ends
//! are those of a parabola, limited so that the curve keeps the direction of its secant. The curve is constant beyond its
//! last point. Without a point at slip 0, it starts at zero torque.
//!
//! Source: F. N. Fritsch and J. Butland, A method for constructing local monotone piecewise cubic interpolants, SIAM J.
//! Sci. Stat. Comput. 5 (1984), p. 300; end slopes as in C. Moler, Numerical Computing with MATLAB, SIAM 2004, section
//! 3.6.

/// Maximum number of points that users can give.
pub const POINTS: usize = 8;
/// Maximum number of nodes: the points and the start at zero.
const NODES: usize = POINTS + 1;

/// Node of the curve.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Node {
    /// Slip speed [rad/s].
    slip: f64,
    /// Torque [N·m].
    torque: f64,
    /// Derivative of the torque with respect to slip [N·m·s/rad].
    slope: f64,
}

/// Torque over the magnitude of the slip speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TorqueCurve {
    nodes: [Node; NODES],
    count: usize,
}

impl TorqueCurve {
    /// Curve through `points` of slip [rad/s] and torque [N·m]; the slips must rise from 0 or more. Points beyond
    /// [`POINTS`] are left out. Returns `None` without points.
    pub fn new(points: &[[f64; 2]]) -> Option<Self> {
        let first = points.first()?;
        let start = (first[0] > 0.0).then_some([0.0; 2]);
        let mut curve = Self { nodes: [Node::default(); NODES], count: 0 };
        for ([slip, torque], node) in start.iter().chain(points.iter().take(POINTS)).zip(&mut curve.nodes) {
            *node = Node { slip: *slip, torque: *torque, slope: 0.0 };
            curve.count += 1;
        }
        let slopes: [f64; NODES] = std::array::from_fn(|i| curve.slope_at_node(i));
        for (node, slope) in curve.nodes.iter_mut().zip(slopes) {
            node.slope = slope;
        }
        Some(curve)
    }

    /// Torque at slip 0, which a body must overcome to break loose [N·m].
    pub fn breakaway(&self) -> f64 {
        self.nodes[0].torque
    }

    /// Width [rad/s] and secant [N·m·s/rad] of the interval from node `i` to the next one.
    fn interval(&self, i: usize) -> [f64; 2] {
        let [from, to] = [&self.nodes[i], &self.nodes[i + 1]];
        let width = to.slip - from.slip;
        [width, (to.torque - from.torque) / width]
    }

    /// Slope at node `i` [N·m·s/rad]; 0 beyond the last node.
    fn slope_at_node(&self, i: usize) -> f64 {
        let last = self.count - 1;
        if i > last || last == 0 {
            return 0.0;
        }
        if last == 1 {
            return self.interval(0)[1];
        }
        if i == 0 {
            return end_slope(self.interval(0), self.interval(1));
        }
        if i == last {
            return end_slope(self.interval(last - 1), self.interval(last - 2));
        }
        let ([h0, d0], [h1, d1]) = (self.interval(i - 1), self.interval(i));
        if d0 * d1 <= 0.0 {
            return 0.0;
        }
        let (w0, w1) = (2.0 * h1 + h0, h1 + 2.0 * h0);
        (w0 + w1) / (w0 / d0 + w1 / d1)
    }

    /// Torque at the slip speed `speed` in the direction of sliding [N·m], and the derivative with respect to speed. A
    /// negative speed counts as 0.
    pub fn at(&self, speed: f64) -> [f64; 2] {
        let nodes = &self.nodes[..self.count];
        let Some(next) = nodes.iter().position(|node| speed < node.slip) else {
            return [nodes[self.count - 1].torque, 0.0];
        };
        if next == 0 || speed <= 0.0 {
            return [nodes[0].torque, nodes[0].slope];
        }
        let ([from, to], [width, secant]) = ([&nodes[next - 1], &nodes[next]], self.interval(next - 1));
        let x = speed - from.slip;
        let c = (3.0 * secant - 2.0 * from.slope - to.slope) / width;
        let b = (from.slope - 2.0 * secant + to.slope) / (width * width);
        let torque = from.torque + x * (from.slope + x * (c + x * b));
        [torque, from.slope + x * (2.0 * c + 3.0 * b * x)]
    }
}

/// Slope at an end of the curve, from the width and the secant of the `last` interval and of the one `beside` it.
fn end_slope([h0, d0]: [f64; 2], [h1, d1]: [f64; 2]) -> f64 {
    let slope = ((2.0 * h0 + h1) * d0 - h0 * d1) / (h0 + h1);
    if slope * d0 <= 0.0 {
        0.0
    } else if d0 * d1 <= 0.0 && slope.abs() > 3.0 * d0.abs() {
        3.0 * d0
    } else {
        slope
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RISING: [[f64; 2]; 5] = [[2.0, 30.0], [5.0, 90.0], [6.0, 91.0], [20.0, 140.0], [40.0, 150.0]];

    #[test]
    fn the_curve_passes_through_its_points_and_is_constant_beyond() {
        let curve = TorqueCurve::new(&RISING).unwrap();
        assert_eq!(curve.breakaway(), 0.0);
        for [slip, torque] in RISING {
            assert!((curve.at(slip)[0] - torque).abs() <= 1e-12 * torque, "{slip}");
            assert!((curve.at(slip * (1.0 - 1e-15))[0] - torque).abs() <= 1e-12 * torque, "{slip}");
        }
        assert_eq!(curve.at(1e5), [150.0, 0.0]);
        assert_eq!(TorqueCurve::new(&[[0.0, 70.0]]).unwrap().at(3.0), [70.0, 0.0]);
        assert_eq!(TorqueCurve::new(&[[10.0, 70.0]]).unwrap().at(5.0), [35.0, 7.0]);
        assert!(TorqueCurve::new(&[]).is_none());
    }

    #[test]
    fn monotone_points_give_a_monotone_curve_and_derivatives_match_differences() {
        for falling in [false, true] {
            let points = if falling { RISING.map(|[slip, torque]| [slip - 2.0, 200.0 - torque]) } else { RISING };
            let curve = TorqueCurve::new(&points).unwrap();
            let mut before = curve.at(0.0)[0];
            for i in 1..=4000 {
                let speed = f64::from(i) * 0.01 + 3e-4;
                let [torque, slope] = curve.at(speed);
                assert!(if falling { torque <= before } else { torque >= before }, "{speed}");
                before = torque;
                let difference = (curve.at(speed + 1e-5)[0] - curve.at(speed - 1e-5)[0]) / 2e-5;
                assert!((slope - difference).abs() < 1e-5 * (1.0 + slope.abs()), "{speed}: {slope} {difference}");
            }
        }
    }

    #[test]
    fn a_peak_is_not_exceeded() {
        let curve = TorqueCurve::new(&[[0.0, 50.0], [1.0, 80.0], [3.0, 60.0], [9.0, 61.0]]).unwrap();
        let most = (0..1000).map(|i| curve.at(f64::from(i) * 0.01)[0]).fold(0.0, f64::max);
        assert!((most - 80.0).abs() < 1e-12 && curve.breakaway() == 50.0);
    }

    /// Values of scipy 1.17's `PchipInterpolator` through the same points and the start at zero.
    #[test]
    fn values_between_the_points_are_those_of_another_program() {
        let curve = TorqueCurve::new(&RISING).unwrap();
        for (slip, torque) in REFERENCE {
            assert!((curve.at(slip)[0] - torque).abs() < 1e-9, "{slip}: {} for {torque}", curve.at(slip)[0]);
        }
    }

    const REFERENCE: [(f64, f64); 9] = [
        (0.5, 6.751768867924528),
        (1.7, 24.994089622641507),
        (3.0, 52.73490927492229),
        (4.9, 89.70449475890985),
        (5.5, 90.53934336023478),
        (8.0, 95.45971475333177),
        (13.0, 116.24382160392798),
        (25.0, 144.1370192307692),
        (39.0, 149.97098076923078),
    ];
}
