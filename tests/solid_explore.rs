use bevel_differential::model::{GearContact, Inputs, Parameters, PlanetSpin, Simulation};
#[test]
fn explore() {
    let facets: Vec<i32> = std::env::var("F").unwrap().split(',').map(|f| f.parse().unwrap()).collect();
    for facets in facets {
        let mut p = Parameters::default();
        p.scene.gear_contact = if facets == 0 { GearContact::Tooth } else { GearContact::Solid };
        p.scene.planet_spin = PlanetSpin::Imposed;
        p.solid.facets = facets.max(2);
        if let Ok(s) = std::env::var("S") {
            p.solid.smoothing = s.parse().unwrap();
        }
        let inputs =
            Inputs { carrier_speed: 954f64.to_radians(), planet_spin: 200f64.to_radians(), ..Inputs::default() };
        let mut s = match Simulation::start(&p, &inputs, 0.0) {
            Ok(s) => s,
            Err(e) => {
                println!("{facets}: {e:?}");
                continue;
            }
        };
        let t0 = std::time::Instant::now();
        let (mut mean, mut peak, mut low, mut w, mut te) =
            (0.0, 0.0f64, f64::MAX, (f64::MAX, 0.0f64), (f64::MAX, f64::MIN));
        let n = 500;
        let mut ok = true;
        for i in 0..n {
            if let Err(e) = s.advance(0.5 * (i + 1) as f64 / n as f64) {
                println!("{e:?}");
                ok = false;
                break;
            }
            let fo = *s.forces();
            mean += fo.side_normal[0] / n as f64;
            peak = peak.max(fo.side_normal[0]);
            low = low.min(fo.side_normal[0]);
            let v = s.motion().side_speed[0].to_degrees();
            w = (w.0.min(v), w.1.max(v));
            let e = fo.mesh[0][0].transmission_error * 1e6;
            te = (te.0.min(e), te.1.max(e));
            if t0.elapsed().as_secs_f64() > 20.0 {
                println!("stop at {i}");
                break;
            }
        }
        let b = s.books();
        println!(
            "{facets} {ok}: {:.3} s, mean {mean:.2} peak {peak:.1} low {low:.1}, speed {:.4}..{:.4}, te {:.3}..{:.3} um, steps {} rej {} rhs {} residual {:.2e}",
            t0.elapsed().as_secs_f64(),
            w.0,
            w.1,
            te.0,
            te.1,
            b.steps,
            b.rejected,
            b.rhs_calls,
            b.energy_residual
        );
    }
}
