//! Forces are the gradient of the energy and do not jump; derivatives are those of the forces.

use bevel_differential::contact::detailed::{DetailedState, Gaps};
use bevel_differential::friction::{FrictionLaw, ToothFrictionSpec};
use fastrand::Rng;

use super::setup::{
    Both, Even, KINDS, STATES, Waves, carries_in_part, difference, friction, pattern, random_state, readings, smooth,
};
use crate::mesh_laws::{GEARS, Kind, RESTITUTION, STEP, UNDAMPED};

#[test]
fn force_is_minus_the_gradient_of_the_energy_with_gaps_and_displaced_gears() {
    let waves = Waves { size: 1e-5 };
    for kind in KINDS {
        let mut random = Rng::with_seed(23);
        let (mut worst, mut compared, mut deep) = (0.0f64, 0, [0; 3]);
        for gaps in [None, Some(&waves as &dyn Gaps)] {
            for of in GEARS {
                let both = Both::sliced(of, kind, UNDAMPED, None);
                for _ in 0..STATES {
                    let state = DetailedState { rate: [0.0; 3], ..random_state(&mut random, &both.pair, 3e-5) };
                    let depth = state.position[0].abs() - both.pair.normal_backlash / 2.0;
                    let h = [1e-3 * depth, 1e-3 * depth, 1e-3 * depth * both.plain.cone];
                    let force = both.load(gaps, &state).force;
                    if force[0] == 0.0 || !smooth(&both, gaps, &state, &h) {
                        continue;
                    }
                    for axis in 0..3 {
                        let scale = force[0].abs() / if axis == 2 { both.plain.cone } else { 1.0 };
                        let gradient = difference(&state, axis, h[axis], |s| both.energy(gaps, s));
                        let off = (force[axis] + gradient).abs() / scale;
                        worst = worst.max(off);
                        // of a slice just 60 h deep the difference is off by (h/p)⁴ ~ 1e-7 of its own small force
                        assert!(off < 1e-8, "{kind:?} {state:?} axis {axis}: {} {gradient} off {off:e}", force[axis]);
                    }
                    compared += 1;
                    both.look(gaps, &state, |s| deep[s.pair.spot as usize] += 1);
                }
            }
        }
        println!("{kind:?}: worst {worst:e} of |F_q| in {compared} states, slices {deep:?}");
        assert!(compared > STATES && (deep.iter().all(|&n| n > 100) || !kind.has_pairs()), "{compared} {deep:?}");
    }
}

#[test]
fn derivatives_equal_central_differences() {
    let waves = Waves { size: 1e-5 };
    let rough = |law| ToothFrictionSpec { law, regularisation_speed: 0.05, ..ToothFrictionSpec::default() };
    for kind in KINDS {
        for (damping, gaps, law) in [
            (UNDAMPED, None, None),
            (STEP, Some(&waves as &dyn Gaps), None),
            (RESTITUTION, Some(&waves as &dyn Gaps), Some(FrictionLaw::CoulombStribeck)),
            (STEP, None, Some(FrictionLaw::XuKahraman)),
        ] {
            if kind == Kind::Impact && damping == RESTITUTION {
                continue;
            }
            let mut random = Rng::with_seed(24);
            let (mut worst, mut compared, mut spots) = ([0.0f64; 2], 0, [0; 3]);
            for of in GEARS {
                let friction = law.map(|law| friction(rough(law)));
                let both = Both::sliced(of, kind, damping, friction);
                for _ in 0..STATES / 4 {
                    let state = random_state(&mut random, &both.pair, 3e-5);
                    let depth = state.position[0].abs() - both.pair.normal_backlash / 2.0;
                    let (r, h) = (both.plain.cone, 1e-4 * depth);
                    let h = [h, h, h * r, 1e-3, 1e-3, 1e-3 * r];
                    if !smooth(&both, gaps, &state, &h) {
                        continue;
                    }
                    let (load, plain) = (both.linearise(gaps, &state), both.load(gaps, &state));
                    assert_eq!(readings(&load).map(|r| r.v), readings(&plain), "{state:?}");
                    assert_eq!(load.heat, plain.heat);
                    compared += 1;
                    // where part of a face carries its points move, and damping or friction, which are no polynomials over the
                    // face, are summed as exactly as they are
                    let part = kind == Kind::Line && carries_in_part(&both, gaps, &state);
                    both.look(gaps, &state, |s| spots[s.pair.spot as usize] += 1);
                    // of all readings in newtons, by arcs, their scale is the largest derivative
                    let unit = |a: usize| if a < 2 { 1.0 / r } else { 1.0 };
                    let by = |i: usize| if i % 3 == 2 { r } else { 1.0 };
                    for half in [0..3, 3..6] {
                        let all = half.clone().flat_map(|i| {
                            readings(&load)
                                .map(|x| x.d[i])
                                .into_iter()
                                .enumerate()
                                .map(move |(a, d)| (d * unit(a) * by(i)).abs())
                        });
                        let scale = all.fold(1e-30, f64::max);
                        for i in half {
                            for a in 0..7 {
                                let d = difference(&state, i, h[i], |s| readings(&both.load(gaps, s))[a]);
                                let off = (readings(&load)[a].d[i] - d).abs() * unit(a) * by(i) / scale;
                                worst[usize::from(part)] = worst[usize::from(part)].max(off);
                                assert!(
                                    off < if part { 3e-4 } else { 1e-6 },
                                    "{kind:?} {damping:?} {law:?} {state:?} reading {a} by {i}: {} {d} off {off:e}",
                                    readings(&load)[a].d[i]
                                );
                            }
                        }
                    }
                }
            }
            println!("{kind:?} {damping:?} {law:?}: worst {worst:?} in {compared} states, slices {spots:?}");
            assert!(compared > 500 && (spots.iter().all(|&n| n > 20) || !kind.has_pairs()), "{compared} {spots:?}");
        }
    }
}

#[test]
fn force_does_not_jump_while_gaps_close_before_the_teeth_would_meet() {
    let (waves, thick) = (Waves { size: 2e-5 }, Even(-5e-5));
    let (mut worst, mut switches) = (0.0f64, 0);
    for kind in [Kind::Impact, Kind::Line, Kind::LineWeber] {
        for of in GEARS {
            let both = Both::sliced(of, kind, UNDAMPED, None);
            for (approach, w, gaps) in [
                (1e-3, 0.0, None),
                (1e-3, 3e-5, None),
                (1e-3, -3e-5, None),
                (1e-4, -5e-5, None),
                (-5e-4, -5e-5, None),
                (3e-3, -1e-4, None),
                (1e-3, 0.0, Some(&waves as &dyn Gaps)),
                (-2e-4, 0.0, Some(&waves as &dyn Gaps)),
                (1e-4, 0.0, Some(&thick as &dyn Gaps)),
                (-1e-3, 0.0, Some(&thick as &dyn Gaps)),
                (-1.3e-3, 0.0, Some(&thick as &dyn Gaps)),
                (3e-4, -3e-5, Some(&waves as &dyn Gaps)),
            ] {
                for hand in [-1.0, 1.0] {
                    let q = hand * (both.pair.normal_backlash / 2.0 + approach);
                    let state = |x: f64| DetailedState { position: [q, x, w], rate: [0.0; 3], wrapped: 0 };
                    let pattern = |x: f64| pattern(&both, gaps, &state(x), 0.0);
                    let force = |x: f64| both.load(gaps, &state(x)).force;
                    let steps = 2000;
                    let at = |k: i32| both.pair.base_pitch * f64::from(k) / f64::from(steps);
                    let scale = (0..steps).map(|k| force(at(k))[0].abs()).fold(0.0, f64::max);
                    assert!(scale > 0.0);
                    for k in 0..steps {
                        let (mut before, mut after) = (at(k), at(k + 1));
                        let here = pattern(before);
                        if here == pattern(after) {
                            continue;
                        }
                        for _ in 0..60 {
                            let middle = 0.5 * (before + after);
                            if pattern(middle) == here { before = middle } else { after = middle }
                        }
                        switches += 1;
                        let (a, b) = (force(before), force(after));
                        for axis in 0..3 {
                            let jump =
                                (a[axis] - b[axis]).abs() / scale * if axis == 2 { both.plain.cone } else { 1.0 };
                            worst = worst.max(jump);
                            assert!(
                                jump < 1e-9,
                                "{kind:?} {of:?} approach {approach:e} w {w:e} {gaps:?} hand {hand} axis {axis} x {before}: \
                                 jump {jump:e}"
                            );
                        }
                    }
                }
            }
        }
    }
    println!("worst {worst:e} of the largest force at {switches} switches");
    assert!(switches > 500);
}
