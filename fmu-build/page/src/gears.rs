//! Surfaces of gears with given parameters.

use bevel_differential::geometry::involute::Gear;
use bevel_differential::geometry::solid::manifold::{GearSolid, Shape};
use bevel_differential::geometry::{Pair, checks};
use bevel_differential::model::Parameters;
use bevel_differential::variables::{Access, table};

/// Number of facets per flank, enough for a smooth picture in a browser window.
const FACETS: usize = 10;
/// Number of strips along a tooth.
const STRIPS: usize = 2;

/// A parameter, identified by its value reference. Whole numbers, Booleans and literals are converted to numbers.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct Assignment {
    reference: u32,
    value: f64,
}

/// A triangulated surface with its cones.
pub struct Surface {
    vertices: Vec<f32>,
    triangles: Vec<u32>,
    /// Pitch, tip, root and base angle from the gear's axis [rad]; outer, mean and inner cone distance [mm].
    cones: [f64; 7],
}

/// Returns the surface of gear `gear` (0 planet, 1 side gear) with start values, except for the `count` assignments.
/// Returns null if these gears cannot be built. Tooth 0 is centred on azimuth 0, the apex is the origin, and z points
/// to the heel; lengths are in mm.
///
/// # Safety
/// `assignments` points to `count` assignments.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn page_gear(assignments: *const Assignment, count: usize, gear: usize) -> *mut Surface {
    let mut parameters = Parameters::default();
    // SAFETY: guaranteed by the caller
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

/// Returns a pointer to the numbers of a surface: kind 0, coordinates of vertices (f32); kind 1, triangles (u32); kind
/// 2, cones (f64). The number of values is written to `count`.
///
/// # Safety
/// `surface` is from [`page_gear`] and not null; `count` points to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn page_gear_numbers(surface: *const Surface, kind: u32, count: *mut usize) -> *const u8 {
    // SAFETY: guaranteed by the caller
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

/// Frees a surface.
///
/// # Safety
/// `surface` is from [`page_gear`] and not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn page_gear_free(surface: *mut Surface) {
    if !surface.is_null() {
        // SAFETY: guaranteed by the caller
        drop(unsafe { Box::from_raw(surface) });
    }
}
