//! Mass and moments of inertia of a gear from its solid, by parry3d.
//!
//! The solid: every tooth outline (involute flanks, meridian below the base circle, tip and root cones) swept along
//! the rays through the apex from R_i to R_e, closed by flat cones down to the bore at the height of the root circle.

use parry3d_f64::mass_properties::MassProperties;
use parry3d_f64::math::Vector;

use super::involute::{Gear, direction};
use crate::numeric::{cos, sin};

/// Facets per flank: the moment of inertia is then within 2e-5 of the limit.
const FACETS: usize = 96;

/// Mass properties about the gear's axis and apex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GearMass {
    /// Mass [kg].
    pub mass: f64,
    /// Distance of the centre of mass from the apex [m].
    pub centre: f64,
    /// Moment of inertia about the gear's axis [kg·m²].
    pub axial: f64,
    /// Moment of inertia about any axis through the apex perpendicular to the gear's [kg·m²].
    pub transverse_at_apex: f64,
}

/// Polar angle and azimuth of one tooth's outline with the root land after it, `facets` per flank and land: a sector of
/// one pitch that begins and ends on the root circle.
fn tooth_outline(gear: &Gear, facets: usize) -> Vec<(f64, f64)> {
    let steps = || (0..facets).map(|k| k as f64 / facets as f64);
    let start = gear.root.max(gear.base);
    let (arc0, arc1) = (gear.action_arc(start), gear.action_arc(gear.tip));
    let half = |polar: f64| gear.half_angle(polar).max(0.0);
    let flank = |u: f64| gear.polar_at(arc0 + (arc1 - arc0) * u);
    let mut outline = Vec::with_capacity(4 * facets + 3);
    if gear.root < gear.base {
        outline.push((gear.root, -half(start)));
    }
    outline.extend(steps().map(|u| (flank(u), -half(flank(u)))));
    outline.extend(steps().map(|u| (gear.tip, half(gear.tip) * (2.0 * u - 1.0))));
    outline.extend(steps().map(|u| (flank(1.0 - u), half(flank(1.0 - u)))));
    // below the base circle the flank is a meridian
    let (foot, next) = (half(start), gear.tooth_pitch() - half(start));
    if gear.root < gear.base {
        outline.push((gear.base, foot));
    }
    outline.extend(steps().map(|u| (gear.root, foot + (next - foot) * u)));
    outline.push((gear.root, next));
    outline
}

/// Mass properties of `gear` between cone distances `inner` and `outer` with a bore of diameter `bore` [m].
pub fn gear_mass(gear: &Gear, inner: f64, outer: f64, bore: f64, density: f64) -> GearMass {
    properties(gear, inner, outer, bore, density, FACETS)
}

fn properties(gear: &Gear, inner: f64, outer: f64, bore: f64, density: f64, facets: usize) -> GearMass {
    // one tooth's sector is enough: the gear is z of them
    let sector = tooth_outline(gear, facets);
    // four rows of n points in millimetres: toe bore, toe outline, heel outline, heel bore
    let n = sector.len() as u32;
    let mm = 1e3;
    let outline = |r: f64| {
        sector.iter().map(move |&(p, a)| {
            let d = direction(p, a) * (r * mm);
            Vector::new(d.x, d.y, d.z)
        })
    };
    let hub = |r: f64| {
        let (z, radius) = (r * cos(gear.root) * mm, bore / 2.0 * mm);
        sector.iter().map(move |&(_, a)| Vector::new(radius * cos(a), radius * sin(a), z))
    };
    let vertices: Vec<Vector> = hub(inner).chain(outline(inner)).chain(outline(outer)).chain(hub(outer)).collect();
    let mut faces = Vec::with_capacity(8 * n as usize);
    for band in 0..4 {
        let (a, b) = (band * n, (band + 1) % 4 * n);
        for i in 0..n - 1 {
            faces.push([a + i, b + i, b + i + 1]);
            faces.push([a + i, b + i + 1, a + i + 1]);
        }
    }
    // the planes through the axis where the sector is cut from its neighbours
    let (first, last) = (0, n - 1);
    faces.extend([[first, first + 2 * n, first + n], [first, first + 3 * n, first + 2 * n]]);
    faces.extend([[last, last + n, last + 2 * n], [last, last + 2 * n, last + 3 * n]]);
    let p = MassProperties::from_trimesh(density * 1e-9, &vertices, &faces);
    let (z, com, inertia) =
        (f64::from(gear.teeth), p.local_com / mm, p.reconstruct_inertia_matrix() * (1.0 / (mm * mm)));
    // about the apex, by Steiner; the mean of x and y holds for the whole gear by symmetry
    let (x, y, axial) = (inertia.x_axis.x, inertia.y_axis.y, inertia.z_axis.z);
    let (xx, yy, zz) = (com.x * com.x, com.y * com.y, com.z * com.z);
    GearMass {
        mass: z * p.mass(),
        centre: com.z,
        axial: z * (axial + p.mass() * (xx + yy)),
        transverse_at_apex: z * 0.5 * (x + y + p.mass() * (xx + yy + 2.0 * zz)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{GearSpec, Pair};

    /// The solid without bore in closed form: cones from the apex to flat ends whose outline is r(θ) = R sinφ, so that
    /// the volume is z/3 · ½∮r²dθ and the moment of inertia z/20 · ∮r⁴dθ, heel less toe; across the axis, at the apex, it
    /// is half of that and ∫z²dm, in a thin tetrahedron of volume z r²dθ/6 a tenth of z² + 2 z z_p + 3 z_p² per mass.
    fn by_outline_integral(gear: &Gear, inner: f64, outer: f64, density: f64) -> [f64; 3] {
        let (sb, start) = (sin(gear.base), gear.root.max(gear.base));
        let ring = |f: &dyn Fn(f64) -> f64| {
            let steps = 40_000;
            let d = (gear.tip - start) / f64::from(steps);
            let flank: f64 = (0..steps)
                .map(|k| start + d * (f64::from(k) + 0.5))
                // −dγ/dφ = d inv/dφ = tanα_φ / sinφ
                .map(|p| f(sin(p)) * (sin(p).powi(2) - sb * sb).sqrt() / (sb * sin(p)) * d)
                .sum();
            let (tip, foot) = (gear.half_angle(gear.tip), gear.half_angle(start));
            2.0 * f64::from(gear.teeth)
                * (f(sin(gear.tip)) * tip + flank + f(sin(gear.root)) * (gear.tooth_pitch() / 2.0 - foot))
        };
        let (second, fourth) = (ring(&|r| r * r), ring(&|r| r.powi(4)));
        let z = cos(gear.root);
        let height = ring(&|r| {
            let z_p = (1.0 - r * r).sqrt();
            r * r * (z * z + 2.0 * z * z_p + 3.0 * z_p * z_p)
        });
        let fifths = outer.powi(5) - inner.powi(5);
        let axial = density * z / 20.0 * fourth * fifths;
        [
            density * z / 6.0 * second * (outer.powi(3) - inner.powi(3)),
            axial,
            0.5 * axial + density * z / 60.0 * height * fifths,
        ]
    }

    #[test]
    fn mass_and_inertia_equal_the_outline_integral() {
        let pair = Pair::new(&GearSpec::default());
        for gear in &pair.gears {
            let p = properties(gear, pair.inner_cone, pair.outer_cone, 0.0, 7800.0, 512);
            let [mass, axial, transverse] = by_outline_integral(gear, pair.inner_cone, pair.outer_cone, 7800.0);
            assert!((p.mass / mass - 1.0).abs() < 1e-6, "{} {mass}", p.mass);
            assert!((p.axial / axial - 1.0).abs() < 1e-6, "{} {axial}", p.axial);
            let across = p.transverse_at_apex;
            assert!((across / transverse - 1.0).abs() < 1e-6, "{across} {transverse}");
        }
    }

    #[test]
    fn facets_converge_with_second_order() {
        let pair = Pair::new(&GearSpec::default());
        let at = |facets| properties(&pair.gears[0], pair.inner_cone, pair.outer_cone, 0.016, 7800.0, facets).axial;
        let (coarse, fine, finest) = (at(8), at(16), at(512));
        let order = ((coarse - finest) / (fine - finest)).log2();
        assert!((1.6..2.4).contains(&order), "order {order}");
        assert!((at(FACETS) / finest - 1.0).abs() < 2e-5);
    }
}
