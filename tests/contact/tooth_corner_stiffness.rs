//! Stiffness of a tooth pair at a tip corner: the whole chain from the spec to 1/(q₁ + q₂ + q_H), recomputed with
//! vectors and Simpson's rule.

use crate::stiffness_pairs::{LINE_LOAD, STEEL, stiffness};
use bevel_differential::contact::stiffness::PairStiffness;
use bevel_differential::geometry::{AddendumSystem, GearSpec, Pair};
use nalgebra::{Rotation3, Unit, Vector3};

/// Fillet radius of the test's gears [modules].
const FILLET: f64 = 0.25;

/// The section of one gear on its back cone, from its dimensions.
struct Section {
    base: f64,
    half_angle: f64,
    root: f64,
    fillet: f64,
    pitch_roll: f64,
}

impl Section {
    fn new(pair: &Pair, i: usize) -> Self {
        let gear = &pair.gears[i];
        let (m, alpha) = (pair.module, pair.pressure_angle);
        let r = m * f64::from(gear.teeth) / (2.0 * gear.pitch.cos());
        let shift = [1.0, -1.0][i] * (pair.gears[0].addendum - pair.gears[1].addendum) / (2.0 * m);
        let thickness = (std::f64::consts::FRAC_PI_2 + 2.0 * shift * alpha.tan()) * m;
        Self {
            base: r * alpha.cos(),
            half_angle: thickness / (2.0 * r) + alpha.tan() - alpha,
            root: r - gear.dedendum,
            fillet: FILLET * m,
            pitch_roll: r * alpha.sin(),
        }
    }

    /// Pieces of half the profile: fillet, radius, and involute up to the roll length `roll`. Each returns a point
    /// (half chord, height) for a parameter from 0 to 1.
    fn profile(&self, piece: usize, t: f64, roll: f64) -> [f64; 2] {
        let centre = self.root + self.fillet;
        let polar = self.half_angle + (self.fillet / centre).asin();
        let on_circle = |radius: f64, angle: f64| [radius * angle.sin(), radius * angle.cos()];
        match piece {
            0 => {
                // angle at the centre from the direction of the root circle to that of the radius that the fillet
                // touches
                let [x, y] = on_circle(centre, polar);
                let turned = polar + (self.half_angle + std::f64::consts::FRAC_PI_2 - polar) * t;
                [x - self.fillet * turned.sin(), y - self.fillet * turned.cos()]
            }
            1 => {
                let start = (centre * centre - self.fillet * self.fillet).sqrt();
                on_circle(start + (self.base - start) * t, self.half_angle)
            }
            _ => {
                let rho = roll * t;
                let [x, y] = on_circle(self.base, self.half_angle - rho / self.base);
                let normal = self.half_angle - rho / self.base;
                [x + rho * normal.cos(), y - rho * normal.sin()]
            }
        }
    }

    /// Weber's compliance [1/Pa] of the tooth loaded at the roll length `roll` [m].
    fn compliance(&self, roll: f64) -> f64 {
        assert!(self.root + self.fillet < self.base, "the flank has a radial part");
        let (e, nu) = (STEEL.young / (1.0 - STEEL.poisson.powi(2)), STEEL.poisson / (1.0 - STEEL.poisson));
        let tau = self.half_angle - roll / self.base;
        let top = self.base / tau.cos();
        let [foot, bottom] = self.profile(0, 0.0, roll);
        // ∫(y_c−y)²/s³ dy and ∫dy/s up to y_c by Simpson's rule; the involute reaches y_c before the end of its
        // parameter
        let mut sums = [0.0; 2];
        let far = self.base;
        for piece in 0..3 {
            let mut end = 1.0;
            if piece == 2 {
                let (mut low, mut high) = (0.0, 1.0);
                for _ in 0..100 {
                    end = 0.5 * (low + high);
                    if self.profile(2, end, far)[1] < top { low = end } else { high = end }
                }
            }
            let n = 4000;
            let (h, small) = (end / f64::from(n), 1e-6);
            for j in 0..=n {
                let t = h * f64::from(j);
                let weight = if j == 0 || j == n { 1.0 } else { 2.0 + 2.0 * f64::from(j % 2) } * h / 3.0;
                let [x, y] = self.profile(piece, t, far);
                let rise =
                    (self.profile(piece, t + small, far)[1] - self.profile(piece, t - small, far)[1]) / (2.0 * small);
                let chord = 2.0 * x;
                sums[0] += weight * rise * (top - y).powi(2) / chord.powi(3);
                sums[1] += weight * rise / chord;
            }
        }
        let lever = (top - bottom) / (2.0 * foot);
        assert!(lever > 0.0);
        let shear_factor = 2.4 * (1.0 + nu);
        let t2 = tau.tan().powi(2);
        let root = 18.0 / std::f64::consts::PI * lever * lever
            + 2.0 * (1.0 - nu) * lever
            + 4.8 / std::f64::consts::PI * (1.0 + t2 / shear_factor);
        tau.cos().powi(2) / e * (12.0 * sums[0] + (shear_factor + t2) * sums[1] + root)
    }

    /// Distance from the flank to the tooth's middle along its normal.
    fn depth(&self, roll: f64) -> f64 {
        roll + self.base * (self.half_angle - roll / self.base).tan()
    }
}

/// Roll lengths at the corner of gear `own` after it has turned by the arc `delta` past the end of the path.
fn rolls(pair: &Pair, sections: &[Section; 2], own: usize, delta: f64) -> [f64; 2] {
    let axes = [Vector3::z(), Vector3::new(pair.shaft_angle.sin(), 0.0, pair.shaft_angle.cos())];
    let (d, alpha) = (pair.gears[0].pitch, pair.pressure_angle);
    let pitch_line = Vector3::new(d.sin(), 0.0, d.cos());
    let action = Vector3::new(d.cos(), 0.0, -d.sin()) * alpha.sin() + Vector3::y() * alpha.cos();
    // arc of a flank point from the point at which its normal touches the base circle
    let arc = |i: usize, cos_polar: f64| (cos_polar / pair.gears[i].base.cos()).acos();
    let pitch_arc = |i: usize| arc(i, pair.gears[i].pitch.cos());
    let past_pitch = arc(own, pair.gears[own].tip.cos()) - pitch_arc(own);
    let s = if own == 0 { past_pitch } else { -past_pitch };
    let end = pitch_line * s.cos() + action * s.sin();
    // both gears turn forward about their own axes, with their flanks moving toward their own tips
    let angle = delta / pair.gears[own].base.sin();
    let turn = Rotation3::from_axis_angle(&Unit::new_normalize(axes[own]), angle);
    let sense = if own == 0 { 1.0 } else { -1.0 };
    let moved = turn * end;
    assert!((moved - end).dot(&action) * sense >= 0.0);
    let mate = 1 - own;
    let mate_roll = sections[mate].pitch_roll + pair.outer_cone * (arc(mate, moved.dot(&axes[mate])) - pitch_arc(mate));
    let own_roll = sections[own].pitch_roll + pair.outer_cone * past_pitch;
    if own == 0 { [own_roll, mate_roll] } else { [mate_roll, own_roll] }
}

/// Stiffness [Pa] at roll lengths `rolls` under the reference load.
fn chain(pair: &Pair, sections: &[Section; 2], rolls: [f64; 2]) -> f64 {
    let b = 2.0 * (1.0 - STEEL.poisson.powi(2)) / (std::f64::consts::PI * STEEL.young);
    let load = LINE_LOAD * pair.outer_cone / pair.mean_cone;
    let width = 4.0 * b * load * rolls[0] * rolls[1] / (rolls[0] + rolls[1]);
    let depth = sections[0].depth(rolls[0]) * sections[1].depth(rolls[1]);
    let local = b * ((4.0 * depth / width).ln() - STEEL.poisson / (1.0 - STEEL.poisson));
    1.0 / (sections[0].compliance(rolls[0]) + sections[1].compliance(rolls[1]) + local)
}

fn specs() -> [GearSpec; 3] {
    let default = GearSpec { backlash: 0.0, ..GearSpec::default() };
    let iso = GearSpec {
        module: 5e-3,
        planet_teeth: 11,
        side_teeth: 18,
        pressure_angle: 22.5f64.to_radians(),
        addendum_system: AddendumSystem::Iso23509,
        ..default
    };
    [default, iso, GearSpec { planet_teeth: 12, side_teeth: 15, shaft_angle: 80f64.to_radians(), ..default }]
}

/// Position at the arc `delta` past the end of the path at the corner of gear `own`.
fn past(pair: &Pair, own: usize, delta: f64) -> f64 {
    if own == 0 { pair.path.high + delta } else { pair.path.low - delta }
}

#[test]
fn a_corner_s_stiffness_is_its_own_tip_in_series_with_the_mate_at_the_touched_point() {
    let mut worst = 0f64;
    for spec in specs() {
        let pair = Pair::new(&spec);
        assert_eq!(pair.path.clipped, [false, false]);
        let sections = [Section::new(&pair, 0), Section::new(&pair, 1)];
        let found = stiffness(&spec, FILLET);
        for own in 0..2 {
            for share in [0.0, 4e-3, 5e-3, 7e-3, 0.01, 0.02, 0.05, 0.1, 0.2, 0.3] {
                let delta = share * pair.base_pitch;
                let expected = chain(&pair, &sections, rolls(&pair, &sections, own, delta));
                let off = found.at(past(&pair, own, delta)) / expected - 1.0;
                assert!(off.abs() < 1e-9, "{:?} corner {own} at {share} p_b: {off:e}", pair.gears.map(|g| g.teeth));
                worst = worst.max(off.abs());
            }
        }
    }
    println!("worst {worst:e}");
}

#[test]
fn on_the_path_the_same_chain_is_valid() {
    for spec in specs() {
        let pair = Pair::new(&spec);
        let sections = [Section::new(&pair, 0), Section::new(&pair, 1)];
        let found = stiffness(&spec, FILLET);
        for j in 0..=10 {
            let s = pair.path.low + (pair.path.high - pair.path.low) * f64::from(j) / 10.0;
            let travel = pair.outer_cone * s;
            let expected = chain(&pair, &sections, [sections[0].pitch_roll + travel, sections[1].pitch_roll - travel]);
            let off = found.at(s) / expected - 1.0;
            assert!(off.abs() < 1e-9, "{s}: {off:e}");
        }
    }
}

/// Stiffness past the corner's travel, at `share` base pitches from its end.
fn beyond(found: &PairStiffness, pair: &Pair, own: usize, share: f64) -> f64 {
    found.at(past(pair, own, found.corner_range[1 - own] + share * pair.base_pitch))
}

#[test]
fn past_the_mate_s_tip_the_stiffness_levels_off_within_a_tenth_of_a_base_pitch() {
    for spec in specs() {
        let pair = Pair::new(&spec);
        let found = stiffness(&spec, FILLET);
        for own in 0..2 {
            // the corner leaves the flank at the mate's tip circle
            let mate = 1 - own;
            let reach = found.corner_range[mate];
            let sections = [Section::new(&pair, 0), Section::new(&pair, 1)];
            let tip_arc = (pair.gears[mate].tip.cos() / pair.gears[mate].base.cos()).acos();
            let tip_roll = sections[mate].pitch_roll + pair.outer_cone * (tip_arc - pair.pitch_arc[mate]);
            assert!((rolls(&pair, &sections, own, reach)[mate] / tip_roll - 1.0).abs() < 1e-9);
            let far = beyond(&found, &pair, own, 50.0);
            // the sum of angles is rounded
            assert_eq!(beyond(&found, &pair, own, 0.1 + 1e-12), far);
            assert!(far > 0.5 * beyond(&found, &pair, own, 0.0));
            // no jump anywhere
            let (at, next) = (beyond(&found, &pair, own, -1e-9), beyond(&found, &pair, own, 1e-9));
            assert!((at / next - 1.0).abs() < 1e-6 && at != far);
        }
    }
}
