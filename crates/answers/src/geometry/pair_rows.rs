//! Dimensions that both gears share: modules, cone distances, path of contact, backlash.

use super::dimension::{DimensionGroup, DimensionValue, ISO_10300, ISO_23509, dimensions};
use super::gear_rows::{mean_ratio, toe_ratio};

/// Groups of rows, in the order of the table.
pub fn groups() -> Vec<DimensionGroup> {
    vec![
        dimensions!("pair", DimensionValue::Pair,
            "shaft_angle_Sigma" "Σ" Angle ISO_23509, "between both axes, given", |d| d.pair.shaft_angle;
            "gear_ratio_u" "u" Ratio ISO_23509, "teeth of the larger gear over those of the smaller", |d| {
                let (p, s) = (f64::from(d.spec.planet_teeth), f64::from(d.spec.side_teeth));
                p.max(s) / p.min(s)
            };
            "outer_transverse_module_m_et" "m_et" Length ISO_23509, "at the heel, given", |d| d.pair.module;
            "mean_normal_module_m_mn" "m_mn" Length ISO_23509, "in the middle of the face", |d| d.pair.module * mean_ratio(d);
            "inner_module_m_i" "m_i" Length None, "at the toe", |d| d.pair.module * toe_ratio(d);
            "normal_pressure_angle_alpha_n" "α_n" Angle ISO_23509, "at the pitch cone, given", |d| d.pair.pressure_angle;
            "face_width_b" "b" Length ISO_23509, "given", |d| d.spec.face_width;
            "outer_cone_distance_R_e" "R_e" Length ISO_23509, "from the apex to the heel, along the pitch cone",
                |d| d.pair.outer_cone;
            "mean_cone_distance_R_m" "R_m" Length ISO_23509, "to the middle of the face", |d| d.pair.mean_cone;
            "inner_cone_distance_R_i" "R_i" Length ISO_23509, "to the toe", |d| d.pair.inner_cone;
            "face_width_over_outer_cone_distance" "" Ratio None, "b / R_e, usually up to 1/3",
                |d| d.spec.face_width / d.pair.outer_cone;
            "outer_working_depth_h_we" "h_we" Length None, "both addenda at the heel",
                |d| d.pair.gears[0].addendum + d.pair.gears[1].addendum;
            "mean_working_depth_h_mw" "h_mw" Length ISO_23509, "both addenda in the middle of the face",
                |d| (d.pair.gears[0].addendum + d.pair.gears[1].addendum) * mean_ratio(d);
        ),
        dimensions!("backlash", DimensionValue::Pair,
            "outer_transverse_backlash_j_et" "j_et" Length ISO_23509, "along the outer pitch circle, given",
                |d| d.spec.backlash;
            "outer_normal_backlash_j_en" "j_en" Length ISO_23509, "between the flanks at the heel, j_et cos α",
                |d| d.pair.normal_backlash * d.pair.outer_cone;
            "mean_transverse_backlash_j_mt" "j_mt" Length ISO_23509, "along the mean pitch circle",
                |d| d.spec.backlash * mean_ratio(d);
            "mean_normal_backlash_j_mn" "j_mn" Length ISO_23509, "between the flanks in the middle of the face",
                |d| d.pair.normal_backlash * d.pair.mean_cone;
        ),
        dimensions!("path of contact, on the sphere", DimensionValue::Pair,
            "line_of_action_Lambda" "Λ" Angle None, "arc between the tangent points on both base circles",
                |d| d.pair.line_of_action();
            "base_pitch_p_b" "p_b" Angle None, "arc from pair to pair, 360 deg sin δ_b / z", |d| d.pair.base_pitch;
            "outer_base_pitch_p_be" "p_be" Length None, "the same at the heel", |d| d.pair.base_pitch * d.pair.outer_cone;
            "path_end_at_side_gear_tip" "" Angle None, "arc from the pitch point, not past the planet's base circle",
                |d| d.pair.path.low;
            "path_end_at_planet_tip" "" Angle None, "arc from the pitch point, not past the side gear's base circle",
                |d| d.pair.path.high;
            "outer_path_length" "" Length None, "length of the path at the heel",
                |d| (d.pair.path.high - d.pair.path.low) * d.pair.outer_cone;
            "transverse_contact_ratio_epsilon_alpha" "ε_α" Ratio None, "path over base pitch, exact",
                |d| d.pair.path.contact_ratio;
            "contact_ratio_without_limits" "" Ratio None, "the same if no tip passed a base circle",
                |d| d.pair.path.unclipped_ratio;
            "transverse_contact_ratio_of_virtual_gears_epsilon_valpha" "ε_vα" Ratio ISO_10300,
                "by Tredgold's virtual gears, if no tip passed a base circle", |d| d.planar.contact_ratio;
        ),
        dimensions!("assembly", DimensionValue::Pair,
            "number_of_planets" "" Count None, "given, equally spaced", |d| f64::from(d.spec.planet_count);
            "assembly_condition" "" Count None, "2 z of the side gear / number of planets, must be whole",
                |d| f64::from(2 * d.spec.side_teeth) / f64::from(d.spec.planet_count);
        ),
    ]
}

#[cfg(test)]
mod tests {
    use bevel_differential::numeric::cos;

    use super::super::design::Design;
    use super::*;

    #[test]
    fn normal_backlash_is_transverse_backlash_times_the_cosine() -> anyhow::Result<()> {
        let design = Design::new(&["geometry.backlash=0.2 mm"])?;
        let rows: Vec<_> = groups().into_iter().flat_map(|group| group.rows).collect();
        let of = |key: &str| rows.iter().find(|row| row.key == key).map_or(f64::NAN, |row| row.shown(&design, 0));
        let wanted = 0.2 * cos(design.pair.pressure_angle);
        assert!((of("outer_normal_backlash_j_en") - wanted).abs() < 1e-15);
        assert!((of("mean_normal_backlash_j_mn") - wanted * mean_ratio(&design)).abs() < 1e-15);
        Ok(())
    }
}
