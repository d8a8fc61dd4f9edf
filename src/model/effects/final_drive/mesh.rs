//! Elastic mesh between pinion and ring gear, with lash and an error that excites it.
//!
//! With φ = θ_p/i − θ_c and the deviation x = φ − e from the path of perfect teeth, the flanks that drive forward touch
//! at x > b/2, and those that drive backward at x < −b/2:
//!
//! ```text
//! T = max(0, K (x − b/2) + c ẋ)  or  −max(0, −K (x + b/2) − c ẋ),   b = j_t/r, K = k r², c = d r²
//! e = Σ E_n/r cos(n z₁ θ_p + ψ_n) + R₁/r cos(θ_p + ψ_1r) + R₂/r cos(θ_c + ψ_2r)
//! ```
//!
//! The torques follow from the potential V(x): T (1 + ∂e/∂θ_c) acts on
//! the carrier and −T (1 − i ∂e/∂θ_p) on the pinion at the carrier's speed. The power of both is −(V̇ + heat).
//!
//! Source: A. Kahraman and R. Singh, J. Sound Vib. 142 (1990) 49–75, for a pair with lash and transmission error.

use super::FinalDriveSpec;
use crate::model::effect_kinds::{BodyMotion, LashSpring, Slopes};
use crate::model::scene::{CARRIER, Layout};
use crate::numeric::{Dual, Scalar};

/// Number of iterations with which the static deflection finds the error at its own angle.
const ROUNDS: usize = 8;

/// Harmonic of the error: amplitude cos(order θ + phase).
#[derive(Clone, Copy, Debug, Default)]
struct Harmonic {
    /// Amplitude at the carrier [rad].
    amplitude: f64,
    /// Order of the angle.
    order: f64,
    /// Phase [rad].
    phase: f64,
}

impl Harmonic {
    /// True unless the amplitude is zero.
    fn acts(&self) -> bool {
        self.amplitude != 0.0
    }

    /// Value of the harmonic and its derivative with respect to the angle.
    fn at<T: Scalar>(&self, angle: T) -> [T; 2] {
        let argument = angle * self.order + self.phase;
        [argument.cos() * self.amplitude, argument.sin() * (-self.order * self.amplitude)]
    }
}

/// Elastic mesh.
#[derive(Clone, Copy, Debug)]
pub struct Mesh {
    /// Ratio i.
    ratio: f64,
    /// Spring with the stiffness K, the damping c and the lash b at the carrier.
    spring: LashSpring,
    /// Harmonics of the angle of the pinion.
    of_pinion: [Harmonic; 4],
    /// Harmonic of the angle of the carrier.
    of_carrier: Harmonic,
    /// True if all harmonics are zero.
    is_perfect: bool,
    /// Degree of freedom of the pinion.
    pinion: usize,
}

/// Angle of the carrier, lag of the pinion, and the speeds of carrier and pinion.
type Local<T> = [T; 4];

/// Deviation x, its rate ẋ, and the derivatives ∂e/∂θ_c and i ∂e/∂θ_p.
#[derive(Clone, Copy)]
struct Deviation<T> {
    x: T,
    rate: T,
    by_carrier: T,
    by_pinion: T,
}

impl Mesh {
    /// Mesh of the final drive `of` in a scene with this `layout`.
    pub fn new(of: &FinalDriveSpec, layout: &Layout) -> Self {
        let r = of.mean_radius;
        let z = f64::from(of.pinion_teeth);
        let harmonic = |error: f64, order: f64, phase: f64| Harmonic { amplitude: error / r, order, phase };
        let of_pinion = [
            harmonic(of.error_1, z, of.error_phase_1),
            harmonic(of.error_2, 2.0 * z, of.error_phase_2),
            harmonic(of.error_3, 3.0 * z, of.error_phase_3),
            harmonic(of.pinion_runout, 1.0, of.pinion_runout_phase),
        ];
        let of_carrier = harmonic(of.ring_runout, 1.0, of.ring_runout_phase);
        Self {
            ratio: of.ratio(),
            spring: LashSpring {
                stiffness: of.stiffness * r * r,
                damping: of.damping * r * r,
                half_lash: 0.5 * of.backlash / r,
            },
            is_perfect: !of_carrier.acts() && !of_pinion.iter().any(Harmonic::acts),
            of_pinion,
            of_carrier,
            pinion: layout.pinion(),
        }
    }

    fn local(&self, at: &BodyMotion) -> Local<f64> {
        [at.q[CARRIER], at.q[self.pinion], at.v[CARRIER], at.v[self.pinion]]
    }

    fn deviation<T: Scalar>(&self, [carrier, lag, carrier_speed, pinion_speed]: Local<T>) -> Deviation<T> {
        let [mut error, mut by_carrier, mut by_pinion] = [T::constant(0.0); 3];
        if self.is_perfect {
            return Deviation { x: -lag, rate: pinion_speed - carrier_speed, by_carrier, by_pinion };
        }
        let pinion = (carrier - lag) * self.ratio;
        if self.of_carrier.acts() {
            [error, by_carrier] = self.of_carrier.at(carrier);
        }
        for harmonic in self.of_pinion.iter().filter(|harmonic| harmonic.acts()) {
            let [value, slope] = harmonic.at(pinion);
            error = error + value;
            by_pinion = by_pinion + slope * self.ratio;
        }
        let rate = pinion_speed - carrier_speed - by_carrier * carrier_speed - by_pinion * pinion_speed;
        Deviation { x: -lag - error, rate, by_carrier, by_pinion }
    }

    /// Torques on the carrier and on the pinion.
    fn torques<T: Scalar>(&self, &Deviation { x, rate, by_carrier, by_pinion }: &Deviation<T>) -> [T; 2] {
        let torque = self.spring.torque(x, rate);
        [torque + torque * by_carrier, torque * by_pinion - torque]
    }

    /// Adds the torques to `force`. Returns the power of the damping [W].
    pub fn act(&self, at: &BodyMotion, force: &mut [f64]) -> f64 {
        let deviation = self.deviation(self.local(at));
        let [on_carrier, on_pinion] = self.torques(&deviation);
        force[CARRIER] += on_carrier;
        force[self.pinion] += on_pinion;
        self.spring.heat(deviation.x, deviation.rate)
    }

    /// Adds the derivatives of the torques.
    pub fn slopes(&self, at: &BodyMotion, out: &mut Slopes) {
        let local = self.local(at);
        let torques = self.torques(&self.deviation(std::array::from_fn(|k| Dual::<4>::variable(local[k], k))));
        for (row, torque) in [CARRIER, self.pinion].into_iter().zip(torques) {
            out.position(row, CARRIER, torque.d[0]);
            out.position(row, self.pinion, torque.d[1]);
            out.velocity(row, CARRIER, torque.d[2]);
            out.velocity(row, self.pinion, torque.d[3]);
        }
    }

    /// Elastic energy [J].
    pub fn energy(&self, at: &BodyMotion) -> f64 {
        self.spring.energy(self.deviation(self.local(at)).x)
    }

    /// Torque on the carrier [N·m].
    pub fn on_carrier(&self, at: &BodyMotion) -> f64 {
        self.torques(&self.deviation(self.local(at)))[0]
    }

    /// Torque T of the mesh [N·m].
    pub fn torque_at(&self, at: &BodyMotion) -> f64 {
        let Deviation { x, rate, .. } = self.deviation(self.local(at));
        self.spring.torque(x, rate)
    }

    /// Derivatives of [`Self::torque_at`] with respect to positions and velocities of carrier and pinion.
    pub fn torque_slopes(&self, at: &BodyMotion) -> [(usize, [f64; 2]); 2] {
        let local = self.local(at);
        let Deviation { x, rate, .. } = self.deviation(std::array::from_fn(|k| Dual::<4>::variable(local[k], k)));
        let [carrier, pinion, carrier_speed, pinion_speed] = self.spring.torque(x, rate).d;
        [(CARRIER, [carrier, carrier_speed]), (self.pinion, [pinion, pinion_speed])]
    }

    /// Fraction of a step of `h` [s] after which flanks touch or separate, if the deviation keeps its rate.
    pub fn kink(&self, at: &BodyMotion, h: f64) -> Option<f64> {
        let Deviation { x, rate, .. } = self.deviation(self.local(at));
        self.spring.kink(x, rate, h)
    }

    /// Sets the lag of the pinion so that the mesh carries the `torque` on the carrier [N·m]; without torque, the flanks
    /// are in the middle of the lash. The pinion then keeps its distance from the path of perfect teeth.
    pub fn wind_up(&self, torque: f64, [q, v]: [&mut [f64]; 2]) {
        let depth = self.spring.displacement(torque);
        for _ in 0..ROUNDS {
            let Deviation { x, .. } = self.deviation([q[CARRIER], q[self.pinion], 0.0, 0.0]);
            q[self.pinion] += x - depth;
        }
        let Deviation { by_carrier, by_pinion, .. } = self.deviation([q[CARRIER], q[self.pinion], 0.0, 0.0]);
        v[self.pinion] = v[CARRIER] * (1.0 + by_carrier) / (1.0 - by_pinion);
    }
}
