//! Friction of a pinion that grows with the torque T of its mesh, T_f = i c₀ + c₁ |T| at the carrier's speed.
//!
//! With a rigid mesh, T is the torque of the constraint: T = D − s T_f − B ω̇_c, with the torque D in front of the mesh,
//! the inertia B = i² J_p of the pinion and s = sgn ω. The part E = s c₁ |T| of the friction changes ω̇_c by −μ E, with
//! the mobility μ of the carrier. With T₀ and ω̇₀ without this part,
//!
//! ```text
//! T (1 + s c₁ σ (1 − B μ)) = T₀ = D − s i c₀ − B ω̇₀,   σ = sgn T = sgn T₀
//! ```
//!
//! which has one solution, because c₁ < 1 and 0 ≤ B μ ≤ 1. If the drive imposes the speed of the carrier, the friction
//! changes the torque of the drive instead of ω̇_c, and T = T₀.

use super::FrictionEquations;
use super::inputs_and_friction::slip;
use super::ledger_rates::LedgerRates;
use crate::integrate::{Matrix, Point};
use crate::model::effect_kinds::{Action, Loss, Mode, Slopes, SurfaceLoad};
use crate::model::scene::{CARRIER, PINION_PAIR};
use crate::model::setup::HEATS;

/// A pinion that slides in its bearings, rigid with the carrier.
#[derive(Clone, Copy)]
pub struct SlidingPinion {
    loss: Loss,
    /// s: direction of sliding.
    direction: f64,
    /// i c₀ [N·m].
    unloaded: f64,
    /// B [kg·m²].
    inertia: f64,
    /// μ [1/(kg·m²)]; `None` if the drive imposes the speed of the carrier.
    mobility: Option<f64>,
    heat_index: usize,
}

impl SlidingPinion {
    /// True if the speed of the carrier is not imposed.
    pub fn is_free(&self) -> bool {
        self.mobility.is_some()
    }

    /// T₀ from the torque D in front of the mesh and ω̇₀ [N·m].
    fn unreduced(&self, driven: f64, acceleration: f64) -> f64 {
        driven - self.direction * self.unloaded - self.inertia * acceleration
    }

    /// E/T₀ for the sign of T₀.
    fn share(&self, unreduced: f64) -> f64 {
        let along = self.direction * self.loss.coefficient(unreduced) * if unreduced < 0.0 { -1.0 } else { 1.0 };
        along / self.mobility.map_or(1.0, |mobility| 1.0 + along * (1.0 - self.inertia * mobility))
    }

    /// Subtracts E from the sum of the torques on the carrier and adds its heat, at the `speed` of the carrier [rad/s].
    pub fn brake(
        &self,
        (driven, acceleration, speed): (f64, f64, f64),
        sum: &mut [f64],
        ledger_rates: &mut LedgerRates,
    ) {
        let unreduced = self.unreduced(driven, acceleration);
        let torque = self.share(unreduced) * unreduced;
        sum[CARRIER] -= torque;
        ledger_rates.heat[self.heat_index] += torque * speed;
        ledger_rates.limit[PINION_PAIR] += torque * self.direction;
    }

    /// Subtracts the derivatives of E from the derivatives of the torques on the carrier, given those of D, and those of
    /// ω̇₀.
    pub fn brake_slopes<const N: usize>(
        &self,
        (driven, acceleration): (f64, f64),
        slopes: [(&[f64; N], &[f64; N]); 2],
        forces: [&mut Matrix<N>; 2],
    ) {
        let share = self.share(self.unreduced(driven, acceleration));
        for ((by_driven, by_acceleration), forces) in slopes.into_iter().zip(forces) {
            for (k, force) in forces[CARRIER].iter_mut().enumerate() {
                *force -= share * (by_driven[k] - self.inertia * by_acceleration[k]);
            }
        }
    }
}

/// Equations with a pinion whose friction depends on the torque of its mesh.
pub trait PinionLoss<const N: usize>: FrictionEquations<N> {
    /// Load of the pinion's bearings that follows from the torque of its mesh, c₁ |T| [N·m], at `at`, `time` [s] after
    /// the inputs were set.
    fn pinion_load(&self, at: &Point<N>, time: f64) -> SurfaceLoad {
        let load = self.body_effects().and_then(|all| all.loss).map_or(0.0, |loss| loss.of(self.mesh_torque(at, time)));
        SurfaceLoad { load, ..SurfaceLoad::default() }
    }

    /// Torque T of the mesh at the carrier's speed [N·m], `time` [s] after the inputs were set.
    #[inline(never)]
    fn mesh_torque(&self, at: &Point<N>, time: f64) -> f64 {
        let motion = self.body_motion(at);
        let all = self.body_effects().map_or(&[][..], |all| &all.forces);
        if let Some(torque) = all.iter().find_map(|effect| effect.mesh_torque(&motion)) {
            return torque;
        }
        let on_pinion = if self.layout().port == CARRIER { self.drive_torque(at, time) } else { 0.0 };
        let driven = self.torque_in_front(at) + on_pinion;
        let rest = driven - self.plan().on_carrier * self.acceleration_at(at, time)[CARRIER];
        let Some(pair) = self.pair(PINION_PAIR) else { return rest };
        let (friction, state) = self.friction_on(pair);
        if !friction.is_on() {
            return rest;
        }
        let unreduced = rest - friction.torque(state, &slip(at, pair), &SurfaceLoad::default());
        let loss = self.body_effects().and_then(|all| all.loss).filter(|_| state.mode != Mode::Stuck);
        unreduced
            / loss.map_or(1.0, |loss| 1.0 + state.mode.direction() * loss.coefficient(unreduced) * unreduced.signum())
    }

    /// The pinion, if it is rigid with the carrier and slides, and its friction depends on the torque of the mesh.
    #[inline]
    fn sliding_pinion(&self) -> Option<SlidingPinion> {
        let loss = self.body_effects()?.loss?;
        if self.has_dry_friction() { self.sliding_pinion_with(loss) } else { None }
    }

    #[inline(never)]
    fn sliding_pinion_with(&self, loss: Loss) -> Option<SlidingPinion> {
        let (plan, layout) = (self.plan(), self.layout());
        let pair = self.pair(PINION_PAIR).filter(|_| layout.pinion() == CARRIER)?;
        let (friction, state) = self.friction_on(pair);
        let direction = state.mode.direction();
        let imposed = plan.drive_imposed && layout.port == CARRIER;
        (direction != 0.0 && friction.is_on()).then(|| SlidingPinion {
            loss,
            direction,
            unloaded: friction.sliding_limit(0.0, &Default::default())[0],
            inertia: plan.on_carrier,
            mobility: (!imposed).then(|| self.carrier_mobility()),
            heat_index: friction.heat_index(),
        })
    }

    /// Torque in front of the mesh of a rigid pinion, without that of a drive on the pinion itself [N·m].
    fn torque_in_front(&self, at: &Point<N>) -> f64 {
        let (mut force, mut heat) = ([0.0; N], [0.0; HEATS]);
        let (motion, mut out) = (self.body_motion(at), Action { force: &mut force, heat: &mut heat });
        for effect in self.body_effects().into_iter().flat_map(|all| all.forces.iter()).filter(|of| of.is_in_front()) {
            effect.act(&motion, &mut out);
        }
        force[CARRIER]
    }

    /// Derivatives of [`Self::torque_in_front`] with respect to positions and velocities.
    fn slopes_in_front(&self, at: &Point<N>) -> [[f64; N]; 2] {
        let (mut by_position, mut by_velocity) = ([[0.0; N]; N], [[0.0; N]; N]);
        let (motion, mut out) = (self.body_motion(at), Slopes::new([&mut by_position, &mut by_velocity]));
        for effect in self.body_effects().into_iter().flat_map(|all| all.forces.iter()).filter(|of| of.is_in_front()) {
            effect.slopes(&motion, &mut out);
        }
        [by_position[CARRIER], by_velocity[CARRIER]]
    }
}

impl<const N: usize, E: FrictionEquations<N> + ?Sized> PinionLoss<N> for E {}
