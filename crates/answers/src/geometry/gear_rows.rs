//! Dimensions of each gear's blank: cones, diameters, positions along the axis.

use bevel_differential::numeric::{cos, sin};

use super::design::Design;
use super::dimension::{DimensionGroup, DimensionValue, ISO_23509, dimensions};

/// Mean cone distance divided by outer cone distance.
pub fn mean_ratio(d: &Design) -> f64 {
    d.pair.mean_cone / d.pair.outer_cone
}

/// Inner cone distance divided by outer cone distance.
pub fn toe_ratio(d: &Design) -> f64 {
    d.pair.inner_cone / d.pair.outer_cone
}

/// Diameter at the tip, on the back cone.
fn tip_diameter(d: &Design, i: usize) -> f64 {
    d.pair.outer_pitch_diameter(i) + 2.0 * d.pair.gears[i].addendum * cos(d.pair.gears[i].pitch)
}

/// Diameter at the root, on the back cone.
fn root_diameter(d: &Design, i: usize) -> f64 {
    d.pair.outer_pitch_diameter(i) - 2.0 * d.pair.gears[i].dedendum * cos(d.pair.gears[i].pitch)
}

/// Distance of the tip from the apex along the axis, on the back cone.
fn crown(d: &Design, i: usize) -> f64 {
    let gear = &d.pair.gears[i];
    d.pair.outer_cone * cos(gear.pitch) - gear.addendum * sin(gear.pitch)
}

/// Groups of rows, in the order of the table.
pub fn groups() -> Vec<DimensionGroup> {
    vec![
        dimensions!("cones", DimensionValue::Gear,
            "number_of_teeth_z" "z" Count ISO_23509, "given", |d, i| f64::from(d.pair.gears[i].teeth);
            "pitch_angle_delta" "δ" Angle ISO_23509, "half angle of the pitch cone", |d, i| d.pair.gears[i].pitch;
            "face_angle_delta_a" "δ_a" Angle ISO_23509, "half angle of the tip cone, whose apex is the pitch apex",
                |d, i| d.pair.gears[i].tip;
            "root_angle_delta_f" "δ_f" Angle ISO_23509, "half angle of the root cone, whose apex is the pitch apex",
                |d, i| d.pair.gears[i].root;
            "base_angle_delta_b" "δ_b" Angle None, "half angle of the base cone, from which the involute unrolls",
                |d, i| d.pair.gears[i].base;
            "addendum_angle_theta_a" "θ_a" Angle ISO_23509, "from pitch cone to tip cone",
                |d, i| d.pair.gears[i].tip - d.pair.gears[i].pitch;
            "dedendum_angle_theta_f" "θ_f" Angle ISO_23509, "from root cone to pitch cone",
                |d, i| d.pair.gears[i].pitch - d.pair.gears[i].root;
            "face_angle_for_uniform_clearance" "" Angle None, "δ_a if the tip cone were parallel to the mate's root cone",
                |d, i| d.pair.gears[i].pitch + d.pair.gears[1 - i].pitch - d.pair.gears[1 - i].root;
        ),
        dimensions!("diameters, on the back cone and the cones parallel to it", DimensionValue::Gear,
            "outer_pitch_diameter_d_e" "d_e" Length ISO_23509, "at the heel, m_et z",
                |d, i| d.pair.outer_pitch_diameter(i);
            "mean_pitch_diameter_d_m" "d_m" Length ISO_23509, "in the middle of the face",
                |d, i| d.pair.outer_pitch_diameter(i) * mean_ratio(d);
            "inner_pitch_diameter_d_i" "d_i" Length ISO_23509, "at the toe",
                |d, i| d.pair.outer_pitch_diameter(i) * toe_ratio(d);
            "outside_diameter_d_ae" "d_ae" Length ISO_23509, "also outer tip diameter, d_e + 2 h_ae cos δ", tip_diameter;
            "mean_tip_diameter_d_am" "d_am" Length None, "in the middle of the face", |d, i| tip_diameter(d, i) * mean_ratio(d);
            "inner_tip_diameter_d_ai" "d_ai" Length ISO_23509, "at the toe", |d, i| tip_diameter(d, i) * toe_ratio(d);
            "outer_root_diameter_d_fe" "d_fe" Length ISO_23509, "at the heel, d_e - 2 h_fe cos δ", root_diameter;
            "mean_root_diameter_d_fm" "d_fm" Length None, "in the middle of the face",
                |d, i| root_diameter(d, i) * mean_ratio(d);
            "inner_root_diameter_d_fi" "d_fi" Length ISO_23509, "at the toe", |d, i| root_diameter(d, i) * toe_ratio(d);
        ),
        dimensions!("diameters, on the spheres R_e and R_i at the ends of the solids' teeth", DimensionValue::Gear,
            "outer_tip_diameter_on_sphere" "" Length None, "at the heel, 2 R_e sin δ_a",
                |d, i| 2.0 * d.pair.outer_cone * sin(d.pair.gears[i].tip);
            "inner_tip_diameter_on_sphere" "" Length None, "at the toe, 2 R_i sin δ_a",
                |d, i| 2.0 * d.pair.inner_cone * sin(d.pair.gears[i].tip);
            "outer_root_diameter_on_sphere" "" Length None, "at the heel, 2 R_e sin δ_f",
                |d, i| 2.0 * d.pair.outer_cone * sin(d.pair.gears[i].root);
            "inner_root_diameter_on_sphere" "" Length None, "at the toe, 2 R_i sin δ_f",
                |d, i| 2.0 * d.pair.inner_cone * sin(d.pair.gears[i].root);
            "outer_base_diameter_on_sphere" "" Length None, "at the heel, 2 R_e sin δ_b",
                |d, i| 2.0 * d.pair.outer_cone * sin(d.pair.gears[i].base);
        ),
        dimensions!("along the axis", DimensionValue::Gear,
            "crossing_point_to_crown_t_xo" "t_xo" Length ISO_23509, "from the apex to the tip at the heel, on the back cone",
                crown;
            "crossing_point_to_front_crown_t_xi" "t_xi" Length ISO_23509, "from the apex to the tip at the toe",
                |d, i| crown(d, i) * toe_ratio(d);
            "apex_to_outer_pitch_circle" "" Length None, "from the apex to the plane of d_e",
                |d, i| d.pair.outer_cone * cos(d.pair.gears[i].pitch);
            "apex_to_crown_on_sphere" "" Length None, "from the apex to the tip at the heel of the solid, R_e cos δ_a",
                |d, i| d.pair.outer_cone * cos(d.pair.gears[i].tip);
            "apex_to_outer_root_on_sphere" "" Length None, "from the apex to the heel face of the solid, R_e cos δ_f",
                |d, i| d.pair.outer_cone * cos(d.pair.gears[i].root);
            "apex_to_inner_root_on_sphere" "" Length None, "from the apex to the toe face of the solid, R_i cos δ_f",
                |d, i| d.pair.inner_cone * cos(d.pair.gears[i].root);
        ),
    ]
}
