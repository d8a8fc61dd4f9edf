//! The mesh in detail: where nothing but plain teeth act it is the plain mesh; beyond, its forces derive from its energy,
//! its derivatives are exact, and friction takes the power that sliding flanks give.

#![allow(clippy::needless_range_loop)] // an index names the same axis or variable on both sides

mod mesh_explicit;
mod mesh_laws;

use bevel_differential::contact::any_spring::AnySpring;
use bevel_differential::contact::damping::Damping;
use bevel_differential::contact::detailed::{Detailed, DetailedLoad, DetailedState, Gaps, PairName, Slice};
use bevel_differential::contact::mesh::{Mesh, MeshState};
use bevel_differential::contact::pairs::{Engagement, Flank, Spot};
use bevel_differential::contact::tooth_friction::ToothFriction;
use bevel_differential::friction::{FrictionLaw, ToothFrictionSpec};
use bevel_differential::geometry::Pair;
use bevel_differential::numeric::{Dual, Scalar};
use mesh_explicit::{Lcg, V3};
use mesh_laws::{Built, GEARS, Kind, PER_FULL_DEPTH, RESTITUTION, STEP, UNDAMPED, gears};

const STATES: usize = 2000;
/// Deepest approach tried [rad]: 0.1 mm at R_m.
const DEEPEST: f64 = 3e-3;
const KINDS: [Kind; 5] = [Kind::Impact, Kind::Power, Kind::Line, Kind::LineWeber, Kind::Lumped];
const NAMES: (usize, usize) = (1, 0);

/// A plain mesh and the same in detail.
struct Both {
    pair: Pair,
    plain: Mesh,
    detailed: Detailed<AnySpring>,
}

impl Both {
    fn new(of: (i32, i32, f64, f64), kind: Kind, damping: Damping) -> Self {
        let pair = gears(of);
        let Built { law, spring, whole, cone } = Built::new(&pair, kind, of.2, damping);
        let plain = Mesh::new(&pair, law, cone, true, 0.05);
        let single = !kind.has_pairs();
        Self { pair, plain, detailed: Detailed::new(&pair, spring, damping, vec![whole], single, None) }
    }

    /// In detail with eight slices where the law can be cut, otherwise as it is.
    fn sliced(of: (i32, i32, f64, f64), kind: Kind, damping: Damping, friction: Option<ToothFriction>) -> Self {
        let mut both = Self::new(of, kind, damping);
        let slices = if kind.can_be_sliced() { gauss(&both.pair) } else { both.detailed.slices.clone() };
        let spring = both.detailed.spring.clone();
        both.detailed = Detailed::new(&both.pair, spring, damping, slices, !kind.has_pairs(), friction);
        both
    }

    fn engagement(&self) -> &Engagement {
        &self.plain.engagement
    }

    fn load<T: Scalar>(&self, gaps: Option<&dyn Gaps>, state: &DetailedState<T>) -> DetailedLoad<T> {
        self.detailed.load(self.engagement(), gaps, NAMES, state, |_| {})
    }

    fn energy(&self, gaps: Option<&dyn Gaps>, state: &DetailedState<f64>) -> f64 {
        self.detailed.energy(self.engagement(), gaps, NAMES, state)
    }
}

/// Eight Gauss points over the face with weights times R², the nodes by Newton's method on Legendre's polynomial.
fn gauss(pair: &Pair) -> Vec<Slice> {
    let (outer, inner) = (pair.outer_cone, pair.inner_cone);
    let legendre = |x: f64| {
        let (mut p, mut before) = (x, 1.0);
        for n in 2..=8 {
            let n = f64::from(n);
            (p, before) = (((2.0 * n - 1.0) * x * p - (n - 1.0) * before) / n, p);
        }
        (p, 8.0 * (x * p - before) / (x * x - 1.0))
    };
    (0..8)
        .rev()
        .map(|i| {
            let mut x = (std::f64::consts::PI * (f64::from(i) + 0.75) / 8.5).cos();
            for _ in 0..20 {
                let (p, slope) = legendre(x);
                x -= p / slope;
            }
            let slope = legendre(x).1;
            let cone = 0.5 * (outer + inner) + 0.5 * (outer - inner) * x;
            let width = (outer - inner) / ((1.0 - x * x) * slope * slope);
            Slice { cone, weight: width * cone * cone, width }
        })
        .collect()
}

/// Gaps that differ from tooth to tooth and from slice to slice and are smooth along the path.
#[derive(Debug)]
struct Waves {
    /// Amplitude [m].
    size: f64,
}

impl Gaps for Waves {
    fn at(&self, name: PairName, slice: usize, s: f64, _: bool) -> [f64; 3] {
        let flank = if name.flank == Flank::Drive { 0.0 } else { 0.7 };
        let phase = name.tooth as f64 * 1.3 + slice as f64 * 0.4 + flank;
        let k = 9.0;
        let (sin, cos) = (k * s + phase).sin_cos();
        [self.size * sin, self.size * k * cos, -self.size * k * k * sin]
    }
    fn least(&self) -> f64 {
        -self.size
    }
}

/// The same gap for every pair [m].
#[derive(Debug)]
struct Even(f64);

impl Gaps for Even {
    fn at(&self, _: PairName, _: usize, _: f64, _: bool) -> [f64; 3] {
        [self.0, 0.0, 0.0]
    }
    fn least(&self) -> f64 {
        self.0.min(0.0)
    }
}

fn random_state(random: &mut Lcg, pair: &Pair, w: f64) -> DetailedState<f64> {
    let depth = random.between(1e-5, DEEPEST);
    let hand = if random.between(-1.0, 1.0) < 0.0 { -1.0 } else { 1.0 };
    DetailedState {
        position: [
            hand * (pair.normal_backlash / 2.0 + depth),
            random.between(-2.0 * pair.base_pitch, 2.0 * pair.base_pitch),
            w * random.between(-1.0, 1.0),
        ],
        rate: [
            random.between(-1.0, 1.0),
            random.between(-1.0, 1.0),
            if w == 0.0 { 0.0 } else { random.between(-0.02, 0.02) },
        ],
        wrapped: 3,
    }
}

fn plain_state(state: &DetailedState<f64>) -> MeshState {
    let ([q, x, _], [q_rate, x_rate, _]) = (state.position, state.rate);
    MeshState { position: [q, x], rate: [q_rate, x_rate], ..MeshState::default() }
}

/// State with position or rate `i` of six moved by `h`.
fn shifted(state: &DetailedState<f64>, i: usize, h: f64) -> DetailedState<f64> {
    let mut s = *state;
    if i < 3 {
        s.position[i] += h
    } else {
        s.rate[i - 3] += h
    }
    s
}

/// Fourth-order central difference by variable `i`.
fn difference(state: &DetailedState<f64>, i: usize, h: f64, f: impl Fn(&DetailedState<f64>) -> f64) -> f64 {
    let at = |k: f64| f(&shifted(state, i, k * h));
    (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * h)
}

/// A loaded slice as far as it must stay the same.
type Loaded = (PairName, u64, Spot, bool, bool);

/// Loaded slices with their kind of contact, whether flanks are about to part, and whether damping is full: where this
/// changes, derivatives jump or bend. Nothing if a slice is less than `least` deep [rad].
fn pattern(both: &Both, gaps: Option<&dyn Gaps>, state: &DetailedState<f64>, least: f64) -> Option<Vec<Loaded>> {
    let mut pattern = Vec::new();
    let mut shallow = false;
    both.detailed.load(both.engagement(), gaps, NAMES, state, |slice| {
        let sign = if slice.name.flank == Flank::Drive { -1.0 } else { 1.0 };
        let approach = sign * state.position[0] - both.engagement().half_backlash();
        let past_side_tip = approach - slice.s - both.engagement().corner[1].end > 0.0;
        let spot = match slice.pair.spot {
            Spot::SideTip if !past_side_tip => Spot::Path,
            spot => spot,
        };
        shallow |= slice.arc < least;
        let full = slice.arc * slice.cone * PER_FULL_DEPTH >= 1.0;
        pattern.push((slice.name, slice.cone.to_bits(), spot, slice.normal <= 0.0, full));
    });
    (!shallow).then_some(pattern)
}

/// Whether nothing switches within two steps `h` of each of the variables.
fn smooth(both: &Both, gaps: Option<&dyn Gaps>, state: &DetailedState<f64>, h: &[f64]) -> bool {
    let least = 30.0 * h[0];
    let Some(here) = pattern(both, gaps, state, least) else { return false };
    (0..h.len()).all(|i| {
        [-2.0, 2.0].iter().all(|k| pattern(both, gaps, &shifted(state, i, k * h[i]), 0.0).is_some_and(|p| p == here))
    })
}

#[test]
fn without_effects_it_is_the_plain_mesh() {
    for kind in KINDS {
        let mut random = Lcg(21);
        let (mut worst, mut spots) = (0.0f64, [[0; 3]; 2]);
        for damping in [UNDAMPED, STEP, RESTITUTION] {
            if kind == Kind::Impact && damping == RESTITUTION {
                continue;
            }
            for of in GEARS {
                let both = Both::new(of, kind, damping);
                for _ in 0..STATES {
                    let state = random_state(&mut random, &both.pair, 0.0);
                    let (plain, load) = (both.plain.force(&plain_state(&state)), both.load(None, &state));
                    let resting = MeshState { rate: [0.0; 2], ..plain_state(&state) };
                    let scale = plain.force[0].abs().max(both.plain.force(&resting).force[0].abs());
                    for axis in 0..2 {
                        let off = (load.force[axis] - plain.force[axis]).abs() / scale;
                        worst = worst.max(off);
                        assert!(off < 1e-12, "{kind:?} {damping:?} {state:?} axis {axis}: off {off:e}");
                    }
                    assert!((load.heat[0] - plain.heat).abs() < 1e-12 * scale && load.heat[1] == 0.0);
                    let energy = both.plain.energy(&resting);
                    assert!((both.energy(None, &state) - energy).abs() < 1e-12 * energy);
                    let mut normal = 0.0;
                    both.plain.loaded(&plain_state(&state), |p, force| {
                        normal += force.total;
                        spots[p.flank as usize][p.spot as usize] += 1;
                    });
                    assert!((load.normal - normal).abs() < 1e-12 * scale / both.plain.cone);
                }
            }
        }
        println!("{kind:?}: worst {worst:e}, [path, planet tip, side tip] of [drive, coast]: {spots:?}");
        assert!(spots.iter().flatten().all(|&n| n > 100) || !kind.has_pairs(), "{kind:?} {spots:?}");
    }
}

#[test]
fn eight_slices_without_errors_are_one() {
    for kind in [Kind::Line, Kind::LineWeber] {
        let mut random = Lcg(22);
        let mut worst = 0.0f64;
        for of in GEARS {
            let (one, eight) = (Both::new(of, kind, UNDAMPED), Both::sliced(of, kind, UNDAMPED, None));
            assert_eq!((one.detailed.slices.len(), eight.detailed.slices.len()), (1, 8));
            for _ in 0..STATES {
                let state = random_state(&mut random, &one.pair, 0.0);
                let (a, b) = (one.load(None, &state), eight.load(None, &state));
                let mut compare = |a: f64, b: f64, scale: f64| {
                    worst = worst.max((a - b).abs() / scale);
                    assert!((a - b).abs() < 1e-12 * scale, "{kind:?} {state:?}: {a} {b}");
                };
                compare(a.force[0], b.force[0], a.force[0].abs());
                compare(a.force[1], b.force[1], a.force[0].abs());
                compare(a.force[2], b.force[2], a.normal);
                compare(a.normal, b.normal, a.normal);
                compare(a.planet_axial, b.planet_axial, a.normal);
                compare(a.side_axial, b.side_axial, a.normal);
                compare(a.tangential, b.tangential, a.normal);
                let energy = one.energy(None, &state);
                compare(energy, eight.energy(None, &state), energy);
            }
        }
        println!("{kind:?}: worst {worst:e}");
    }
}

#[test]
fn force_is_minus_the_gradient_of_the_energy_with_gaps_and_seats_that_give_way() {
    let waves = Waves { size: 1e-5 };
    for kind in KINDS {
        let mut random = Lcg(23);
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
                        // of a slice just 30 h deep the difference is off by (h/p)⁴ ~ 1e-6 of its own small force
                        assert!(off < 1e-8, "{kind:?} {state:?} axis {axis}: {} {gradient} off {off:e}", force[axis]);
                    }
                    compared += 1;
                    both.detailed.load(both.engagement(), gaps, NAMES, &state, |s| deep[s.pair.spot as usize] += 1);
                }
            }
        }
        println!("{kind:?}: worst {worst:e} of |F_q| in {compared} states, slices {deep:?}");
        assert!(compared > STATES && (deep.iter().all(|&n| n > 100) || !kind.has_pairs()), "{compared} {deep:?}");
    }
}

fn coulomb(coefficient: f64, regularisation_speed: f64) -> ToothFriction {
    friction(ToothFrictionSpec { coefficient, regularisation_speed, ..ToothFrictionSpec::default() })
}

fn friction(spec: ToothFrictionSpec) -> ToothFriction {
    ToothFriction { spec, modulus: 2.07e11 / (2.0 * (1.0 - 0.0625)) }
}

/// All that a load tells.
fn readings<T: Scalar>(load: &DetailedLoad<T>) -> [T; 7] {
    let [q, x, w] = load.force;
    [q, x, w, load.normal, load.planet_axial, load.side_axial, load.tangential]
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
            let mut random = Lcg(24);
            let (mut worst, mut compared, mut spots) = (0.0f64, 0, [0; 3]);
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
                    let dual =
                        |values: [f64; 3], first: usize| [0, 1, 2].map(|i| Dual::<6>::variable(values[i], first + i));
                    let duals = DetailedState {
                        position: dual(state.position, 0),
                        rate: dual(state.rate, 3),
                        wrapped: state.wrapped,
                    };
                    let (load, plain) = (both.load(gaps, &duals), both.load(gaps, &state));
                    assert_eq!(readings(&load).map(|r| r.v), readings(&plain), "{state:?}");
                    assert_eq!(load.heat, plain.heat);
                    compared += 1;
                    both.detailed.load(both.engagement(), gaps, NAMES, &state, |s| spots[s.pair.spot as usize] += 1);
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
                                worst = worst.max(off);
                                assert!(
                                    off < 1e-6,
                                    "{kind:?} {damping:?} {law:?} {state:?} reading {a} by {i}: {} {d} off {off:e}",
                                    readings(&load)[a].d[i]
                                );
                            }
                        }
                    }
                }
            }
            println!("{kind:?} {damping:?} {law:?}: worst {worst:e} in {compared} states, slices {spots:?}");
            assert!(compared > 500 && (spots.iter().all(|&n| n > 20) || !kind.has_pairs()), "{compared} {spots:?}");
        }
    }
}

#[test]
fn force_does_not_jump_while_gaps_close_before_the_teeth_would_meet() {
    let (waves, thick) = (Waves { size: 2e-5 }, Even(-5e-5));
    let (mut worst, mut switches) = (0.0f64, 0);
    for kind in [Kind::Impact, Kind::Line] {
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
    assert!(switches > 1000);
}

/// Angular velocities [rad/s] of planet and side gear relative to the carrier that make the rates of q and x.
fn turning(pair: &Pair, state: &DetailedState<f64>) -> [f64; 2] {
    let [planet, side] = pair.lever();
    [state.rate[1] / planet, (state.rate[0] + state.rate[1]) / side]
}

#[test]
fn friction_takes_the_power_of_sliding_flanks() {
    const MU: f64 = 0.07;
    let (mut worst, mut shares) = (0.0f64, 0);
    for kind in [Kind::Impact, Kind::Line, Kind::LineWeber] {
        let mut random = Lcg(25);
        for of in GEARS {
            let plain = Both::new(of, kind, UNDAMPED);
            let rough = {
                let friction = Some(coulomb(MU, 1e-9));
                let d = plain.detailed.clone();
                Detailed::new(&plain.pair, d.spring, d.damping, d.slices, d.single, friction)
            };
            for _ in 0..STATES {
                let mut state = random_state(&mut random, &plain.pair, 0.0);
                // conjugate motion
                state.rate[0] = 0.0;
                let [planet, side] = turning(&plain.pair, &state);
                let relative = (planet * planet + side * side).sqrt();
                let (mut power, mut pairs, mut parts, mut slowest) = (0.0, 0, 0.0, f64::INFINITY);
                let with = rough.load(plain.engagement(), None, NAMES, &state, |slice| {
                    let v = relative * slice.cone * slice.s.sin().abs();
                    slowest = slowest.min(v);
                    assert!(slice.friction.abs() <= MU * slice.normal);
                    power -= MU * slice.normal * v;
                    parts += slice.normal * relative * slice.cone;
                    pairs += 1;
                });
                let without = plain.load(None, &state);
                let added = [0, 1].map(|i| with.force[i] - without.force[i]);
                let found = added[0] * state.rate[0] + added[1] * state.rate[1];
                // friction changes its sign over 1e-9 m/s
                if slowest < 1e-4 {
                    continue;
                }
                let off = (found - power).abs() / parts;
                worst = worst.max(off);
                assert!(off < 1e-9, "{kind:?} {state:?}: {found} W for {power} W");
                assert!((with.heat[1] + found).abs() < 1e-9 * parts && with.heat[1] > 0.0);
                assert_eq!((with.normal, with.heat[0]), (without.normal, without.heat[0]));
                shares += pairs;
            }
        }
    }
    println!("worst {worst:e} of F |ω_rel| R, {shares} pairs");
}

/// The line of action of a right-angled pair: direction to the pitch point, unit tangent toward the planet's tip, and
/// the axes of planet and side gear. The line leans by α out of the direction of motion, toward the planet's tip away from
/// its axis.
fn line_of_action(pair: &Pair) -> (V3, V3, [V3; 2]) {
    let delta = pair.gears[0].pitch;
    let start = V3::new(delta.sin(), 0.0, delta.cos());
    let outward = V3::new(delta.cos(), 0.0, -delta.sin());
    let tangent = V3::y() * pair.pressure_angle.cos() + outward * pair.pressure_angle.sin();
    (start, tangent, [V3::z(), V3::x()])
}

#[test]
fn friction_opposes_the_sliding_of_flanks_that_turn_in_space_with_its_lever_arms() {
    const MU: f64 = 0.1;
    let (mut worst_arm, mut worst_power) = (0.0f64, 0.0f64);
    for of in GEARS {
        let plain = Both::new(of, Kind::Line, UNDAMPED);
        let pair = &plain.pair;
        let d = plain.detailed.clone();
        let rough = Detailed::new(pair, d.spring, d.damping, d.slices, false, Some(coulomb(MU, 1e-9)));
        let (start, tangent, axes) = line_of_action(pair);
        let mut random = Lcg(26);
        let mut seen = 0;
        for _ in 0..20 * STATES {
            let state = random_state(&mut random, pair, 0.0);
            let mut slices = Vec::new();
            let with = rough.load(plain.engagement(), None, NAMES, &state, |slice| {
                // told positive toward the planet's root
                let tip_ward = -slice.friction;
                slices.push((slice.s, slice.cone, slice.normal, tip_ward, slice.pair.spot, slice.pair.flank));
            });
            let [(s, r, normal, force, Spot::Path, flank)] = slices[..] else { continue };
            seen += 1;
            let without = plain.load(None, &state);
            let added = [0, 1].map(|i| with.force[i] - without.force[i]);
            // on the drive flank the planet's tooth moves against the line of action, toward which its tip is;
            // the coast flank is its mirror image
            let sign = if flank == Flank::Drive { -1.0 } else { 1.0 };
            let at = start * s.cos() + tangent * s.sin();
            let along_profile = start.cross(&tangent);
            // toward the planet's tip: away from its axis
            let tip_ward = along_profile * -(along_profile.dot(&axes[0])).signum();
            let [planet, side] = turning(pair, &state);
            // travel along the tangent is positive rotation about the planet's axis, negative about the side gear's
            let about = [axes[0] * (-sign * planet), axes[1] * (sign * side)];
            let sliding = (about[0] - about[1]).cross(&(at * r)).dot(&tip_ward);
            if sliding.abs() < 1e-3 {
                continue;
            }
            assert!(
                (force + MU * normal * sliding.signum()).abs() < 1e-6 * MU * normal,
                "{state:?}: {force} {sliding}"
            );
            // torques about the axes by the levers and by the vectors
            let [p, q] = pair.lever();
            let found = [p * (added[1] - added[0]), q * added[0]];
            let psi = [pair.pitch_arc[0] + s, pair.pitch_arc[1] - s];
            for i in 0..2 {
                let arm = r * pair.gears[i].base.cos() * psi[i].sin();
                let by_vectors = (at * r).cross(&tip_ward).dot(&axes[i]);
                assert!((arm - by_vectors.abs()).abs() < 1e-13, "{arm} {by_vectors}");
                let off = (found[i].abs() / (force.abs() * arm) - 1.0).abs();
                worst_arm = worst_arm.max(off);
                assert!(off < 1e-9, "gear {i} {state:?}: {} for {}", found[i], force * arm);
                // the force on the planet along the profile, its reaction on the side gear
                let power = force * if i == 0 { 1.0 } else { -1.0 } * about[i].cross(&(at * r)).dot(&tip_ward);
                let conjugate = found[i] * [planet, side][i];
                worst_power = worst_power.max((power - conjugate).abs() / (force.abs() * r));
                assert!((power - conjugate).abs() < 1e-9 * force.abs() * r, "gear {i}: {power} {conjugate}");
            }
        }
        assert!(seen > STATES, "{seen}");
    }
    println!("worst arm {worst_arm:e}, power {worst_power:e}");
}
