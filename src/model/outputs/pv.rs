//! Pressure times speed of all rubbing surfaces, for readings and warnings.

use crate::integrate::Point;
use crate::model::dynamics::FrictionEquations;
use crate::model::effect_kinds::{FrictionSource, Pressed, Surface};
use crate::model::scene::{FRICTION_PLANETS, FRICTION_WHEELS};

/// Calls `see` with each surface of `sources` that slides at `at`, and its p·v [W/m²].
pub fn each_pv<const N: usize>(
    equations: &impl FrictionEquations<N>,
    sources: &[FrictionSource],
    at: &Point<N>,
    mut see: impl FnMut(&FrictionSource, Surface, f64),
) {
    let sliding = |i: &usize| {
        let (friction, state, _) = equations.friction_on(*i);
        friction.is_on() && state.mode.direction() != 0.0
    };
    if !equations.has_dry_friction() || !equations.bodies_that_stick().any(|i| sliding(&i)) {
        return;
    }
    let loads = equations.surface_loads(at, 0.0);
    for i in equations.bodies_that_stick().filter(sliding) {
        let speed = equations.friction_on(i).1.mode.direction() * equations.slip(at, i).speed;
        let pv = |pressed: &Pressed| pressed.at(&loads[i]) * speed.max(0.0);
        for source in sources {
            match i {
                0..FRICTION_PLANETS => see(source, Surface::Side(i), pv(&source.side.pressed)),
                FRICTION_PLANETS..FRICTION_WHEELS => {
                    let (g, [pin, washer]) = (i - FRICTION_PLANETS, source.planet.pressed);
                    see(source, Surface::Pin(g), pv(&pin));
                    see(source, Surface::PlanetWasher(g), pv(&washer));
                }
                _ => {
                    if let Some(wheel) = &source.wheel {
                        see(source, Surface::Wheel(i - FRICTION_WHEELS), pv(&wheel.pressed));
                    }
                }
            }
        }
    }
}
