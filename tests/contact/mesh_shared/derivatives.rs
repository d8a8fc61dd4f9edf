//! Forces are the gradient of the energy of both meshes; derivatives are those of the forces; both ways of summing agree.

use bevel_differential::contact::detailed::{DetailedState, Gaps};
use bevel_differential::contact::tooth_friction::ToothFriction;
use bevel_differential::friction::ToothFrictionSpec;
use fastrand::Rng;

use super::setup::{GEARS, Gears, Kind, RESTITUTION, STEP, UNDAMPED, Waves, difference, plain, random_states, shifted};

const STATES: usize = 1200;
const KINDS: [Kind; 2] = [Kind::Line, Kind::LineWeber];

/// Steps of the differences by positions and rates.
fn steps(gears: &Gears, states: &[DetailedState; 2]) -> [f64; 6] {
    let depth = states.iter().map(|state| gears.mesh.approach(state.position[0])).fold(1e-5, f64::max);
    let (h, r) = (1e-4 * depth, gears.mesh.cone);
    [h, h, h * r, 1e-3, 1e-3, 1e-3 * r]
}

/// Whether nothing switches within two steps of any position or rate of either mesh.
fn is_smooth(gears: &Gears, gaps: Option<&dyn Gaps>, states: &[DetailedState; 2], h: &[f64; 6], count: usize) -> bool {
    let Some(here) = gears.pattern(gaps, states, 60.0 * h[0]) else { return false };
    (0..2).all(|side| {
        (0..count).all(|i| {
            [-2.0, 2.0]
                .iter()
                .all(|k| gears.pattern(gaps, &shifted(states, side, i, k * h[i]), 0.0).is_some_and(|p| p == here))
        })
    })
}

#[test]
fn forces_are_minus_the_gradient_of_the_energy_of_both_meshes() {
    for (kind, gaps, w) in KINDS.into_iter().flat_map(|kind| [(kind, None, 0.0), (kind, Some(Waves(1e-5)), 3e-5)]) {
        let gaps = gaps.as_ref().map(|waves| waves as &dyn Gaps);
        let mut random = Rng::with_seed(61);
        let (mut worst, mut compared) = (0.0f64, 0);
        for of in GEARS {
            let gears = Gears::new(of, kind, UNDAMPED, w > 0.0, None);
            for _ in 0..STATES / 4 {
                let states = random_states(&mut random, &gears.pair, w).map(|s| DetailedState { rate: [0.0; 3], ..s });
                let h = steps(&gears, &states).map(|h| 10.0 * h);
                if !is_smooth(&gears, gaps, &states, &h, 3) {
                    continue;
                }
                let load = gears.shared(gaps, |teeth| gears.detailed.load_shared(teeth, &states));
                let scale = load.iter().map(|load| load.force[0].abs()).fold(0.0, f64::max);
                if scale == 0.0 {
                    continue;
                }
                for side in 0..2 {
                    for i in 0..if w > 0.0 { 3 } else { 2 } {
                        let energy = |states: &[DetailedState; 2]| {
                            gears.shared(gaps, |teeth| gears.detailed.energy_shared(teeth, states))
                        };
                        let off = (load[side].force[i] + difference(&states, (side, i), h[i], energy)).abs();
                        let off = off / if i == 2 { scale / gears.mesh.cone } else { scale };
                        worst = worst.max(off);
                        assert!(off < 3e-8, "{kind:?} {states:?} {side} {i}: {off:e}");
                    }
                }
                compared += 1;
            }
        }
        println!("{kind:?}: worst {worst:e} of the force in {compared} states");
        assert!(compared > STATES / 3, "{compared}");
    }
}

#[test]
fn derivatives_equal_central_differences() {
    let spec = ToothFrictionSpec { regularisation_speed: 0.05, ..ToothFrictionSpec::default() };
    let rubbing = ToothFriction { spec, modulus: 2.07e11 / (2.0 * (1.0 - 0.0625)) };
    for kind in KINDS {
        for (damping, gaps, friction, w) in [
            (UNDAMPED, None, None, 0.0),
            (STEP, Some(Waves(1e-5)), None, 3e-5),
            (RESTITUTION, Some(Waves(1e-5)), Some(rubbing), 3e-5),
        ] {
            let gaps = gaps.as_ref().map(|waves| waves as &dyn Gaps);
            let mut random = Rng::with_seed(62);
            let (mut worst, mut compared) = (0.0f64, 0);
            for of in GEARS {
                let gears = Gears::new(of, kind, damping, true, friction);
                for _ in 0..STATES / 8 {
                    let states = random_states(&mut random, &gears.pair, w);
                    let h = steps(&gears, &states);
                    if !is_smooth(&gears, gaps, &states, &h, 6) {
                        continue;
                    }
                    let load = gears.shared(gaps, |teeth| gears.detailed.linearise_shared(teeth, &states));
                    let plain = gears.shared(gaps, |teeth| gears.detailed.load_shared(teeth, &states));
                    let all = |load: &bevel_differential::contact::detailed::DetailedLoad<f64>| {
                        let [q, x, w] = load.force;
                        [q, x, w, load.normal, load.planet_axial, load.side_axial, load.tangential]
                    };
                    let r = gears.mesh.cone;
                    let unit = |a: usize| if a < 2 { 1.0 / r } else { 1.0 };
                    // a part of a face that carries moves its points, where damping and friction are no polynomials
                    let moving = kind == Kind::Line
                        && gears.pattern(gaps, &states, 0.0).is_some_and(|p| p.iter().any(|slice| slice.2 == 0));
                    for side in 0..2 {
                        let exact = load[side].map(|x| x.d);
                        let [q, x, ww] = exact.force;
                        let rows = [q, x, ww, exact.normal, exact.planet_axial, exact.side_axial, exact.tangential];
                        assert_eq!(all(&load[side].map(|x| x.v)), all(&plain[side]));
                        for (of, i, column) in (0..6).map(|i| (side, i, i)).chain((0..3).map(|i| (1 - side, i, 6 + i)))
                        {
                            let by = if i % 3 == 2 { r } else { 1.0 };
                            // the scale of derivatives by positions and by rates
                            let scale = rows
                                .iter()
                                .enumerate()
                                .flat_map(|(a, row)| (0..3).map(move |j| (row[i / 3 * 3 + j] * unit(a)).abs()))
                                .fold(1e-3, f64::max);
                            for a in 0..7 {
                                let found = difference(&states, (of, i), h[i], |states| {
                                    all(&gears.shared(gaps, |teeth| gears.detailed.load_shared(teeth, states))[side])[a]
                                });
                                let off = (found - rows[a][column]).abs() * unit(a) * by / scale;
                                worst = worst.max(if moving { 0.0 } else { off });
                                let limit = if moving { 2e-3 } else { 3e-6 };
                                assert!(
                                    off < limit,
                                    "{kind:?} {states:?} {side} row {a} column {column}: {found:e} {off:e}"
                                );
                            }
                        }
                    }
                    compared += 1;
                }
            }
            println!("{kind:?} {damping:?}: worst {worst:e} in {compared} states");
            assert!(compared > STATES / 12, "{compared}");
        }
    }
}

#[test]
fn plain_meshes_are_those_in_detail() {
    let mut random = Rng::with_seed(63);
    for kind in KINDS {
        for damping in [STEP, RESTITUTION] {
            let mut compared = 0;
            for of in GEARS {
                let gears = Gears::new(of, kind, damping, false, None);
                for _ in 0..STATES {
                    let states = random_states(&mut random, &gears.pair, 0.0);
                    let found = gears.force(&plain(&states));
                    let load = gears.shared(None, |teeth| gears.detailed.linearise_shared(teeth, &states));
                    let close = |a: f64, b: f64, scale: f64| (a - b).abs() <= 1e-10 * scale;
                    let scale = load.iter().flat_map(|load| load.force).map(|f| f.v.abs()).fold(1e-3, f64::max);
                    let steep = load.iter().flat_map(|l| l.force).flat_map(|f| f.d).map(f64::abs).fold(1e-3, f64::max);
                    let energies = [found.energy, gears.energy(&plain(&states)), load[0].energy + load[1].energy];
                    assert!(
                        close(energies[0], energies[1], energies[1]) && close(energies[1], energies[2], energies[1])
                    );
                    for side in 0..2 {
                        assert!(close(found.force[side].heat, load[side].heat[0], scale));
                        for a in 0..2 {
                            let force = &load[side].force[a];
                            assert!(close(found.force[side].force[a], force.v, scale), "{states:?}");
                            for b in 0..2 {
                                let [own, other] = [side, 1 - side].map(|other| found.by_position[side][other][a][b]);
                                assert!(
                                    close(own, force.d[b], steep) && close(other, force.d[6 + b], steep),
                                    "{states:?}"
                                );
                                assert!(close(found.by_rate[side][a][b], force.d[3 + b], steep));
                            }
                        }
                    }
                    compared += usize::from(scale > 1.0);
                }
            }
            assert!(compared > STATES);
        }
    }
}

#[test]
fn meshes_at_rest_have_a_symmetric_stiffness() {
    let mut random = Rng::with_seed(64);
    let gears = Gears::new(GEARS[0], Kind::Line, UNDAMPED, false, None);
    let mut across = 0;
    for _ in 0..STATES {
        let states = plain(&random_states(&mut random, &gears.pair, 0.0)).map(|mut state| {
            state.rate = [0.0; 2];
            state
        });
        let by = gears.force(&states).by_position;
        let scale = by.as_flattened().as_flattened().as_flattened().iter().fold(0.0f64, |most, x| most.max(x.abs()));
        for s in 0..2 {
            for t in 0..2 {
                for a in 0..2 {
                    for b in 0..2 {
                        assert!((by[s][t][a][b] - by[t][s][b][a]).abs() <= 1e-12 * scale, "{states:?}");
                    }
                }
            }
        }
        across += usize::from(by[0][1][0][0] != 0.0);
    }
    assert!(across > 100);
}
