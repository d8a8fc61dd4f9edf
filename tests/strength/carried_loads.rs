//! A step is rated from the loads at the end of the previous step. They are cached and must equal the loads of the
//! state itself.

use bevel_differential::model::{Given, Inputs, Parameters, PlanetSpin, Simulation};

/// The study's turn from teeth in mid-gap, with ratings; it has impacts and a ripple in every step.
fn turn() -> (Parameters, Inputs) {
    let (mut p, mut i) = (Parameters::default(), Inputs::default());
    p.scene.planet_spin = PlanetSpin::Imposed;
    p.effects.strength = true;
    (i.carrier_speed, i.planet_spin) = (954f64.to_radians(), 200f64.to_radians());
    (p, i)
}

/// Copies the simulation without its cached loads.
fn without_cached_loads(simulation: &Simulation, p: &Parameters, i: &Inputs) -> Simulation {
    let mut memories = simulation.memories().clone();
    memories.strength = memories.strength.get().cloned().into();
    Simulation::resume_with(p, i, (*simulation.state(), Some(memories)), &Given::default()).unwrap()
}

#[test]
fn damage_has_the_same_bits_with_and_without_cached_loads() {
    let (mut p, i) = turn();
    let mut cached = Simulation::start(&p, &i, 0.0).unwrap();
    let mut fresh = cached.clone();
    for k in 1..=40 {
        if k == 20 {
            // from here on, the same motion has different forces
            p.contact.damping *= 3.0;
            cached.tune(&p);
            fresh.tune(&p);
        }
        fresh = without_cached_loads(&fresh, &p, &i);
        for simulation in [&mut cached, &mut fresh] {
            simulation.advance(f64::from(k) * 2.5e-4).unwrap();
        }
        assert_eq!(cached.memories().strength, fresh.memories().strength, "{k}");
    }
    let has_loads = |simulation: &Simulation| {
        let damage = simulation.memories().strength.get().unwrap();
        damage.last_loads.as_ref().is_some_and(|loads| loads.teeth.0 > 0)
    };
    assert!(has_loads(&cached) && !has_loads(&without_cached_loads(&cached, &p, &i)));
}
