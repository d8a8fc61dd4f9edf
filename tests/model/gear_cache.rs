//! Tests of the gear cache: it changes only the duration of a start.

use bevel_differential::contact::ContactLaw;
use bevel_differential::model::{GearCache, GearContact, Given, Inputs, Parameters, PlanetSpin, Simulation};
use bevel_differential::variables::{Access, Variable, check_ranges, table};

/// State and forces after the start and some steps, or the problems. The result is text that shows all bits of numbers.
fn outcome(p: &Parameters, cache: Option<&GearCache>) -> String {
    let inputs = Inputs { carrier_speed: 20.0, planet_spin: 3.0, ..Inputs::default() };
    let mut simulation = match Simulation::start_with(p, &inputs, 0.0, &Given { cache, ..Given::default() }) {
        Ok(simulation) => simulation,
        Err(problems) => return format!("{problems:?}"),
    };
    let warnings = format!("{:?}", simulation.warnings());
    let stepped = simulation.advance(1e-4);
    let forces = *simulation.forces();
    format!("{warnings} {stepped:?} {forces:?} {:?}", (simulation.state(), simulation.memories()))
}

/// Scenes that together fill every part of the cache.
fn scenes() -> Vec<Parameters> {
    let mut base = Parameters::default();
    base.scene.planet_spin = PlanetSpin::Imposed;
    let scene = |contact: GearContact, law: ContactLaw| {
        let mut p = base;
        (p.scene.gear_contact, p.contact.law) = (contact, law);
        p
    };
    let mut misaligned = scene(GearContact::Solid, ContactLaw::Impact);
    misaligned.effects.tooth_errors = true;
    misaligned.specs.tooth_errors.crowning = 1e-5;
    vec![
        scene(GearContact::Lumped, ContactLaw::Impact),
        scene(GearContact::Tooth, ContactLaw::Impact),
        scene(GearContact::Tooth, ContactLaw::LineWeber),
        misaligned,
    ]
}

/// Copies of `p` with other values of the parameter `row` within its range.
fn changed(p: &Parameters, row: &Variable) -> Vec<Parameters> {
    let with = |set: &dyn Fn(&mut Parameters)| {
        let mut other = *p;
        set(&mut other);
        other
    };
    let others = match row.access {
        Access::Real(at) => {
            let least = row.range.map_or(1.0, |range| 1e-3 * (range.max - range.min));
            let moved = |sign: f64| {
                with(&|p| {
                    let value = at(p);
                    *value = if *value == 0.0 { least } else { *value * (1.0 + 1e-3 * sign) };
                })
            };
            vec![[1.0, -1.0].map(moved).into_iter().find(|p| check_ranges(p).is_empty()).unwrap_or(*p)]
        }
        Access::Integer(at) => vec![with(&|p| *at(p) += 1), with(&|p| *at(p) -= 1)],
        Access::Boolean(at) => vec![with(&|p| *at(p) = !*at(p))],
        Access::Enumeration(kind, _, set) => {
            kind.choices.iter().map(|choice| with(&|p| set(p, choice.value))).collect()
        }
        Access::Input(_) | Access::Output(_) => Vec::new(),
    };
    others.into_iter().filter(|other| other != p && check_ranges(other).is_empty()).collect()
}

#[test]
fn every_parameter_acts_immediately_despite_the_cache() {
    for base in scenes() {
        let (cache, unchanged) = (GearCache::default(), outcome(&base, None));
        let mut acting = Vec::new();
        for row in table().rows {
            for p in changed(&base, row) {
                let expected = outcome(&p, None);
                assert_eq!(outcome(&p, Some(&cache)), expected, "{}", row.name);
                assert_eq!(outcome(&base, Some(&cache)), unchanged, "after {}", row.name);
                if expected != unchanged {
                    acting.push(row.name);
                }
            }
        }
        for name in ["geometry.module", "geometry.planet_teeth", "geometry.planet_bore", "material.density"] {
            assert!(acting.contains(&name), "{name}");
        }
        let elastic = base.scene.gear_contact == GearContact::Lumped || base.contact.law == ContactLaw::LineWeber;
        for name in ["geometry.root_fillet", "material.young_modulus", "material.poisson_ratio"] {
            assert!(acting.contains(&name) || !elastic, "{name}");
        }
        let solid = base.scene.gear_contact == GearContact::Solid;
        for name in ["solid.facets", "tooth_errors.crowning", "contact.damping"] {
            assert!(acting.contains(&name) || !solid, "{name}");
        }
    }
}

#[test]
fn threads_that_share_a_cache_get_the_bits_of_runs_without_a_cache() {
    let scenes: Vec<Parameters> = scenes()
        .into_iter()
        .flat_map(|p| {
            (0..8).map(move |i| {
                let mut p = p;
                p.geometry.module *= 1.0 + 1e-3 * f64::from(i);
                p
            })
        })
        .collect();
    let expected: Vec<String> = scenes.iter().map(|p| outcome(p, None)).collect();
    let cache = GearCache::default();
    std::thread::scope(|scope| {
        for thread in 0..8 {
            let (scenes, expected, cache) = (&scenes, &expected, &cache);
            scope.spawn(move || {
                for i in 0..2 * scenes.len() {
                    let i = (i + 5 * thread) % scenes.len();
                    assert!(outcome(&scenes[i], Some(cache)) == expected[i], "{i}");
                }
            });
        }
    });
}
