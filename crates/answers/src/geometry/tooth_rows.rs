//! Rows of each gear's teeth in the table of dimensions: heights, thickness, flank, limits, virtual gear.

use bevel_differential::numeric::{cos, sin, tan};

use super::design::Design;
use super::dimension::{DimensionGroup, DimensionValue, ISO_10300, ISO_23509, dimensions};
use super::gear_rows::{mean_ratio, toe_ratio};

/// Whole depth at the heel.
fn depth(d: &Design, i: usize) -> f64 {
    d.pair.gears[i].addendum + d.pair.gears[i].dedendum
}

/// Clearance at the heel between the mate's tip and this gear's root.
fn clearance(d: &Design, i: usize) -> f64 {
    d.pair.gears[i].dedendum - d.pair.gears[1 - i].addendum
}

/// Arc of a tooth on the outer pitch circle, reduced by half of the backlash.
fn thickness(d: &Design, i: usize) -> f64 {
    d.pair.gears[i].half_pitch * d.pair.outer_pitch_diameter(i)
}

/// Pitch diameter of the virtual gear in the middle of the face: d_mn with the spiral angle β = 0.
fn virtual_mean_diameter(d: &Design, i: usize) -> f64 {
    d.planar.diameter[i] * mean_ratio(d)
}

/// Half angle of a tooth on the virtual gear.
fn virtual_half_angle(d: &Design, i: usize) -> f64 {
    thickness(d, i) / d.planar.diameter[i]
}

/// Width of the tip land at the heel.
pub fn land(d: &Design, i: usize) -> f64 {
    let gear = &d.pair.gears[i];
    2.0 * gear.half_angle(gear.tip) * sin(gear.tip) * d.pair.outer_cone
}

/// Profile shift coefficient x_hm, positive for the gear with the longer addendum.
fn shift(d: &Design, i: usize) -> f64 {
    if i == 0 { d.pair.profile_shift } else { -d.pair.profile_shift }
}

/// Arc along the line of action from this gear's tangent point to the start of the active profile, where the mate's tip
/// touches. The arc is negative if the mate's tip passes below the base circle.
fn start_arc(d: &Design, i: usize) -> f64 {
    d.pair.line_of_action() - d.pair.tip_arc[1 - i]
}

/// sin²α.
fn sin2_alpha(d: &Design) -> f64 {
    let s = sin(d.pair.pressure_angle);
    s * s
}

/// All groups of rows, in the order of the table.
pub fn groups() -> Vec<DimensionGroup> {
    vec![heights(), thicknesses(), flank(), limits(), virtual_gear()]
}

fn heights() -> DimensionGroup {
    dimensions!("tooth heights", DimensionValue::Gear,
        "outer_addendum_h_ae" "h_ae" Length ISO_23509, "at the heel", |d, i| d.pair.gears[i].addendum;
        "outer_dedendum_h_fe" "h_fe" Length ISO_23509, "at the heel", |d, i| d.pair.gears[i].dedendum;
        "outer_whole_depth_h_e" "h_e" Length ISO_23509, "at the heel", depth;
        "mean_addendum_h_am" "h_am" Length ISO_23509, "in the middle of the face",
            |d, i| d.pair.gears[i].addendum * mean_ratio(d);
        "mean_dedendum_h_fm" "h_fm" Length ISO_23509, "in the middle of the face",
            |d, i| d.pair.gears[i].dedendum * mean_ratio(d);
        "mean_whole_depth_h_m" "h_m" Length ISO_23509, "in the middle of the face", |d, i| depth(d, i) * mean_ratio(d);
        "inner_addendum_h_ai" "h_ai" Length ISO_23509, "at the toe", |d, i| d.pair.gears[i].addendum * toe_ratio(d);
        "inner_dedendum_h_fi" "h_fi" Length ISO_23509, "at the toe", |d, i| d.pair.gears[i].dedendum * toe_ratio(d);
        "inner_whole_depth_h_i" "h_i" Length ISO_23509, "at the toe", |d, i| depth(d, i) * toe_ratio(d);
        "clearance_c" "c" Length ISO_23509, "from this root to the mate's tip, in the middle of the face",
            |d, i| clearance(d, i) * mean_ratio(d);
        "outer_clearance_c_e" "c_e" Length None, "from this root to the mate's tip, at the heel", clearance;
    )
}

fn thicknesses() -> DimensionGroup {
    dimensions!("tooth thickness, less half of the backlash", DimensionValue::Gear,
        "profile_shift_coefficient_x_hm" "x_hm" Ratio ISO_23509, "half the difference of addenda, in modules", shift;
        "thickness_modification_coefficient_x_sm" "x_sm" Ratio ISO_23509,
            "half the thickness shift (+ planet, - side gear), less j_et / 4 m_et for backlash",
            |d, i| 0.5 * d.spec.thickening(i) - d.spec.backlash / (4.0 * d.pair.module);
        "angular_pitch_tau" "τ" Angle None, "from tooth to tooth, 360 deg / z", |d, i| d.pair.gears[i].tooth_pitch();
        "half_tooth_angle_at_pitch_circle_gamma" "γ" Angle None, "about the axis, from the middle of the tooth",
            |d, i| d.pair.gears[i].half_pitch;
        "half_tooth_angle_at_base_circle" "" Angle None, "the same where the involute begins",
            |d, i| d.pair.gears[i].half_angle(d.pair.gears[i].base);
        "half_tooth_angle_at_tip" "" Angle None, "the same at the tip",
            |d, i| d.pair.gears[i].half_angle(d.pair.gears[i].tip);
        "outer_circular_tooth_thickness_s_e" "s_e" Length None, "arc of the outer pitch circle", thickness;
        "mean_normal_circular_tooth_thickness_s_mn" "s_mn" Length ISO_23509, "arc of the mean pitch circle",
            |d, i| thickness(d, i) * mean_ratio(d);
        "inner_circular_tooth_thickness_s_i" "s_i" Length None, "arc of the inner pitch circle",
            |d, i| thickness(d, i) * toe_ratio(d);
        "outer_chordal_tooth_thickness_s_ec" "s_ec" Length None, "straight across the outer pitch circle, d_e sin γ",
            |d, i| d.pair.outer_pitch_diameter(i) * sin(d.pair.gears[i].half_pitch);
        "outer_chordal_addendum_h_aec" "h_aec" Length None, "from that chord to the tip, h_ae + d_e (1 - cos γ) cos δ / 2",
            |d, i| {
                let gear = &d.pair.gears[i];
                gear.addendum + d.pair.outer_pitch_diameter(i) / 2.0 * (1.0 - cos(gear.half_pitch)) * cos(gear.pitch)
            };
        "mean_normal_chordal_tooth_thickness_s_mnc" "s_mnc" Length ISO_23509, "on the virtual gear, d_mn sin(s_mn / d_mn)",
            |d, i| virtual_mean_diameter(d, i) * sin(virtual_half_angle(d, i));
        "mean_chordal_addendum_h_amc" "h_amc" Length ISO_23509, "h_am + d_mn cos δ (1 - cos(s_mn / d_mn)) / 2",
            |d, i| {
                let gear = &d.pair.gears[i];
                let diameter = virtual_mean_diameter(d, i) * cos(gear.pitch);
                gear.addendum * mean_ratio(d) + diameter / 2.0 * (1.0 - cos(virtual_half_angle(d, i)))
            };
        "tip_land_at_heel" "" Length None, "arc of the tip circle at R_e", land;
        "tip_land_at_toe" "" Length None, "arc of the tip circle at R_i", |d, i| land(d, i) * toe_ratio(d);
        "tip_land_in_modules" "" Ratio None, "the same at heel and toe; the FMU warns below 0.2", |d, i| land(d, i) / d.pair.module;
        "angular_backlash" "" Angle None, "rotation of this gear with the mate held, 2 j_et / d_e",
            |d, i| 2.0 * d.spec.backlash / d.pair.outer_pitch_diameter(i);
    )
}

fn flank() -> DimensionGroup {
    dimensions!("flank; arcs ψ lie on the line of action and count from the tangent point on the base circle", DimensionValue::Gear,
        "arc_to_pitch_point_psi" "ψ" Angle None, "cos δ = cos δ_b cos ψ", |d, i| d.pair.pitch_arc[i];
        "arc_to_tip_psi_a" "ψ_a" Angle None, "cos δ_a = cos δ_b cos ψ_a", |d, i| d.pair.tip_arc[i];
        "arc_to_start_of_active_profile_psi_f" "ψ_f" Angle None, "where the mate's tip touches, negative if undercut", start_arc;
        "start_of_active_profile_phi_f" "φ_f" Angle None, "polar angle of the start of the active profile, at least δ_b",
            |d, i| d.pair.gears[i].polar_at(start_arc(d, i).max(0.0));
        "spherical_involute_at_pitch_point" "" Angle None, "inv δ = ψ / sin δ_b - arctan(tan ψ / sin δ_b)",
            |d, i| d.pair.gears[i].inv(d.pair.gears[i].pitch);
        "spherical_involute_at_tip" "" Angle None, "the same at the tip", |d, i| d.pair.gears[i].inv(d.pair.gears[i].tip);
        "outer_radius_of_curvature_at_pitch_point_rho_e" "ρ_e" Length None, "R_e tan ψ",
            |d, i| d.pair.outer_cone * tan(d.pair.pitch_arc[i]);
        "mean_lever_arm_of_normal_force" "" Length None, "R_m sin δ_b, the same all along the path",
            |d, i| d.pair.mean_cone * d.pair.sin_base()[i];
    )
}

fn limits() -> DimensionGroup {
    dimensions!("limits; a longer addendum passes the mate's base circle: it undercuts the mate or interferes", DimensionValue::Gear,
        "limit_face_angle" "" Angle None, "largest δ_a", |d, i| d.pair.limit_tip_angle(i);
        "limit_outer_addendum" "" Length None, "largest h_ae", |d, i| d.pair.limit_addendum(i);
        "limit_outer_addendum_in_modules" "" Ratio None, "largest h_ae / m_et",
            |d, i| d.pair.limit_addendum(i) / d.pair.module;
    )
}

fn virtual_gear() -> DimensionGroup {
    dimensions!("virtual cylindrical gear (Tredgold) at the heel", DimensionValue::Gear,
        "number_of_teeth_of_virtual_gear_z_v" "z_v" Ratio ISO_10300, "z / cos δ", |d, i| d.planar.teeth[i];
        "outer_virtual_pitch_diameter_d_ve" "d_ve" Length None, "d_e / cos δ", |d, i| d.planar.diameter[i];
        "outer_virtual_tip_diameter_d_vae" "d_vae" Length None, "d_ve + 2 h_ae", |d, i| d.planar.tip_diameter[i];
        "outer_virtual_base_diameter_d_vbe" "d_vbe" Length None, "d_ve cos α", |d, i| d.planar.base_diameter[i];
        "least_teeth_without_undercut" "" Ratio None, "for addendum 1 m without profile shift, 2 cos δ / sin²α",
            |d, i| 2.0 * cos(d.pair.gears[i].pitch) / sin2_alpha(d);
        "least_profile_shift_without_undercut" "" Ratio None, "for addendum 1 m, 1 - z_v sin²α / 2",
            |d, i| 1.0 - d.planar.teeth[i] * sin2_alpha(d) / 2.0;
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chord_and_height_agree_with_the_points_on_the_flanks() -> anyhow::Result<()> {
        let design = Design::new::<&str>(&[])?;
        let rows: Vec<_> = groups().into_iter().flat_map(|group| group.rows).collect();
        let of = |key: &str, i| rows.iter().find(|row| row.key == key).map_or(f64::NAN, |row| row.shown(&design, i));
        for i in 0..2 {
            let gear = &design.pair.gears[i];
            let [left, right] =
                [1.0, -1.0].map(|side| gear.flank_point(gear.pitch, side) * design.pair.outer_cone * 1e3);
            assert!((of("outer_chordal_tooth_thickness_s_ec", i) - (left - right).norm()).abs() < 1e-12);
            // the tip is at the distance h_ae from the pitch circle, along the back cone through the middle of the
            // tooth
            let (s, c) = (sin(gear.pitch), cos(gear.pitch));
            let (x, z) = (design.pair.outer_cone * s * 1e3, design.pair.outer_cone * c * 1e3);
            let tip = [x + of("outer_addendum_h_ae", i) * c, z - of("outer_addendum_h_ae", i) * s];
            let height = (tip[0] - left.x) * c - (tip[1] - left.z) * s;
            assert!((of("outer_chordal_addendum_h_aec", i) - height).abs() < 1e-12);
        }
        Ok(())
    }
}
