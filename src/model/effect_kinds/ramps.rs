//! Torque with which ramps or cams press the clutch packs of both side gears.
//!
//! ```text
//! own_side     L_s = c_s |Q_s|                       both_sides   L_s = (c_L |Q_L| + c_R |Q_R|)/2
//! c_s = 1 if the meshes drive the side gear forward (Q_s > 0), otherwise the coast ratio
//! ```
//!
//! with the torque Q of the meshes on a side gear. The direction of rotation has no influence. L is continuous, because
//! it is 0 at Q = 0.

/// Parts of the clutches that convert torque to pressure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ramps {
    /// Pressure under negative torque over the pressure under positive torque.
    pub coast_ratio: f64,
    /// True if the torques of both sides press each pack.
    pub both_sides: bool,
}

impl Ramps {
    /// Ramps that press each pack by the torque of its own side, with equal ramps for both directions.
    pub const OWN_SIDE: Self = Self { coast_ratio: 1.0, both_sides: false };

    /// Factor on the magnitude of `torque` [N·m].
    fn factor(&self, torque: f64) -> f64 {
        if torque < 0.0 { self.coast_ratio } else { 1.0 }
    }

    /// Torques that press the packs [N·m], from the torques of the meshes on the side gears [N·m].
    pub fn loads(&self, torques: [f64; 2]) -> [f64; 2] {
        let own = torques.map(|torque| self.factor(torque) * torque.abs());
        if self.both_sides { [0.5 * (own[0] + own[1]); 2] } else { own }
    }

    /// Derivatives of the load of pack `s` with respect to the torques of the meshes on both side gears.
    pub fn slopes(&self, torques: [f64; 2], s: usize) -> [f64; 2] {
        let share = |t: usize| match (self.both_sides, t == s) {
            (true, _) => 0.5,
            (false, own) => f64::from(u8::from(own)),
        };
        [0, 1].map(|t| share(t) * self.factor(torques[t]) * torques[t].signum())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RAMPS: Ramps = Ramps { coast_ratio: 0.25, both_sides: false };

    #[test]
    fn each_direction_has_its_ramp_and_each_pack_its_torque() {
        assert_eq!(RAMPS.loads([400.0, -200.0]), [400.0, 50.0]);
        let both = Ramps { both_sides: true, ..RAMPS };
        assert_eq!(both.loads([400.0, -200.0]), [225.0, 225.0]);
        assert_eq!(Ramps::OWN_SIDE.loads([-3.0, 7.0]), [3.0, 7.0]);
        assert_eq!(Ramps { coast_ratio: 0.0, ..RAMPS }.loads([-3.0, 0.0]), [0.0, 0.0]);
    }

    #[test]
    fn slopes_match_differences() {
        for both_sides in [false, true] {
            let ramps = Ramps { both_sides, ..RAMPS };
            for torques in [[400.0, 300.0], [400.0, -200.0], [-100.0, -200.0]] {
                for (s, t) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                    let [mut more, mut less] = [torques; 2];
                    (more[t], less[t]) = (more[t] + 0.5, less[t] - 0.5);
                    let difference = ramps.loads(more)[s] - ramps.loads(less)[s];
                    assert!((ramps.slopes(torques, s)[t] - difference).abs() < 1e-12, "{torques:?} {s} {t}");
                }
            }
        }
    }
}
