//! Tests that stiff motion is damped and does not limit steps.

use bevel_differential::integrate::Point;

use super::methods::{Known, run, step, with_every_method};
use super::problems::{distance, forced, forced_exact, system};

with_every_method!(
    infinitely_stiff_motion_is_damped_in_one_step
    no_oscillation_grows_however_long_the_step
    smooth_forcing_does_not_cost_more_when_it_is_stiffer
);

/// Result R(−λ) of one step of size 1 of v̇ = −λv from v = 1.
fn decay<M: Known>(lambda: f64) -> f64 {
    let s = system(move |p: &Point<1>| ([-lambda * p.v[0]], [[0.0]], [[-lambda]]));
    step::<M, 1, _>(&s, &Point { q: [0.0], v: [1.0] }, 1.0).extension.end.v[0].abs()
}

/// Amplitude |R(ih)| after one step of size `h` of q̈ = −q from amplitude 1.
fn amplitude<M: Known>(h: f64) -> f64 {
    let s = system(|p: &Point<1>| ([-p.q[0]], [[-1.0]], [[0.0]]));
    let end = step::<M, 1, _>(&s, &Point { q: [1.0], v: [0.0] }, h).extension.end;
    end.q[0].hypot(end.v[0])
}

fn infinitely_stiff_motion_is_damped_in_one_step<M: Known>() {
    for rate in [1e6, 1e10, 1e14] {
        // R(z) decreases as 1/z
        assert!(decay::<M>(rate) < 100.0 / rate, "rate {rate}: {}", decay::<M>(rate));
    }
    // also an oscillation far faster than the step
    let s = system(|p: &Point<1>| ([-1e16 * p.q[0]], [[-1e16]], [[0.0]]));
    let end = step::<M, 1, _>(&s, &Point { q: [1.0], v: [0.0] }, 1.0).extension.end;
    assert!(end.q[0].abs() < 1e-6, "{}", end.q[0]);
}

fn no_oscillation_grows_however_long_the_step<M: Known>() {
    for k in -20..80 {
        let h = 10f64.powf(0.1 * f64::from(k));
        assert!(amplitude::<M>(h) <= 1.0 + 1e-14, "h ω = {h}: {}", amplitude::<M>(h));
        assert!(decay::<M>(h) < 1.0, "h λ = {h}: {}", decay::<M>(h));
    }
}

/// Number of accepted steps under forcing of stiffness `lambda`, and the error at the end.
fn steps<M: Known>(lambda: f64) -> (u64, f64) {
    let mut point = forced_exact(0.0);
    let statistics = run::<M, 2, _>(&forced(lambda), &mut point, 1.0, 1e-6).unwrap();
    println!("λ = {lambda:e}: {statistics:?}");
    (statistics.accepted, distance(&point, &forced_exact(1.0)))
}

fn smooth_forcing_does_not_cost_more_when_it_is_stiffer<M: Known>() {
    // methods that lose order take most steps at λ = 1e3
    let (worst, _) = steps::<M>(1e3);
    for lambda in [1e4, 1e5, 1e8] {
        let (count, error) = steps::<M>(lambda);
        assert!(count <= worst && error < 1e-6, "λ = {lambda:e}: {count} steps, {worst} before; error {error:e}");
    }
}
