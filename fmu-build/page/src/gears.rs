//! Surfaces of the gears for given parameters.

use bevel_differential::geometry::involute::Gear;
use bevel_differential::geometry::solid::manifold::{GearSolid, Shape};
use bevel_differential::geometry::{Pair, checks};
use bevel_differential::model::Parameters;
use bevel_differential::variables::{Access, table};

/// Facets per flank and strips along a tooth: smooth at the size of a window.
const FACETS: usize = 10;
const STRIPS: usize = 2;

/// A parameter by its value reference. Whole numbers, Booleans and literals are numbers, too.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Assignment {
    reference: u32,
    value: f64,
}

/// A surface of triangles, and the cones that it lies between.
pub struct Surface {
    vertices: Vec<f32>,
    triangles: Vec<u32>,
    /// Pitch, tip, root and base angle from the gear's axis [rad]; outer, mean and inner cone distance [mm].
    cones: [f64; 7],
}

/// The surface of gear `gear` (0 planet, 1 side gear) with start values but for the `count` assignments; null where these gears
/// cannot be built. Tooth 0 is centred on azimuth 0, the apex is the origin, z leads to the heel; lengths in mm.
///
/// # Safety
/// `assignments` points to `count` of them.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn page_gear(assignments: *const Assignment, count: usize, gear: usize) -> *mut Surface {
    let mut parameters = Parameters::default();
    // SAFETY: the caller's promise
    for assignment in unsafe { std::slice::from_raw_parts(assignments, count) } {
        assign(&mut parameters, *assignment);
    }
    surface(&parameters, gear).map_or(std::ptr::null_mut(), |surface| Box::into_raw(Box::new(surface)))
}

fn assign(parameters: &mut Parameters, Assignment { reference, value }: Assignment) {
    match table().rows.get(reference as usize).map(|row| row.access) {
        Some(Access::Real(field)) => *field(parameters) = value,
        Some(Access::Integer(field)) => *field(parameters) = value as i32,
        Some(Access::Boolean(field)) => *field(parameters) = value != 0.0,
        Some(Access::Enumeration(_, _, set)) => set(parameters, value as i32),
        _ => {}
    }
}

fn surface(parameters: &Parameters, gear: usize) -> Option<Surface> {
    let spec = parameters.gears();
    let pair = Pair::new(&spec);
    if gear > 1 || !checks::errors(&spec, &pair).is_empty() {
        return None;
    }
    let shape = Shape { facets: FACETS, strips: STRIPS, crowning: 0.0 };
    let solid = GearSolid::shaped(&pair, &spec, gear, &shape);
    let vertices = solid.vertices.iter().flat_map(|vertex| vertex.iter().map(|x| (1e3 * x) as f32)).collect();
    let Gear { pitch, tip, root, base, .. } = pair.gears[gear];
    let [outer, mean, inner] = [pair.outer_cone, pair.mean_cone, pair.inner_cone].map(|distance| 1e3 * distance);
    Some(Surface { vertices, triangles: solid.triangles.concat(), cones: [pitch, tip, root, base, outer, mean, inner] })
}

/// Place of the numbers of a surface: kind 0, coordinates of vertices (f32); kind 1, triangles (u32); kind 2, cones (f64).
/// `count` takes how many.
///
/// # Safety
/// `surface` is from [`page_gear`] and not null; `count` is a place for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn page_gear_numbers(surface: *const Surface, kind: u32, count: *mut usize) -> *const u8 {
    // SAFETY: the caller's promise
    let (surface, count) = unsafe { (&*surface, &mut *count) };
    match kind {
        0 => {
            *count = surface.vertices.len();
            surface.vertices.as_ptr().cast()
        }
        1 => {
            *count = surface.triangles.len();
            surface.triangles.as_ptr().cast()
        }
        _ => {
            *count = surface.cones.len();
            surface.cones.as_ptr().cast()
        }
    }
}

/// Gives a surface back.
///
/// # Safety
/// `surface` is from [`page_gear`] and is not used any more.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn page_gear_free(surface: *mut Surface) {
    if !surface.is_null() {
        // SAFETY: the caller's promise
        drop(unsafe { Box::from_raw(surface) });
    }
}
