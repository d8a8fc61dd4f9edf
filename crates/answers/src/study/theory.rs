//! Closed forms of the quantities that the study compares, from the library's gear geometry.

use bevel_differential::contact::hertz;
use bevel_differential::geometry::{AddendumSystem, Pair, Tredgold};
use bevel_differential::model::Parameters;

use crate::study::stated;

/// 1 m/s [km/h].
const KMH: f64 = 3.6;

/// Speed of a carrier whose wheels roll at `speed` [km/h] on tyres of `radius` [m], in deg/s.
pub fn carrier_speed(speed: f64, radius: f64) -> f64 {
    (speed / KMH / radius).to_degrees()
}

/// Load on one half-shaft at the limit of adhesion [N·m]: (weight on the axle · adhesion · tyre radius)/2.
pub fn load_torque() -> f64 {
    use stated::{ADHESION, CAR_MASS, FRONT_SHARE, GRAVITY, TYRE_RADIUS};
    CAR_MASS * GRAVITY * FRONT_SHARE * ADHESION * TYRE_RADIUS / 2.0
}

/// Closed forms for one differential.
pub struct Theory {
    parameters: Parameters,
    pair: Pair,
}

impl Theory {
    /// Closed forms for the differential of `parameters`.
    pub fn new(parameters: &Parameters) -> Self {
        Self { parameters: *parameters, pair: Pair::new(&parameters.geometry) }
    }

    /// The pair's geometry.
    pub fn pair(&self) -> &Pair {
        &self.pair
    }

    /// Hertz stiffness of two spheres with the outer pitch radii of planet and side gear [N/m^1.5].
    pub fn hertz_stiffness(&self) -> f64 {
        let radius = |i| self.pair.outer_pitch_diameter(i) / 2.0;
        let material = &self.parameters.material;
        hertz::stiffness(radius(0), radius(1), material.young_modulus, material.poisson_ratio)
    }

    /// Tangential force of all planets on one side gear, referred to its outer pitch circle of radius r: T/r [N].
    pub fn outer_tangential_force(&self, torque: f64) -> f64 {
        torque / (self.pair.outer_pitch_diameter(1) / 2.0)
    }

    /// Normal force of one mesh at the mean cone distance [N]: T / (N R_m sinδ_b), with N planets and δ_b of the side gear.
    pub fn normal_force(&self, torque: f64) -> f64 {
        let planets = f64::from(self.parameters.geometry.planet_count);
        torque / (planets * self.pair.mean_cone * self.pair.sin_base()[1])
    }

    /// Tangential force of one mesh at the mean cone distance [N]: F_n cosα.
    pub fn mean_tangential_force(&self, torque: f64) -> f64 {
        self.normal_force(torque) * self.pair.pressure_angle.cos()
    }

    /// Speeds of left and right side gear, ω_c ± ω_p z_p/z_s, in the unit of the carrier's speed ω_c and the planets' spin ω_p.
    pub fn side_speeds(&self, carrier: f64, spin: f64) -> [f64; 2] {
        let geometry = &self.parameters.geometry;
        let difference = spin * f64::from(geometry.planet_teeth) / f64::from(geometry.side_teeth);
        [carrier + difference, carrier - difference]
    }

    /// Meshing frequency [Hz] at planet spin `spin` [deg/s] relative to the carrier.
    pub fn mesh_frequency(&self, spin: f64) -> f64 {
        f64::from(self.parameters.geometry.planet_teeth) * spin.abs() / 360.0
    }

    /// Largest addendum of the side gear without interference at the planet's base circle [modules].
    pub fn addendum_limit(&self) -> f64 {
        self.pair.limit_addendum(1) / self.pair.module
    }

    /// Contact ratio on the sphere, and by Tredgold's planar approximation.
    pub fn contact_ratios(&self) -> [f64; 2] {
        [self.pair.path.contact_ratio, Tredgold::new(&self.pair).contact_ratio]
    }

    /// Whether with standard addenda a mate's tip reaches below the base circle: the planet's, and the side gear's.
    pub fn standard_addenda_interfere(&self) -> [bool; 2] {
        let spec = bevel_differential::geometry::GearSpec {
            addendum_system: AddendumSystem::Standard,
            ..self.parameters.geometry
        };
        Pair::new(&spec).path.clipped
    }

    /// Face width over outer cone distance.
    pub fn relative_face_width(&self) -> f64 {
        self.parameters.geometry.face_width / self.pair.outer_cone
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(value: f64, wanted: f64, tolerance: f64) {
        assert!((value / wanted - 1.0).abs() < tolerance, "{value} is not {wanted}");
    }

    #[test]
    fn theory_gives_the_numbers_known_by_hand() {
        let theory = Theory::new(&Parameters::default());
        close(carrier_speed(60.0, 0.334), 2859.07, 2e-6);
        close(carrier_speed(20.0, 0.334), 953.02, 5e-6);
        close(load_torque(), 834.29, 5e-6);
        close(theory.hertz_stiffness() / 1e3f64.powf(1.5), 5.4774e5, 1e-5);
        close(theory.outer_tangential_force(835.0), 23194.0, 3e-5);
        close(theory.mean_tangential_force(835.0), 15171.0, 3e-5);
        close(theory.normal_force(835.0), 16144.0, 3e-5);
        close(theory.mesh_frequency(200.0), 5.5556, 1e-5);
        assert_eq!(theory.side_speeds(954.0, 200.0), [1079.0, 829.0]);
        close(theory.addendum_limit(), 0.787, 1e-3);
        assert_eq!(theory.standard_addenda_interfere(), [true, false]);
        close(theory.relative_face_width(), 0.471, 1e-3);
        close(theory.contact_ratios()[0], 1.4835, 1e-4);
        close(theory.contact_ratios()[1], 1.4818, 1e-4);
    }
}
