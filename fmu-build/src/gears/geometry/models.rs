//! The gears as files for CAD, printing and viewing: curves of the flanks, each gear in its own frame, the assembly.

use anyhow::{Result, anyhow};
use bevel_differential::geometry::solid::GearSolid;

use super::assembly::{Body, IDENTITY, Position, bodies};
use super::design::Design;
use super::geometry_file::GeometryFile;
use super::shape::CadShape;
use super::{gltf, stl, xyz};

/// All of them, with `facets` per flank. Solids are not crowned.
pub fn files(design: &Design, facets: usize) -> Result<Vec<GeometryFile>> {
    let (pair, spec) = (&design.pair, &design.spec);
    let curves = xyz::curves(pair, spec, facets + 1);
    let mut made: Vec<GeometryFile> =
        curves.iter().map(|curve| GeometryFile::text(format!("{}.txt", curve.name), curve.text())).collect();
    let solids = [0, 1].map(|i| GearSolid::new(pair, spec, i, facets, 1));
    let assembled = bodies(spec, &Position::default()).map_err(|problem| anyhow!("{problem}"))?;
    let single = |gear: usize| vec![Body { name: xyz::NAMES[gear].into(), gear, rotation: IDENTITY }];
    for (name, bodies) in [(xyz::NAMES[0], single(0)), (xyz::NAMES[1], single(1)), ("differential", assembled)] {
        let placed = bodies.iter().map(|body| (&solids[body.gear], body.rotation));
        made.push(GeometryFile { name: format!("{name}.stl"), content: stl::binary(placed) });
        made.push(GeometryFile { name: format!("{name}.glb"), content: gltf::binary(&solids, &bodies) });
    }
    let shape = CadShape::new(pair, spec, design.parameters.material.density, facets)
        .map_err(|problem| anyhow!("{problem}"))?;
    made.push(GeometryFile::text("shape.json", serde_json::to_string(&shape)?));
    Ok(made)
}
