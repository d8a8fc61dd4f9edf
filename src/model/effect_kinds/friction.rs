//! Dry friction of all bodies that may stick: side gears on the carrier, planets on their pins, wheels in their brakes.

use super::body_friction::BodyFriction;
use super::dry_friction::DAMPING_TIME;
use super::{
    FrictionPart, FrictionSource, PlanetFriction, Ramps, SideFriction, SurfaceKind, SurfaceLoad, WheelFriction,
};
use crate::model::scene::{FRICTION_PLANETS, FRICTION_WHEELS, InputDerivatives, Inputs};
use crate::model::thermal::NODES;

/// Friction on each kind of body.
#[derive(Clone, Copy, Debug)]
pub struct Friction {
    /// Friction on each side gear.
    pub side: BodyFriction,
    /// Friction on each planet.
    pub planet: BodyFriction,
    /// Friction on the left and the right wheel.
    pub wheel: [BodyFriction; 2],
    /// Parts that convert the mesh torques on the side gears to pressure.
    pub ramps: Ramps,
    /// Function that returns the limit torques of both wheels [N·m]; `None` without brakes.
    wheel_limit: Option<fn(&Inputs) -> [f64; 2]>,
}

impl Friction {
    /// No friction.
    pub const NONE: Self = Self {
        side: BodyFriction::NONE,
        planet: BodyFriction::NONE,
        wheel: [BodyFriction::NONE; 2],
        ramps: Ramps::OWN_SIDE,
        wheel_limit: None,
    };

    /// Friction of `sources` with the lock at `lock` and all nodes at `temperatures` [K], under `inputs` and their
    /// derivatives. Brakes that are off add no friction.
    pub fn new(
        sources: &[FrictionSource],
        (lock, temperatures): (f64, &[f64; NODES]),
        inputs: &Inputs,
        input_derivatives: &InputDerivatives,
    ) -> Self {
        let mut all = Self::NONE;
        let heat_index_of =
            |of: fn(&FrictionSource) -> bool| sources.iter().find(|s| of(s)).map_or(0, |s| s.heat_index);
        all.side = BodyFriction::new(DAMPING_TIME, heat_index_of(|s| s.by_lock));
        all.planet = BodyFriction::new(DAMPING_TIME, 0);
        for (index, source) in (0..).zip(sources) {
            if !source.by_lock {
                all.add((index, source), 1.0, source.factor(temperatures));
            } else if lock > 0.0 {
                all.add((index, source), lock, 1.0);
            }
            if let Some(wheel) = &source.wheel {
                all.brake(wheel, (index, source), source.factor(temperatures), (inputs, input_derivatives));
            }
        }
        all
    }

    /// Largest number of friction parts on one body that `sources` have together.
    pub fn part_count(sources: &[FrictionSource]) -> usize {
        let of_side = |source: &FrictionSource| match source.side.stiffness {
            0.0 => 0,
            _ => 1 + usize::from(source.side.curve.is_some()),
        };
        let of_planet = |source: &FrictionSource| match source.planet.stiffness {
            0.0 => 0,
            _ => 1 + usize::from(source.varies_with_slip()),
        };
        let sum = |of: &dyn Fn(&FrictionSource) -> usize| sources.iter().map(of).sum::<usize>();
        sum(&of_side).max(sum(&of_planet)).max(sum(&|source| usize::from(source.wheel.is_some())))
    }

    /// Adds source number `index`. `part` is the applied fraction of its full force, and `factor` multiplies its
    /// friction.
    fn add(&mut self, (index, source): (u16, &FrictionSource), part: f64, factor: f64) {
        let varies_with_slip = source.varies_with_slip();
        let none = FrictionPart { heat_index: source.heat_index, source: index, ..FrictionPart::NONE };
        let SideFriction { constant, per_thrust, per_torque, ramps, curve, stiffness, .. } = source.side;
        if per_torque != 0.0 {
            self.ramps = ramps;
        }
        let side = FrictionPart { constant, per_thrust, per_load: per_torque, ..none }.times(part * factor);
        let spring = (part * stiffness, source.damping_time);
        match curve {
            Some(curve) => {
                let measured = FrictionPart { constant: curve.breakaway(), surface: SurfaceKind::SideCurve, ..none };
                self.side.push(&[side, measured], spring, varies_with_slip);
            }
            None => self.side.push(&[side], spring, varies_with_slip),
        }
        let PlanetFriction { per_pin_force: per_load, per_thrust, stiffness, .. } = source.planet;
        let pin = FrictionPart { per_load, surface: SurfaceKind::Pin, ..none };
        let washer = FrictionPart { per_thrust, surface: SurfaceKind::PlanetWasher, ..none };
        let spring = (part * stiffness, source.damping_time);
        if varies_with_slip {
            self.planet.push(&[pin, washer].map(|of| of.times(part * factor)), spring, true);
        } else {
            self.planet.push(&[FrictionPart { per_thrust, ..pin }.times(part * factor)], spring, false);
        }
    }

    /// Adds the brakes `wheel` of source number `index`. A brake whose torque and its derivatives are 0 adds no
    /// friction.
    fn brake(
        &mut self,
        wheel: &WheelFriction,
        (index, source): (u16, &FrictionSource),
        factor: f64,
        (inputs, input_derivatives): (&Inputs, &InputDerivatives),
    ) {
        let [first, second] = &input_derivatives.rates;
        let limits = [inputs, first, second].map(wheel.limit);
        for s in 0..2 {
            self.wheel[s] = BodyFriction::commanded(wheel.damping_time[s], source.heat_index);
            if limits.iter().any(|limit| limit[s] != 0.0) {
                let part = FrictionPart {
                    per_load: 1.0,
                    heat_index: source.heat_index,
                    source: index,
                    surface: SurfaceKind::Wheel,
                    ..FrictionPart::NONE
                };
                let spring = (wheel.stiffness, wheel.damping_time[s]);
                self.wheel[s].push(&[part.times(factor)], spring, source.varies_with_slip());
            }
        }
        self.wheel_limit = Some(wheel.limit);
    }

    /// Friction on body `i` of the bodies that may stick.
    #[inline]
    pub fn on(&self, i: usize) -> &BodyFriction {
        match i {
            0..FRICTION_PLANETS => &self.side,
            FRICTION_PLANETS..FRICTION_WHEELS => &self.planet,
            _ => &self.wheel[i - FRICTION_WHEELS],
        }
    }

    /// Bit mask of the bodies with friction, by their numbers among the bodies that may stick. `planets` is the number
    /// of planet groups.
    #[inline]
    pub fn mask(&self, planets: usize) -> u32 {
        let of = |bits: u32, friction: &BodyFriction| if friction.is_on() { bits } else { 0 };
        let planet_bits = ((1 << planets) - 1) << FRICTION_PLANETS;
        let sides = of((1 << FRICTION_PLANETS) - 1, &self.side) | of(planet_bits, &self.planet);
        sides | of(1 << FRICTION_WHEELS, &self.wheel[0]) | of(2 << FRICTION_WHEELS, &self.wheel[1])
    }

    /// True if any body has friction.
    pub fn is_any(&self) -> bool {
        self.side.is_on() || self.planet.is_on() || self.wheel[0].is_on() || self.wheel[1].is_on()
    }

    /// True if limit torques depend on the loads of the meshes.
    pub fn depends_on_load(&self) -> bool {
        self.side.depends_on_load() || self.planet.depends_on_load()
    }

    /// Surface loads of both wheels under `inputs`: their limit torques.
    #[inline]
    pub fn wheel_loads(&self, inputs: &Inputs) -> [SurfaceLoad; 2] {
        match self.wheel_limit {
            Some(limit) => limit(inputs).map(|load| SurfaceLoad { thrust: 0.0, load }),
            None => [SurfaceLoad::default(); 2],
        }
    }
}
