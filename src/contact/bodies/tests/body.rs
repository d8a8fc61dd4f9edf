//! Loads at tooth roots and displacements of the gear body, checked against sums over points and closed forms.

use super::*;
use crate::contact::stiffness::SectionSpec;
use crate::geometry::GearSpec;
use crate::numeric::cos;

/// A complex number: real and imaginary part.
#[derive(Clone, Copy)]
struct Complex(f64, f64);

/// Points over a root.
const POINTS: usize = 4000;

/// ζ at the middle of strip `k` of the root, its width dζ, and the tractions (along R, φ and ζ) of unit loads there.
fn tractions(root: &RootPatch, k: usize) -> (f64, f64, [[f64; 3]; 3]) {
    let y = 2.0 * (k as f64 + 0.5) / POINTS as f64 - 1.0;
    let zeta = y * root.half_azimuth;
    let (s, c) = (sin(root.polar), cos(root.polar));
    let width = root.half_azimuth * s;
    // across the tooth and along it, as vectors x, y, z with the axis z and the tooth in the plane x, z
    let (across, along) = ([0.0, 1.0, 0.0], [c, 0.0, -s]);
    let spread = [0.75 * (1.0 - y * y) / width, 0.5 / width, -1.5 * y / (width * width)];
    let frame = [[s * cos(zeta), s * sin(zeta), c], [c * cos(zeta), c * sin(zeta), -s], [-sin(zeta), cos(zeta), 0.0]];
    let of = |vector: [f64; 3], size: f64| frame.map(|e| size * (0..3).map(|i| e[i] * vector[i]).sum::<f64>());
    let width = 2.0 * root.half_azimuth / POINTS as f64;
    (zeta, width, [of(across, spread[0]), of(along, spread[1]), of(along, spread[2])])
}

#[test]
fn displacements_of_other_teeth_match_the_summed_field() {
    // the field of one load is summed harmonic by harmonic, and then its work on another tooth, without use of parity
    let pair = Pair::new(&GearSpec::default());
    let section = SectionSpec::of_gear(&pair, 1).with_fillet(0.4 * pair.module, "").expect("a gap");
    let elasticity = Elasticity { young: 2.07e11, poisson: 0.25 };
    let mut body = GearBody::new(&pair, 1, (&section, &elasticity), Support::Bore(0.03), "").expect("a body");
    body.harmonics.truncate(FINITE + 1);
    let face = [pair.inner_cone, pair.outer_cone];
    let held = Support::Bore(0.03).held(&pair, 1, "").expect("a bore");
    let cone = HollowCone { surface: body.root.polar, held, face, elasticity };
    let s = sin(body.root.polar);
    for acting in 0..3 {
        let waves: Vec<[Complex; 3]> = (0..=FINITE)
            .map(|n| {
                let mut wave = [Complex(0.0, 0.0); 3];
                for k in 0..POINTS {
                    let (zeta, width, traction) = tractions(&body.root, k);
                    let (real, imaginary) = (cos(n as f64 * zeta), -sin(n as f64 * zeta));
                    for (sum, t) in wave.iter_mut().zip(traction[acting]) {
                        *sum = Complex(sum.0 + t * real * width / TAU, sum.1 + t * imaginary * width / TAU);
                    }
                }
                // W = i w
                wave[2] = Complex(wave[2].1, -wave[2].0);
                let compliance = cone.compliance(n, false, ACROSS).expect("elastic");
                let mut moved = [0, 1, 2].map(|i| {
                    let part = |of: fn(&Complex) -> f64| (0..3).map(|j| compliance[(i, j)] * of(&wave[j])).sum::<f64>();
                    Complex(s * part(|z| z.0), s * part(|z| z.1))
                });
                moved[2] = Complex(-moved[2].1, moved[2].0);
                moved
            })
            .collect();
        for angle in [0.0, 0.39, -0.39, 2.0] {
            let between = body.compliance_between(angle);
            for measured in 0..3 {
                let mut work = 0.0;
                for k in 0..POINTS {
                    let (zeta, width, traction) = tractions(&body.root, k);
                    for (n, moved) in waves.iter().enumerate() {
                        let (real, imaginary) = (cos(n as f64 * (zeta + angle)), sin(n as f64 * (zeta + angle)));
                        let twice = if n == 0 { 1.0 } else { 2.0 };
                        for (t, u) in traction[measured].iter().zip(moved) {
                            work += twice * t * (u.0 * real - u.1 * imaginary) * s * width;
                        }
                    }
                }
                let scale = (body.compliance_between(0.0)[acting][acting]
                    * body.compliance_between(0.0)[measured][measured])
                    .sqrt();
                let found = between[measured][acting];
                assert!((found - work).abs() < 1e-5 * scale, "{measured} {acting} at {angle}: {found:e} {work:e}");
            }
        }
    }
}

#[test]
fn a_bore_that_transmits_torque_lets_all_teeth_turn_with_the_load() {
    let pair = Pair::new(&GearSpec::default());
    let section = SectionSpec::of_gear(&pair, 1).with_fillet(0.4 * pair.module, "").expect("a gap");
    let elasticity = Elasticity { young: 2.07e11, poisson: 0.25 };
    let body = |support| GearBody::new(&pair, 1, (&section, &elasticity), support, "").expect("a body");
    // a body held by its bore turns with the load; if the body is free to turn, the mean displacement of all roots is
    // zero
    let [held, free] = [Support::Bore(0.01), Support::FreeBore(0.01)].map(body);
    let mean =
        |body: &GearBody| (0..64).map(|k| body.compliance_between(TAU * f64::from(k) / 64.0)[0][0]).sum::<f64>() / 64.0;
    assert!(mean(&held) > 0.2 * held.compliance_between(0.0)[0][0]);
    assert!(mean(&free).abs() < 1e-3 * free.compliance_between(0.0)[0][0]);
}

#[test]
fn compliances_beyond_the_finite_harmonics_continue_smoothly() {
    let pair = Pair::new(&GearSpec::default());
    let section = SectionSpec::of_gear(&pair, 1).with_fillet(0.4 * pair.module, "").expect("a gap");
    let elasticity = Elasticity { young: 2.07e11, poisson: 0.25 };
    let support = Support::Bore(0.03);
    let body = GearBody::new(&pair, 1, (&section, &elasticity), support, "").expect("a body");
    let held = support.held(&pair, 1, "").expect("a bore");
    let cone = HollowCone { surface: body.root.polar, held, face: [pair.inner_cone, pair.outer_cone], elasticity };
    let n = FINITE + 1;
    let finite = cone.compliance(n, support.is_free_to_turn(), ACROSS).expect("elastic");
    let waves = body.root.waves(n);
    let factor = 2.0 * TAU * sin(body.root.polar) * sin(body.root.polar);
    for (row, load) in waves.iter().enumerate() {
        let expected =
            factor * (0..3).map(|i| load[i] * (0..3).map(|j| finite[(i, j)] * load[j]).sum::<f64>()).sum::<f64>();
        let found = body.harmonics[n][row][row];
        assert!((found / expected - 1.0).abs() < 0.03, "{row}: {found:e} {expected:e}");
    }
}
