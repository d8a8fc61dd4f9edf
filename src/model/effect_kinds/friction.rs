//! Dry friction of all pairs that rub on each other, under the present commands and temperatures.

use super::body_friction::{BodyFriction, MOST_SURFACES};
use super::dry_friction::DAMPING_TIME;
use super::rubbing_surface::SideLimits;
use super::{Command, Ramps, RubbingSurface, SurfaceLoad};
use crate::model::scene::{InputDerivatives, Inputs, PAIRS, PINION_PAIR, RubbingKind};
use crate::model::thermal::NODES;
use crate::problem::Problem;

/// Number of the friction on each pair. Pairs that are alike share one.
const FRICTION_OF: [usize; PAIRS] = {
    let mut of = [0; PAIRS];
    let mut i = 1;
    while i < PAIRS {
        let (kind, k) = RubbingKind::of(i);
        of[i] = if kind.is_alike() && k > 0 { of[i - 1] } else { of[i - 1] + 1 };
        i += 1;
    }
    of
};

/// Number of different frictions.
const FRICTIONS: usize = FRICTION_OF[PAIRS - 1] + 1;

/// Number of kinds of pairs whose limit torques are commanded.
const COMMANDED: usize = {
    let (mut count, mut k) = (0, 0);
    while k < RubbingKind::ALL.len() {
        count += RubbingKind::ALL[k].is_commanded() as usize;
        k += 1;
    }
    count
};

/// Friction on all pairs.
#[derive(Clone, Copy, Debug)]
pub struct Friction {
    frictions: [BodyFriction; FRICTIONS],
    /// Bit mask of the pairs with friction, by their numbers.
    pub mask: u32,
    /// Parts that convert the mesh torques on the side gears to pressure.
    pub ramps: Ramps,
    /// Kinds of pairs on a left and a right side whose limit torques are commanded, with the function that returns these.
    commanded: [Option<(RubbingKind, SideLimits)>; COMMANDED],
}

impl Friction {
    /// No friction.
    pub const NONE: Self = Self {
        frictions: [BodyFriction::NONE; FRICTIONS],
        mask: 0,
        ramps: Ramps::OWN_SIDE,
        commanded: [None; COMMANDED],
    };

    /// Friction of `surfaces` with the lock at `lock` and all nodes at `temperatures` [K], under `inputs` and their
    /// derivatives. A brake whose torque and its derivatives are 0 adds no friction.
    pub fn new(
        surfaces: &[RubbingSurface],
        (lock, temperatures): (f64, &[f64; NODES]),
        inputs: &Inputs,
        input_derivatives: &InputDerivatives,
    ) -> Self {
        let mut all = Self::NONE;
        let lock_heat = surfaces.iter().find(|surface| surface.is_lock()).map_or(0, |lock| lock.heat_index);
        all.frictions.fill(BodyFriction::new(DAMPING_TIME, lock_heat));
        for (index, surface) in (0..).zip(surfaces) {
            let factor = surface.factor(temperatures);
            if surface.limit.per_load != 0.0 && surface.kind == RubbingKind::Side {
                all.ramps = surface.ramps;
            }
            match surface.command {
                Command::Limits(limits) => {
                    all.command((index, surface), limits, factor, (inputs, input_derivatives));
                }
                Command::Lock if lock == 0.0 => {}
                command => {
                    let pressed = if matches!(command, Command::Lock) { lock } else { 1.0 };
                    let of = &mut all.frictions[FRICTION_OF[surface.kind.number(0)]];
                    of.push((index, surface), [pressed, factor, surface.damping_time[0]]);
                }
            }
        }
        for i in 0..PAIRS {
            all.mask |= u32::from(all.on(i).is_on()) << i;
        }
        all
    }

    /// Adds surface number `index`, whose limit torques on the left and the right side are `limits`.
    fn command(
        &mut self,
        (index, surface): (u16, &RubbingSurface),
        limits: SideLimits,
        factor: f64,
        (inputs, input_derivatives): (&Inputs, &InputDerivatives),
    ) {
        let [first, second] = &input_derivatives.rates;
        let commanded = [inputs, first, second].map(limits);
        for s in 0..2 {
            let damping_time = surface.damping_time[s];
            let friction = &mut self.frictions[FRICTION_OF[surface.kind.number(s)]];
            *friction = BodyFriction::commanded(damping_time, surface.heat_index);
            if commanded.iter().any(|limit| limit[s] != 0.0) {
                friction.push((index, surface), [1.0, factor, damping_time]);
            }
        }
        if let Some(free) = self.commanded.iter_mut().find(|of| of.is_none()) {
            *free = Some((surface.kind, limits));
        }
    }

    /// Fails if there are too many surfaces on one kind of pair.
    pub fn check(surfaces: &[RubbingSurface]) -> Result<(), Problem> {
        let count = |kind: &RubbingKind| surfaces.iter().filter(|surface| surface.kind == *kind).count();
        let most = RubbingKind::ALL.iter().map(count).max().unwrap_or(0);
        if most <= MOST_SURFACES {
            return Ok(());
        }
        Err(problem!("effects", "they put {most} dry frictions on one body, but it takes at most {MOST_SURFACES}"))
    }

    /// Friction on the pair with this number.
    #[inline]
    pub fn on(&self, number: usize) -> &BodyFriction {
        &self.frictions[FRICTION_OF[number]]
    }

    /// True if any pair has friction.
    pub fn is_any(&self) -> bool {
        self.mask != 0
    }

    /// True if limit torques depend on the loads of the meshes.
    pub fn depends_on_load(&self) -> bool {
        let of_pinion = FRICTION_OF[PINION_PAIR];
        self.frictions[..of_pinion].iter().any(BodyFriction::depends_on_load)
    }

    /// Adds the commanded limit torques under `inputs` to the loads on the surfaces.
    #[inline]
    pub fn add_commands(&self, inputs: &Inputs, loads: &mut [SurfaceLoad; PAIRS]) {
        for (kind, limits) in self.commanded.iter().flatten() {
            for (s, load) in limits(inputs).into_iter().enumerate() {
                loads[kind.number(s)].load = load;
            }
        }
    }

    /// Loads on the surfaces under `inputs` if meshes press none of them.
    pub fn commanded_loads(&self, inputs: &Inputs) -> [SurfaceLoad; PAIRS] {
        let mut loads = [SurfaceLoad::default(); PAIRS];
        self.add_commands(inputs, &mut loads);
        loads
    }
}
