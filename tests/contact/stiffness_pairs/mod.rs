//! Gear pairs for tests of tooth stiffness: the pairs of the references, and random pairs over most of the range that
//! the interface allows.
#![allow(dead_code)] // each test file uses only some of these items

use crate::random::Draws;
use bevel_differential::contact::stiffness::{Elasticity, PairStiffness, RootSpec};
use bevel_differential::geometry::{AddendumSystem, GearSpec, Pair, checks};
use fastrand::Rng;

/// Pa per N/(mm·µm).
pub const PER_MM_UM: f64 = 1e9;
/// The study's steel.
pub const STEEL: Elasticity = Elasticity { young: 2.07e11, poisson: 0.25 };
/// Line load of the references [N/m].
pub const LINE_LOAD: f64 = 400e3;

/// Stiffness of the pair `spec` with fillets of `fillet` modules.
pub fn stiffness(spec: &GearSpec, fillet: f64) -> PairStiffness {
    let root = RootSpec { fillet };
    PairStiffness::new(&Pair::new(spec), &root, STEEL.young, STEEL.poisson, LINE_LOAD).expect("a buildable pair")
}

/// The gears of golden_fe3d_B.csv: addenda of the default, clearance 0.25 modules.
pub fn golden_spec() -> GearSpec {
    let side = 0.540 + 0.460 / 2.56;
    GearSpec {
        addendum_system: AddendumSystem::Explicit,
        planet_addendum: 2.0 - side,
        side_addendum: side,
        planet_dedendum: 4.36359 / 4.5,
        side_dedendum: 6.88641 / 4.5,
        ..GearSpec::default()
    }
}

/// Stiffness of the gears of golden_fe3d_B.csv.
pub fn golden() -> PairStiffness {
    stiffness(&golden_spec(), 0.25)
}

/// Stiffness of the default pair.
pub fn default() -> PairStiffness {
    stiffness(&GearSpec::default(), RootSpec::default().fillet)
}

/// An endless sequence of random specifications.
pub fn random_pairs(seed: u64) -> impl Iterator<Item = GearSpec> {
    let mut u = Rng::with_seed(seed);
    std::iter::repeat_with(move || {
        // uniform in the logarithm, so that small numbers of teeth are as frequent as large ones
        let teeth = |u: &mut Rng| (5.0 * 40.999f64.powf(u.f64())) as i32;
        let system = (u.f64() * 6.0) as i32;
        let (planet_teeth, side_teeth) = (teeth(&mut u), teeth(&mut u));
        let module = 1e-3 * u.between(0.5, 20.0);
        // unusual addenda with dedenda that leave some clearance
        let addenda = [u.between(0.05, 2.0), u.between(0.05, 2.0)];
        let clearance = [u.between(0.001, 0.6), u.between(0.001, 0.6)];
        let spec = GearSpec {
            module,
            planet_teeth,
            side_teeth,
            pressure_angle: u.between(10.0, 30.0).to_radians(),
            shaft_angle: if u.f64() < 0.5 { 90.0 } else { u.between(40.0, 130.0) }.to_radians(),
            backlash: if u.f64() < 0.5 { 0.0 } else { module * u.between(0.0, 0.1) },
            addendum_system: match system {
                0 => AddendumSystem::Standard,
                1 => AddendumSystem::Gleason,
                2 => AddendumSystem::Iso23509,
                _ => AddendumSystem::Explicit,
            },
            planet_addendum: addenda[0],
            side_addendum: addenda[1],
            planet_dedendum: addenda[1] + clearance[0],
            side_dedendum: addenda[0] + clearance[1],
            ..GearSpec::default()
        };
        let outer_cone = Pair::new(&spec).outer_cone;
        GearSpec { face_width: outer_cone * u.between(0.05, 0.6), ..spec }
    })
}

/// True if the pair passes the checks and both pitch angles are below 1.55 rad (88.8°).
pub fn buildable(spec: &GearSpec) -> bool {
    let pair = Pair::new(spec);
    let bevel = pair.gears.iter().all(|g| g.pitch > 0.0 && g.pitch < 1.55);
    bevel && checks::errors(spec, &pair).is_empty()
}
