//! Binary STL in millimetres, for printing and for CAD programs that take meshes.
//!
//! The format: 80 bytes of header, the number of triangles, and for each the normal, three corners (all as 32-bit floats)
//! and two bytes. Triangles that rounding to 32 bits leaves without an edge are left out, so that the surface stays closed.

use anyhow::{Result, ensure};
use bevel_differential::geometry::solid::GearSolid;

use super::assembly::{Rotation, turned};

const HEADER: &[u8] = b"gears of a bevel differential, millimetres";
const HEADER_LENGTH: usize = 80;
const TRIANGLE_LENGTH: usize = 50;

/// Corners of a triangle [mm].
pub type Triangle = [[f32; 3]; 3];

/// All `solids`, each turned by its rotation, in one file.
pub fn binary<'a>(solids: impl IntoIterator<Item = (&'a GearSolid, Rotation)>) -> Vec<u8> {
    let mut bytes = HEADER.to_vec();
    bytes.resize(HEADER_LENGTH + 4, 0);
    let mut count = 0u32;
    for (solid, rotation) in solids {
        let vertices: Vec<[f64; 3]> =
            solid.vertices.iter().map(|v| turned(&rotation, [v.x * 1e3, v.y * 1e3, v.z * 1e3])).collect();
        for triangle in &solid.triangles {
            let corners = triangle.map(|i| vertices[i as usize]);
            let [a, b, c] = corners.map(|p| p.map(rounded));
            if a == b || b == c || c == a {
                continue;
            }
            count += 1;
            for value in [normal(&corners).map(rounded), a, b, c].as_flattened() {
                bytes.extend(value.to_le_bytes());
            }
            bytes.extend([0, 0]);
        }
    }
    bytes[HEADER_LENGTH..HEADER_LENGTH + 4].copy_from_slice(&count.to_le_bytes());
    bytes
}

/// `v` in 32 bits, with one zero only: equal vertices have equal bits.
fn rounded(v: f64) -> f32 {
    v as f32 + 0.0
}

/// Unit normal of a triangle, counter-clockwise from outside.
pub fn normal([a, b, c]: &[[f64; 3]; 3]) -> [f64; 3] {
    let (u, v) = ([0, 1, 2].map(|i| b[i] - a[i]), [0, 1, 2].map(|i| c[i] - a[i]));
    let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let length = n[0].hypot(n[1]).hypot(n[2]);
    if length > 0.0 { n.map(|x| x / length) } else { n }
}

/// Triangles of a binary STL file.
pub fn read(bytes: &[u8]) -> Result<Vec<Triangle>> {
    ensure!(bytes.len() >= HEADER_LENGTH + 4, "{} bytes are no STL file", bytes.len());
    let (head, body) = bytes.split_at(HEADER_LENGTH + 4);
    let count = u32::from_le_bytes([head[80], head[81], head[82], head[83]]) as usize;
    ensure!(body.len() == count * TRIANGLE_LENGTH, "{count} triangles do not fill {} bytes", body.len());
    Ok(body
        .chunks_exact(TRIANGLE_LENGTH)
        .map(|chunk| {
            let value = |k: usize| f32::from_le_bytes([chunk[k], chunk[k + 1], chunk[k + 2], chunk[k + 3]]);
            [12, 24, 36].map(|at| [at, at + 4, at + 8].map(value))
        })
        .collect())
}

/// How many edges of `triangles` have no partner that runs the other way, equal corners being one: 0 = watertight.
pub fn open_edges(triangles: &[Triangle]) -> usize {
    let bits = |p: [f32; 3]| p.map(f32::to_bits);
    let mut edges = std::collections::HashMap::new();
    for t in triangles {
        for k in 0..3 {
            *edges.entry((bits(t[k]), bits(t[(k + 1) % 3]))).or_insert(0i64) += 1;
        }
    }
    edges.iter().filter(|((a, b), count)| edges.get(&(*b, *a)) != Some(count)).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gears::geometry::assembly::{IDENTITY, Position, bodies};
    use bevel_differential::geometry::solid::Shape;
    use bevel_differential::geometry::{GearSpec, Pair};

    fn volume(triangles: &[Triangle]) -> f64 {
        let six = triangles.iter().map(|t| {
            let [a, b, c] = t.map(|p| p.map(f64::from));
            a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])
        });
        six.sum::<f64>() / 6.0
    }

    #[test]
    fn what_is_read_back_is_watertight_and_encloses_the_same_volume() {
        for (bore, root_fillet, teeth) in [(0.0, 0.4, (10, 16)), (0.012, 0.2, (9, 14)), (0.01, 0.0, (12, 40))] {
            let (planet_teeth, side_teeth) = teeth;
            let base = GearSpec { planet_teeth, side_teeth, root_fillet, ..GearSpec::default() };
            let spec = GearSpec { planet_bore: bore, side_bore: bore, ..base };
            let pair = Pair::new(&spec);
            for (gear, facets) in [(0, 1), (0, 48), (1, 7), (1, 32)] {
                let shape = Shape { facets, strips: 4, crowning: 1e-5 };
                let solid = GearSolid::shaped(&pair, &spec, gear, &shape);
                let bytes = binary([(&solid, IDENTITY)]);
                let triangles = read(&bytes).expect("an STL file");
                assert!(triangles.len() <= solid.triangles.len());
                assert!(triangles.len() as f64 > 0.99 * solid.triangles.len() as f64);
                assert_eq!(open_edges(&triangles), 0, "{teeth:?} {gear} {shape:?}");
                assert!((volume(&triangles) / (solid.mass(1.0).mass * 1e9) - 1.0).abs() < 1e-5);
            }
        }
    }

    #[test]
    fn the_assembly_is_watertight_and_normals_are_those_of_the_corners() {
        let spec = GearSpec::default();
        let pair = Pair::new(&spec);
        let solids = [0, 1].map(|i| GearSolid::new(&pair, &spec, i, 12, 1));
        let bodies = bodies(&spec, &Position::rolling(&spec, 0.2, 0.3)).expect("they assemble");
        let bytes = binary(bodies.iter().map(|b| (&solids[b.gear], b.rotation)));
        let triangles = read(&bytes).expect("an STL file");
        assert_eq!(open_edges(&triangles), 0);
        let whole: f64 = bodies.iter().map(|b| solids[b.gear].mass(1.0).mass * 1e9).sum();
        assert!((volume(&triangles) / whole - 1.0).abs() < 1e-5);
        for (chunk, triangle) in bytes[HEADER_LENGTH + 4..].chunks_exact(TRIANGLE_LENGTH).zip(&triangles) {
            let normal_read =
                [0, 4, 8].map(|k| f32::from_le_bytes([chunk[k], chunk[k + 1], chunk[k + 2], chunk[k + 3]]));
            let length: f32 = normal_read.iter().map(|v| v * v).sum();
            assert!((length - 1.0).abs() < 1e-5);
            let corners = triangle.map(|p| p.map(f64::from));
            let (a, b) = (corners[0], corners[1]);
            let along: f64 = (0..3).map(|i| f64::from(normal_read[i]) * (b[i] - a[i])).sum();
            assert!(along.abs() < 1e-4, "{along} {normal_read:?}");
        }
    }

    #[test]
    fn other_bytes_are_refused_and_holes_are_counted() {
        assert!(read(&[0; 10]).is_err());
        let spec = GearSpec::default();
        let solid = GearSolid::new(&Pair::new(&spec), &spec, 0, 2, 1);
        let mut bytes = binary([(&solid, IDENTITY)]);
        let triangles = read(&bytes).expect("an STL file");
        assert_eq!(open_edges(&triangles[1..]), 3);
        bytes.pop();
        assert!(read(&bytes).is_err());
    }
}
