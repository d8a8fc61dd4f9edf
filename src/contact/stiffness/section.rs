//! Plane section of a tooth: virtual spur gear on the back cone (Tredgold) with its root.
//!
//! r = m z_v/2 with z_v = z/cosδ, r_b = r cosα, r_f = r − h_f. The half tooth angle at the base circle is γ_b = (π/4 +
//! x tanα) m/r + inv α. A point of the flank at radius R has the roll length ρ = √(R² − r_b²). The flank's normal at
//! this point touches the base circle at the angle τ = γ_b − ρ/r_b from the tooth's middle.

use super::bending::Bending;
use super::{Piece, Span};
use crate::geometry::Pair;
use crate::numeric::{FRAC_PI_2, PI, asin, atan2, cos, sin, sin_cos, sqrt, tan};
use crate::problem::Problem;

/// Shape of the teeth's roots.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RootSpec {
    /// Fillet radius at the outer cone distance [modules]. In a gap too narrow for this fillet, the largest possible
    /// radius is used.
    pub fillet: f64,
}

impl Default for RootSpec {
    /// 0.40 modules: nearly the largest fillet that fits the gaps of the default pair.
    fn default() -> Self {
        Self { fillet: 0.40 }
    }
}

/// Section of one gear's tooth.
#[derive(Clone, Debug)]
pub struct ToothSection {
    /// Module m [m].
    pub module: f64,
    /// Reference radius r [m].
    pub pitch_radius: f64,
    /// Base radius r_b [m].
    pub base_radius: f64,
    /// Tip radius r_a [m].
    pub tip_radius: f64,
    /// Root radius r_f [m].
    pub root_radius: f64,
    /// Roll length at the reference circle, r sinα [m].
    pub pitch_roll: f64,
    /// Half tooth angle at the base circle γ_b [rad].
    pub base_half_angle: f64,
    /// Fillet radius as limited by the gap [m]; for a generated tooth, the tip radius of the rack.
    pub fillet: f64,
    /// Height y₀ of the root section, at which the fillet meets the root circle [m].
    pub root_height: f64,
    /// Chord s_F of the root section [m].
    pub root_chord: f64,
    /// Profile from the root section upward.
    spans: Vec<Span>,
    /// Bending and shear integrals over the profile.
    pub(super) bending: Bending,
}

/// Load normal to the flank at a point of a section.
#[derive(Clone, Copy, Debug)]
pub struct FlankLoad {
    /// Angle τ between the load and the normal to the tooth's middle line [rad].
    pub angle: f64,
    /// Distance t from the flank to the tooth's middle along the load [m].
    pub depth: f64,
    /// Height y_c at which the load crosses the tooth's middle [m].
    pub height: f64,
    /// Lever l = y_c − y₀ above the root section [m].
    pub lever: f64,
}

/// Basic dimensions of a section.
#[derive(Clone, Copy, Debug)]
pub struct SectionSpec {
    /// Module m [m].
    pub module: f64,
    /// Number of teeth z_v of the virtual gear, not necessarily an integer.
    pub teeth: f64,
    /// Pressure angle α [rad].
    pub pressure_angle: f64,
    /// Profile shift coefficient x.
    pub profile_shift: f64,
    /// Addendum h_a [m].
    pub addendum: f64,
    /// Dedendum h_f [m].
    pub dedendum: f64,
}

impl SectionSpec {
    /// Returns the section of gear `i` (0 planet, 1 side gear) of `pair` at its outer cone distance.
    pub fn of_gear(pair: &Pair, i: usize) -> Self {
        let gear = &pair.gears[i];
        Self {
            module: pair.module,
            teeth: f64::from(gear.teeth) / cos(gear.pitch),
            pressure_angle: pair.pressure_angle,
            profile_shift: if i == 0 { pair.profile_shift } else { -pair.profile_shift },
            addendum: gear.addendum,
            dedendum: gear.dedendum,
        }
    }

    /// Section without its root: only the dimensions of the flank.
    fn flank(&self) -> ToothSection {
        let alpha = self.pressure_angle;
        let r = self.module * self.teeth / 2.0;
        ToothSection {
            module: self.module,
            pitch_radius: r,
            base_radius: r * cos(alpha),
            tip_radius: r + self.addendum,
            root_radius: r - self.dedendum,
            pitch_roll: r * sin(alpha),
            base_half_angle: (PI / 4.0 + self.profile_shift * tan(alpha)) * self.module / r + tan(alpha) - alpha,
            fillet: 0.0,
            root_height: 0.0,
            root_chord: 0.0,
            spans: Vec::new(),
            bending: Bending::default(),
        }
    }

    /// Returns a bevel tooth: a radial line below the base circle, then a fillet arc of `radius` [m] onto the root
    /// circle. The arc is tangent to the radial line, or to the involute if the root circle is too high for a radial
    /// line. In a gap too narrow for `radius`, the arc has the largest possible radius. Fails with the dedendum's
    /// parameter `name` if there is no gap.
    pub fn with_fillet(&self, radius: f64, name: &'static str) -> Result<ToothSection, Problem> {
        let mut section = self.flank();
        let half_pitch = PI / self.teeth;
        let middle = |radius: f64| section.fillet_centre(radius).0;
        let mut fillet = radius;
        if middle(fillet) > half_pitch {
            let mut low = MIN_FILLET * self.module;
            if low >= radius || middle(low) > half_pitch {
                return Err(problem!(
                    name,
                    "{:.3} mm is too deep: the gap between the teeth closes above the root",
                    self.dedendum * 1e3
                ));
            }
            let mut high = radius;
            for _ in 0..60 {
                let half = 0.5 * (low + high);
                if middle(half) > half_pitch { high = half } else { low = half }
            }
            fillet = low;
        }
        section.round_root(fillet);
        Ok(section)
    }

    /// Returns a spur tooth generated by a rack with the tip radius `radius` [m], without undercut. It is used to
    /// compare the stiffness with that of spur gears in standards.
    pub fn generated(&self, radius: f64) -> ToothSection {
        let mut section = self.flank();
        let (alpha, r) = (self.pressure_angle, section.pitch_radius);
        let depth = self.dedendum - radius;
        let rack_dedendum = self.dedendum + self.profile_shift * self.module;
        let offset = PI * self.module / 4.0 - rack_dedendum * tan(alpha) - radius * (1.0 - sin(alpha)) / cos(alpha);
        let piece = Piece::Trochoid { pitch: r, depth, radius, offset, half_pitch: PI / self.teeth };
        let start = (section.pitch_roll - depth / sin(alpha) - radius).max(0.0);
        section.fillet = radius;
        section.finish(vec![Span { piece, from: 0.0, to: depth / tan(alpha) }], start);
        section
    }
}

/// Smallest fillet in the search for a narrow gap [modules].
const MIN_FILLET: f64 = 1e-3;

impl ToothSection {
    /// Polar angle of the centre of a fillet arc of `radius` [m], and the roll length at which the arc meets the flank
    /// [m].
    fn fillet_centre(&self, radius: f64) -> (f64, f64) {
        let centre = self.root_radius + radius;
        // squared distance from the centre to the base circle along the flank's normal; not positive if the centre is
        // inside
        let along = (centre - self.base_radius) * (centre + self.base_radius);
        let roll = sqrt(along.max(0.0)) - radius;
        if roll > 0.0 {
            (self.base_half_angle - roll / self.base_radius + atan2(roll + radius, self.base_radius), roll)
        } else {
            (self.base_half_angle + asin(radius / centre), 0.0)
        }
    }

    fn round_root(&mut self, radius: f64) {
        let (polar, roll) = self.fillet_centre(radius);
        let centre = self.root_radius + radius;
        let piece = Piece::Arc { x: centre * sin(polar), y: centre * cos(polar), radius };
        let tangent = self.base_half_angle - roll / self.base_radius;
        let mut below = vec![Span { piece, from: polar - FRAC_PI_2, to: tangent }];
        if roll == 0.0 {
            let (s, c) = (sin(self.base_half_angle), cos(self.base_half_angle));
            let end = sqrt(self.root_radius * (self.root_radius + 2.0 * radius));
            below.push(Span { piece: Piece::Radial { slope: s / c }, from: end * c, to: self.base_radius * c });
        }
        self.fillet = radius;
        self.finish(below, roll);
    }

    /// Sets the profile: `below`, and the involute from roll length `roll` on.
    fn finish(&mut self, below: Vec<Span>, roll: f64) {
        let root = below[0].piece.at(below[0].from);
        (self.root_height, self.root_chord) = (root.height, 2.0 * root.half_chord);
        self.spans = below;
        let piece = Piece::Involute { base: self.base_radius, angle: self.base_half_angle };
        // up to τ = −π/2, at which the normal is parallel to the tooth's middle line and dy/dρ = 0, far beyond any tip
        let end = self.base_radius * (self.base_half_angle + FRAC_PI_2);
        self.spans.push(Span { piece, from: roll, to: end });
        self.bending = Bending::new(&self.spans, self.root_chord);
    }

    /// Profile from the root section upward.
    pub fn spans(&self) -> &[Span] {
        &self.spans
    }

    /// Load on the flank at roll length `roll` [m].
    pub fn load(&self, roll: f64) -> FlankLoad {
        let angle = self.base_half_angle - roll / self.base_radius;
        let (s, c) = sin_cos(angle);
        let height = self.base_radius / c;
        FlankLoad { angle, depth: roll + height * s, height, lever: height - self.root_height }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spec(teeth: f64) -> SectionSpec {
        let (m, alpha) = (4.5e-3, 20f64.to_radians());
        SectionSpec { module: m, teeth, pressure_angle: alpha, profile_shift: 0.0, addendum: m, dedendum: 1.25 * m }
    }

    /// Direction (dx, dy) at parameter `u`, of unit length.
    fn direction(span: &Span, u: f64) -> [f64; 2] {
        let h = 1e-6 * (span.to - span.from);
        let (a, b) = (span.piece.at(u - h), span.piece.at(u + h));
        let (x, y) = (b.half_chord - a.half_chord, b.height - a.height);
        let length = sqrt(x * x + y * y);
        [x / length, y / length]
    }

    #[test]
    fn pieces_meet_with_a_common_tangent() {
        let m = 4.5e-3;
        // a root circle below the base circle, one above it, and generated roots
        let cases = [
            (spec(12.0).with_fillet(0.3 * m, ""), 3),
            (spec(80.0).with_fillet(0.3 * m, ""), 2),
            (Ok(spec(20.0).generated(0.38 * m)), 2),
            (Ok(spec(50.0).generated(0.38 * m)), 2),
        ];
        for (section, pieces) in cases {
            let section = section.expect("a gap");
            assert_eq!(section.spans.len(), pieces);
            for pair in section.spans.windows(2) {
                let (end, start) = (pair[0].piece.at(pair[0].to), pair[1].piece.at(pair[1].from));
                assert!((end.half_chord - start.half_chord).abs() < 1e-13);
                assert!((end.height - start.height).abs() < 1e-13);
                // the direction of an involute that starts on the base circle is defined only slightly above it
                let begin = pair[1].from + 2e-6 * (pair[1].to - pair[1].from);
                let (a, b) = (direction(&pair[0], pair[0].to), direction(&pair[1], begin));
                assert!((a[0] * b[1] - a[1] * b[0]).abs() < 1e-3, "{a:?} {b:?}");
            }
            let root = sqrt(section.root_height.powi(2) + (section.root_chord / 2.0).powi(2));
            assert!((root / section.root_radius - 1.0).abs() < 1e-13);
        }
    }

    #[test]
    fn a_narrow_gap_is_fully_rounded_and_one_that_closes_is_rejected() {
        let m = 4.5e-3;
        let round = spec(20.0).with_fillet(2.0 * m, "").expect("a gap");
        let from_middle = PI / 20.0 - atan2(round.root_chord / 2.0, round.root_height);
        assert!(round.fillet > 0.3 * m && round.fillet < m && from_middle.abs() < 1e-9);
        // almost a rack: 2·1.7 m·tan30° is more than the gap's π/2 m
        let deep = SectionSpec { pressure_angle: 30f64.to_radians(), dedendum: 1.7 * m, ..spec(200.0) };
        let problem = deep.with_fillet(0.1 * m, "geometry.planet_dedendum");
        assert_eq!(problem.expect_err("no gap").variable, "geometry.planet_dedendum");
    }
}
