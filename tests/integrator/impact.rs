//! Test of a free mass under the contact law of the program, because the Hertz impact has a closed-form solution.

use bevel_differential::contact::impact::Impact;
use bevel_differential::integrate::Point;

use super::methods::{Known, run, with_every_method};
use super::problems::{Jet, System};

with_every_method!(hertz_impact_has_the_closed_form_depth_force_and_duration);

/// A mass that hits a contact law along −d, so that position d is the penetration. Scales are micrometres and metres
/// per second.
fn bouncing(law: Impact, mass: f64, depth: f64, speed: f64) -> System<impl Fn(&Point<1>) -> Jet<1>, 1> {
    let acceleration = move |p: &Point<1>| {
        if p.q[0] <= 0.0 {
            return ([0.0], [[0.0]], [[0.0]]);
        }
        let f = law.force(p.q[0], p.v[0]);
        ([-f.total / mass], [[-f.by_depth / mass]], [[-f.by_rate / mass]])
    };
    System { acceleration, magnitude: Point { q: [depth], v: [speed] } }
}

/// Zero of a function that falls from positive to negative values between `lo` and `hi`.
fn zero(mut lo: f64, mut hi: f64, f: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..60 {
        let middle = 0.5 * (lo + hi);
        if f(middle) > 0.0 { lo = middle } else { hi = middle }
    }
    lo
}

fn hertz_impact_has_the_closed_form_depth_force_and_duration<M: Known>() {
    let golden: serde_json::Value = serde_json::from_str(include_str!("../data/golden_contact_bench.json")).unwrap();
    for case in ["hertz_impact_m1kg_v1_K1.732e10", "hertz_impact_m0.5_v0.1_K1e9"] {
        let g = |key: &str| golden[case][key].as_f64().unwrap();
        let (m, v, k) = (g("m"), g("v"), g("K"));
        let law = Impact { stiffness: k, exponent: 1.5, damping: 0.0, per_full_depth: 1e4 };
        let s = bouncing(law, m, g("delta_max"), v);
        let at = |time: f64| {
            let mut point = Point { q: [0.0], v: [v] };
            run::<M, 1, _>(&s, &mut point, time, 1e-10).unwrap();
            point
        };
        // deepest when the speed changes sign, released when the depth does
        let contact = g("t_contact");
        let deepest = zero(0.3 * contact, 0.7 * contact, |t| at(t).v[0]);
        let depth = at(deepest).q[0];
        let release = zero(0.8 * contact, 1.2 * contact, |t| at(t).q[0]);
        let close = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-6;
        assert!(close(depth, g("delta_max")), "{case}: depth {depth:e}");
        assert!(close(law.force(depth, 0.0).total, g("F_max")), "{case}");
        assert!(close(release, contact), "{case}: duration {release:e}");
        assert!(close(at(1.5 * contact).v[0], -v), "{case}: speed of return");
    }
}
