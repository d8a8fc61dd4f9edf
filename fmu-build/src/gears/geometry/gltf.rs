//! glTF 2.0 binary (.glb): the assembled differential for viewers, each gear a mesh, placed as often as it occurs.
//!
//! Metres. The carrier's axis is x; glTF's "up", y, is where planet 1 stands at zero. Every triangle has its own corners,
//! with its normal, so that viewers shade it flat. (Khronos Group, glTF 2.0 specification, sections 3.6, 3.7 and 4.4.)

use bevel_differential::geometry::solid::GearSolid;
use serde_json::{Value, json};

use super::assembly::{Body, Rotation};
use super::stl::normal;
use super::xyz::NAMES;

const MAGIC: u32 = 0x4654_6C67;
const JSON_CHUNK: u32 = 0x4E4F_534A;
const BINARY_CHUNK: u32 = 0x004E_4942;
const FLOAT: u32 = 5126;
const ARRAY_BUFFER: u32 = 34962;

/// The gears among planet and side gear that are placed as `bodies`, so placed.
pub fn binary(solids: &[GearSolid; 2], bodies: &[Body]) -> Vec<u8> {
    let mut buffer = Vec::new();
    let (mut views, mut accessors, mut meshes) = (Vec::new(), Vec::new(), Vec::new());
    let mut mesh = [0; 2];
    for (gear, solid) in solids.iter().enumerate() {
        if !bodies.iter().any(|body| body.gear == gear) {
            continue;
        }
        mesh[gear] = meshes.len();
        let (positions, normals) = corners(solid);
        let mut attribute = |values: &[[f32; 3]], bounds: bool| {
            let offset = buffer.len();
            buffer.extend(values.as_flattened().iter().flat_map(|v| v.to_le_bytes()));
            views.push(
                json!({"buffer": 0, "byteOffset": offset, "byteLength": buffer.len() - offset, "target": ARRAY_BUFFER}),
            );
            let mut accessor =
                json!({"bufferView": views.len() - 1, "componentType": FLOAT, "count": values.len(), "type": "VEC3"});
            if bounds {
                accessor["min"] = json!(bound(values, f32::min));
                accessor["max"] = json!(bound(values, f32::max));
            }
            accessors.push(accessor);
            accessors.len() - 1
        };
        let (position, normal) = (attribute(&positions, true), attribute(&normals, false));
        let attributes = json!({"POSITION": position, "NORMAL": normal});
        meshes.push(json!({"name": NAMES[gear], "primitives": [{"attributes": attributes, "material": gear}]}));
    }
    let nodes: Vec<Value> = bodies
        .iter()
        .map(|body| json!({"name": body.name, "mesh": mesh[body.gear], "matrix": columns(&body.rotation)}))
        .collect();
    let document = json!({
        "asset": {"version": "2.0", "generator": "bevel-differential"},
        "scene": 0,
        "scenes": [{"name": "differential", "nodes": (0..nodes.len()).collect::<Vec<_>>()}],
        "nodes": nodes,
        "meshes": meshes,
        "materials": [metal("bronze", [0.80, 0.58, 0.32], 0.38), metal("steel", [0.56, 0.60, 0.65], 0.32)],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": buffer.len()}],
    });
    container(document.to_string().into_bytes(), buffer)
}

/// Header and the two chunks, each filled up to a multiple of four bytes.
fn container(mut document: Vec<u8>, mut buffer: Vec<u8>) -> Vec<u8> {
    document.resize(document.len().next_multiple_of(4), b' ');
    buffer.resize(buffer.len().next_multiple_of(4), 0);
    let length = 12 + 8 + document.len() + 8 + buffer.len();
    let mut bytes = Vec::with_capacity(length);
    for word in [MAGIC, 2, length as u32, document.len() as u32, JSON_CHUNK] {
        bytes.extend(word.to_le_bytes());
    }
    bytes.extend(document);
    for word in [buffer.len() as u32, BINARY_CHUNK] {
        bytes.extend(word.to_le_bytes());
    }
    bytes.extend(buffer);
    bytes
}

/// Corners of all triangles [m], and the normal at each.
fn corners(solid: &GearSolid) -> (Vec<[f32; 3]>, Vec<[f32; 3]>) {
    let single = |v: [f64; 3]| v.map(|x| x as f32);
    solid
        .triangles
        .iter()
        .flat_map(|triangle| {
            let corners: [[f64; 3]; 3] = triangle.map(|i| solid.vertices[i as usize].into());
            let normal = single(normal(&corners));
            corners.map(|corner| (single(corner), normal))
        })
        .unzip()
}

fn bound(values: &[[f32; 3]], pick: fn(f32, f32) -> f32) -> [f32; 3] {
    values.iter().copied().reduce(|a, b| [0, 1, 2].map(|i| pick(a[i], b[i]))).unwrap_or_default()
}

/// The 4×4 matrix of a rotation by columns.
fn columns(r: &Rotation) -> [f64; 16] {
    let mut m = [0.0; 16];
    for i in 0..3 {
        for j in 0..3 {
            m[4 * j + i] = r[i][j];
        }
    }
    m[15] = 1.0;
    m
}

fn metal(name: &str, [r, g, b]: [f64; 3], roughness: f64) -> Value {
    let surface = json!({"baseColorFactor": [r, g, b, 1.0], "metallicFactor": 0.85, "roughnessFactor": roughness});
    json!({"name": name, "pbrMetallicRoughness": surface})
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gears::geometry::assembly::{Position, bodies, turned};
    use bevel_differential::geometry::{GearSpec, Pair};

    fn word(bytes: &[u8], at: usize) -> usize {
        u32::from_le_bytes(bytes[at..at + 4].try_into().expect("four bytes")) as usize
    }

    #[test]
    fn the_container_holds_what_its_document_says() {
        let spec = GearSpec { planet_count: 4, ..GearSpec::default() };
        let pair = Pair::new(&spec);
        let solids = [0, 1].map(|i| GearSolid::new(&pair, &spec, i, 4, 1));
        let bodies = bodies(&spec, &Position::rolling(&spec, 0.1, 0.2)).expect("they assemble");
        let bytes = binary(&solids, &bodies);
        assert_eq!(&bytes[..4], b"glTF");
        assert_eq!((word(&bytes, 4), word(&bytes, 8), bytes.len() % 4), (2, bytes.len(), 0));
        let length = word(&bytes, 12);
        assert_eq!(&bytes[16..20], b"JSON");
        let document: Value = serde_json::from_slice(&bytes[20..20 + length]).expect("JSON");
        let binary = 20 + length;
        assert_eq!((word(&bytes, binary), &bytes[binary + 4..binary + 8]), (bytes.len() - binary - 8, &b"BIN\0"[..]));
        let nodes = document["nodes"].as_array().expect("nodes");
        assert_eq!(nodes.len(), 6);
        let views = document["bufferViews"].as_array().expect("views");
        let ends: usize = views.iter().map(|v| v["byteLength"].as_u64().expect("length") as usize).sum();
        assert_eq!(ends, word(&bytes, binary));
        for (gear, solid) in solids.iter().enumerate() {
            let attributes = &document["meshes"][gear]["primitives"][0]["attributes"];
            let accessor = |name: &str| &document["accessors"][attributes[name].as_u64().expect("an index") as usize];
            assert_eq!(accessor("POSITION")["count"], 3 * solid.triangles.len());
            assert_eq!(accessor("NORMAL")["count"], 3 * solid.triangles.len());
            let max = accessor("POSITION")["max"][2].as_f64().expect("a bound");
            let highest = solid.vertices.iter().map(|v| v.z).fold(0.0, f64::max);
            assert!((max - highest).abs() < 1e-8);
            assert!(document["materials"][gear]["name"].is_string());
        }
        // the matrix by columns turns as the rotation does
        for (node, body) in nodes.iter().zip(&bodies) {
            let m: Vec<f64> = node["matrix"].as_array().expect("a matrix").iter().filter_map(Value::as_f64).collect();
            let v = [0.1, 0.2, 0.3];
            let wanted = turned(&body.rotation, v);
            for i in 0..3 {
                let got = m[i] * v[0] + m[4 + i] * v[1] + m[8 + i] * v[2] + m[12 + i];
                assert!((got - wanted[i]).abs() < 1e-15, "{}", body.name);
            }
        }
    }
}
