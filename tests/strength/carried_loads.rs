//! A step is rated from the loads with which the one before ended. They are kept, and must be those of the state itself.

use bevel_differential::model::{Given, Inputs, Parameters, PlanetSpin, Simulation, Watched};

/// The study's turn from teeth in mid-gap, with ratings: blows and a ripple in every step.
fn turn() -> (Parameters, Inputs) {
    let (mut p, mut i) = (Parameters::default(), Inputs::default());
    p.scene.planet_spin = PlanetSpin::Imposed;
    p.effects.strength = true;
    (i.carrier_speed, i.planet_spin) = (954f64.to_radians(), 200f64.to_radians());
    (p, i)
}

/// The same simulation, without loads that were kept.
fn without_kept_loads(simulation: &Simulation, p: &Parameters, i: &Inputs) -> Simulation {
    let watched = Watched { last_loads: None, ..*simulation.watched() };
    Simulation::resume_with(p, i, (*simulation.state(), watched), &Given::default()).unwrap()
}

#[test]
fn damage_is_the_same_to_the_last_bit_whether_loads_were_kept_or_not() {
    let (mut p, i) = turn();
    let mut kept = Simulation::start(&p, &i, 0.0).unwrap();
    let mut fresh = kept.clone();
    for k in 1..=40 {
        if k == 20 {
            // the forces of the same motion are others from here on
            p.contact.damping *= 3.0;
            kept.tune(&p);
            fresh.tune(&p);
        }
        fresh = without_kept_loads(&fresh, &p, &i);
        for simulation in [&mut kept, &mut fresh] {
            simulation.advance(f64::from(k) * 2.5e-4).unwrap();
        }
        assert_eq!(kept.watched().fatigue, fresh.watched().fatigue, "{k}");
    }
    assert!(kept.watched().last_loads.is_some());
}
