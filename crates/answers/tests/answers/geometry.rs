//! Derived dimensions: golden numbers, equal rows in text and JSON, settings by name and unit, and refusals with all
//! reasons.

use answers::geometry::design::{Design, parameters};
use answers::geometry::dimensions::{DimensionGroup, of_gears, of_pair};
use answers::geometry::{json, text, tredgold};
use anyhow::Result;
use serde_json::Value;

fn document(design: &Design) -> Result<Value> {
    Ok(serde_json::from_str(&json::text(design, None)?)?)
}

/// Golden variants with the settings that their labels describe. Golden gears have no backlash.
fn variants() -> [(&'static str, Vec<String>); 7] {
    let explicit = |planet: [f64; 2], side: [f64; 2]| {
        vec![
            "geometry.addendum_system=explicit".to_owned(),
            format!("geometry.planet_addendum={}", planet[0]),
            format!("geometry.planet_dedendum={}", planet[1]),
            format!("geometry.side_addendum={}", side[0]),
            format!("geometry.side_dedendum={}", side[1]),
        ]
    };
    // D and E: working depth 1.6 m, h_ae2 = (0.430 + 0.370/u²) m, whole depth 1.788 m + 0.051 mm, u = 16/10
    let side = 0.430 + 0.370 / (1.6 * 1.6);
    let (planet, whole) = (1.6 - side, 1.788 + 0.051 / 4.5);
    let differential = || explicit([planet, whole - planet], [side, whole - side]);
    let steep = [differential(), vec!["geometry.pressure_angle=22.5 deg".to_owned()]].concat();
    [
        ("A_std_ha1_c0.25", vec!["geometry.addendum_system=standard".to_owned()]),
        ("A2_std_ha1_c0.2", explicit([1.0, 1.2], [1.0, 1.2])),
        ("B_gleason_1.0_0.540", vec!["geometry.addendum_system=gleason".to_owned()]),
        ("C_iso23509_cham", vec!["geometry.addendum_system=iso23509".to_owned()]),
        ("D_diff_22.5_0.8", steep),
        ("E_20deg_0.8_diffaddendum", differential()),
        ("F_x0.35_20", explicit([1.35, 0.9], [0.65, 1.6])),
    ]
}

/// Golden names of numbers of the pair, with their positions in the document.
const PAIR: [(&str, &str); 23] = [
    ("z1", "/planet/number_of_teeth_z/value"),
    ("z2", "/side_gear/number_of_teeth_z/value"),
    ("m_outer_mm", "/pair/outer_transverse_module_m_et/value"),
    ("alpha_deg", "/pair/normal_pressure_angle_alpha_n/value"),
    ("b_mm", "/pair/face_width_b/value"),
    ("Sigma_deg", "/pair/shaft_angle_Sigma/value"),
    ("R_e", "/pair/outer_cone_distance_R_e/value"),
    ("R_m", "/pair/mean_cone_distance_R_m/value"),
    ("R_i", "/pair/inner_cone_distance_R_i/value"),
    ("b_over_Re", "/pair/face_width_over_outer_cone_distance/value"),
    ("m_mean", "/pair/mean_normal_module_m_mn/value"),
    ("m_inner", "/pair/inner_module_m_i/value"),
    ("psi_pitch_total_deg", "/pair/line_of_action_Lambda/value"),
    ("psi_base_pitch_deg", "/pair/base_pitch_p_b/value"),
    ("eps_sphere_unlimited", "/pair/contact_ratio_without_limits/value"),
    ("eps_sphere_limited", "/pair/transverse_contact_ratio_epsilon_alpha/value"),
    ("eps_v_tredgold_unlimited", "/pair/transverse_contact_ratio_of_virtual_gears_epsilon_valpha/value"),
    ("eps_v_tredgold_limited", "/tredgold/contact_ratio/tredgold"),
    ("psi_SAP_on_1_deg(tot-psi_a2)", "/planet/arc_to_start_of_active_profile_psi_f/value"),
    ("psi_SAP_on_2_deg(tot-psi_a1)", "/side_gear/arc_to_start_of_active_profile_psi_f/value"),
    ("tredgold_SAP1_rho_mm", "/tredgold/planet_curvature_radius_at_start_of_active_profile/tredgold"),
    ("tredgold_SAP2_rho_mm", "/tredgold/side_gear_curvature_radius_at_start_of_active_profile/tredgold"),
    ("rho_tredgold1_pitch_mm", "/planet/outer_radius_of_curvature_at_pitch_point_rho_e/value"),
];

/// Golden names of numbers of the pair that belong to planet (1) or side gear (2); `#` stands for the index.
const EACH: [(&str, &str); 4] = [
    ("max_tip_cone_gear#_deg", "limit_face_angle"),
    ("max_addendum_gear#_mm(R_e tan)", "limit_outer_addendum"),
    ("max_ha#_over_m", "limit_outer_addendum_in_modules"),
    ("rho#_pitch_outer_mm", "outer_radius_of_curvature_at_pitch_point_rho_e"),
];

/// Golden names of numbers of a gear, with their keys.
const GEAR: [(&str, &str); 35] = [
    ("delta_deg", "pitch_angle_delta"),
    ("delta_b_deg", "base_angle_delta_b"),
    ("theta_a_deg", "addendum_angle_theta_a"),
    ("theta_f_deg", "dedendum_angle_theta_f"),
    ("delta_a_deg_apex", "face_angle_delta_a"),
    ("delta_a_deg_parallel_root", "face_angle_for_uniform_clearance"),
    ("delta_f_deg", "root_angle_delta_f"),
    ("d_e", "outer_pitch_diameter_d_e"),
    ("d_m", "mean_pitch_diameter_d_m"),
    ("d_i", "inner_pitch_diameter_d_i"),
    ("d_ae_backcone", "outside_diameter_d_ae"),
    ("d_fe_backcone", "outer_root_diameter_d_fe"),
    ("d_b_sphere", "outer_base_diameter_on_sphere"),
    ("d_a_sphere", "outer_tip_diameter_on_sphere"),
    ("d_f_sphere", "outer_root_diameter_on_sphere"),
    ("h_ae", "outer_addendum_h_ae"),
    ("h_fe", "outer_dedendum_h_fe"),
    ("h_e", "outer_whole_depth_h_e"),
    ("apex_to_pitchcircle_plane", "apex_to_outer_pitch_circle"),
    ("apex_to_crown", "crossing_point_to_crown_t_xo"),
    ("z_v", "number_of_teeth_of_virtual_gear_z_v"),
    ("d_v", "outer_virtual_pitch_diameter_d_ve"),
    ("d_vb", "outer_virtual_base_diameter_d_vbe"),
    ("d_va", "outer_virtual_tip_diameter_d_vae"),
    ("s_e_circular", "outer_circular_tooth_thickness_s_e"),
    ("half_thickness_angle_deg", "half_tooth_angle_at_pitch_circle_gamma"),
    ("tooth_angle_pitch_deg", "angular_pitch_tau"),
    ("psi_pitch_deg", "arc_to_pitch_point_psi"),
    ("psi_tip_deg", "arc_to_tip_psi_a"),
    ("half_angle_base_deg", "half_tooth_angle_at_base_circle"),
    ("half_angle_tip_deg", "half_tooth_angle_at_tip"),
    ("tip_land_mm_outer", "tip_land_at_heel"),
    ("tip_land_over_m", "tip_land_in_modules"),
    ("z_min_no_undercut_tredgold", "least_teeth_without_undercut"),
    ("x_min_tredgold(ha*=1)", "least_profile_shift_without_undercut"),
];

#[test]
fn the_table_agrees_with_every_golden_number() -> Result<()> {
    let golden: Value = serde_json::from_str(include_str!("../../../../tests/data/golden_geometry.json"))?;
    let gears = [("gear1_planet", "planet"), ("gear2_side", "side_gear")];
    let (mut wrong, mut worst, mut count) = (Vec::new(), (0.0f64, String::new()), 0);
    for (name, mut settings) in variants() {
        settings.push("effects.backlash=false".to_owned());
        let document = document(&Design::new(&settings)?)?;
        let mut compared = 0;
        let mut equal = |what: &str, golden: &Value, program: Option<f64>, factor: f64| {
            let (golden, program) = (golden.as_f64().expect(what), program.expect(what) * factor);
            let off = (program / golden - 1.0).abs();
            compared += 1;
            if off > worst.0 {
                worst = (off, format!("{name} {what}"));
            }
            if off.is_nan() || off > 1e-9 {
                wrong.push(format!("{name} {what}: program {program}, golden {golden}, off {off:e}"));
            }
        };
        let at = |place: &str| document.pointer(place).and_then(Value::as_f64);
        let of = |gear: &str, key: &str| at(&format!("/{gear}/{key}/value"));
        let golden = &golden[name];
        for (key, place) in PAIR {
            equal(key, &golden[key], at(place), 1.0);
        }
        equal(
            "rho_tredgold2_pitch_mm",
            &golden["rho_tredgold2_pitch_mm"],
            of("side_gear", "outer_radius_of_curvature_at_pitch_point_rho_e"),
            1.0,
        );
        for (i, (group, gear)) in gears.into_iter().enumerate() {
            for (key, ours) in EACH {
                let key = key.replace('#', &(i + 1).to_string());
                // the name of the planet's radius also contains its formula
                let key = if key == "rho1_pitch_outer_mm" { "rho1_pitch_outer_mm(R tan psi)" } else { &key };
                equal(key, &golden[key], of(gear, ours), 1.0);
            }
            let golden = &golden[group];
            for (key, ours) in GEAR {
                equal(&format!("{gear} {key}"), &golden[key], of(gear, ours), 1.0);
            }
            let radians = std::f64::consts::PI / 180.0;
            for (key, ours) in [("pitch", "pitch_point"), ("tip", "tip")] {
                let key = format!("inv_{key}_rad");
                equal(&key, &golden[&key], of(gear, &format!("spherical_involute_at_{ours}")), radians);
            }
            let below = of(gear, "root_angle_delta_f") < of(gear, "base_angle_delta_b");
            assert_eq!(golden["root_below_base"], below, "{name} {gear}");
        }
        for (key, gear) in [("interference_mate2_tip_in_pinion1", "planet"), ("interference_1_tip_in_2", "side_gear")] {
            let undercut = of(gear, "arc_to_start_of_active_profile_psi_f") < Some(0.0);
            assert_eq!(golden[key], undercut, "{name} {key}");
        }
        // every number of the golden file has been compared
        let numbers = |value: &Value| value.as_object().map_or(0, |all| all.values().filter(|v| v.is_number()).count());
        let all = numbers(golden) + gears.iter().map(|(group, _)| numbers(&golden[group])).sum::<usize>();
        assert_eq!(compared, all, "{name}");
        count += compared;
    }
    println!("{count} values, worst relative deviation {:e} at {}", worst.0, worst.1);
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    Ok(())
}

#[test]
fn text_and_json_have_the_same_rows_with_the_same_numbers() -> Result<()> {
    let design = Design::new(&["geometry.module=4 mm", "geometry.planet_teeth=11", "geometry.backlash=0.15mm"])?;
    let (text, document) = (text::text(&design), document(&design)?);
    let lines: Vec<&str> = text.lines().collect();
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let check = |groups: &[DimensionGroup], parts: &[&str]| {
        for row in groups.iter().flat_map(|group| &group.rows) {
            let values = parts.iter().map(|part| {
                let entry = &document[part][row.key];
                assert_eq!(entry["unit"], row.kind.unit());
                assert_eq!(entry["symbol"], row.symbol);
                assert_eq!(entry["standard"].as_str(), row.standard);
                row.kind.text(entry["value"].as_f64().expect(row.key))
            });
            let values = values.collect::<Vec<_>>().join(" ");
            let wanted = words(&format!("{} {values}", row.symbol));
            let ending = format!("{}: {}", row.term(), row.meaning);
            let found = lines.iter().any(|line| words(line).starts_with(&wanted) && line.ends_with(&ending));
            assert!(found, "no line \"{wanted} ... {ending}\"");
        }
        for part in parts {
            // the parser keeps only one of two equal keys
            let entries = document[part].as_object().map_or(0, |entries| entries.len());
            assert_eq!(entries, groups.iter().map(|group| group.rows.len()).sum::<usize>(), "{part}");
        }
    };
    check(&of_gears(), &["planet", "side_gear"]);
    check(&of_pair(), &["pair"]);
    let count = |part: &str| document[part].as_object().map_or(0, |entries| entries.len());
    assert_eq!(count("parameters"), parameters().count());
    assert_eq!(count("tredgold"), tredgold::comparisons(&design).len());
    println!("{} rows of gears, {} of the pair", count("planet"), count("pair"));
    Ok(())
}

#[test]
fn parameters_are_set_by_name_and_unit() -> Result<()> {
    let design =
        Design::new(&["geometry.module=4mm", "geometry.pressure_angle = 22.5 °", "geometry.face_width=0.012"])?;
    let document = document(&design)?;
    assert_eq!(document["parameters"]["geometry.module"]["value"], 0.004);
    assert_eq!(document["parameters"]["geometry.module"]["unit"], "m");
    assert_eq!(document["parameters"]["geometry.addendum_system"]["value"], "gleason");
    assert_eq!(document["planet"]["outer_pitch_diameter_d_e"]["value"], 40.0);
    assert_eq!(document["warnings"], serde_json::json!([]));
    let text = text::text(&design);
    assert!(
        text.contains("Set: geometry.module = 4 mm, geometry.pressure_angle = 22.5 deg, geometry.face_width = 12 mm.")
    );
    assert!(text.contains("\nno warnings\nno remarks\n"), "{text}");
    // a face that is usual for forged gears, and one that is wider
    let text = text::text(&Design::new(&["geometry.face_width=20mm"])?);
    assert!(text.contains("\nno warnings\nremarks\n1. geometry.face_width: 20.00 mm is 0.471 R_e"), "{text}");
    let text = text::text(&Design::new(&["geometry.face_width=25mm"])?);
    assert!(text.contains("\nwarnings\n1. geometry.face_width: 25.00 mm is 0.589 R_e"), "{text}");
    assert!(text.ends_with("\nno remarks\n"), "{text}");
    Ok(())
}

#[test]
fn every_number_is_finite_for_slender_and_for_flat_gears() -> Result<()> {
    for (planet, side) in [(8, 200), (200, 8), (200, 200), (7, 8)] {
        let teeth = [format!("geometry.planet_teeth={planet}"), format!("geometry.side_teeth={side}")];
        let usual = ["geometry.face_width=2mm", "geometry.addendum_system=standard", "geometry.backlash=0mm"];
        let design = Design::new(&[teeth.to_vec(), usual.map(str::to_owned).to_vec()].concat())?;
        // JSON writes other values as null
        assert!(!json::text(&design, None)?.contains("null"), "{planet}/{side}");
        let text = text::text(&design);
        assert!(!text.contains("NaN") && !text.contains("inf "), "{text}");
    }
    Ok(())
}

fn refused(settings: &[&str]) -> String {
    Design::new(settings).err().map_or_else(String::new, |error| format!("{error:#}"))
}

#[test]
fn errors_are_reported_together_with_name_range_and_unit() {
    let message =
        refused(&["geometry.modul=4mm", "geometry.backlash=60mm", "geometry.planet_teeth=ten", "geometry.module"]);
    assert!(message.contains("no variable \"geometry.modul\"; did you mean geometry.module?"), "{message}");
    assert!(
        message.contains("geometry.backlash = \"60mm\": 0.06 m is outside [0, 0.05] m ([0 mm, 50 mm])"),
        "{message}"
    );
    assert!(message.contains("geometry.planet_teeth = \"ten\": it must be a whole number"), "{message}");
    assert!(message.contains("\"geometry.module\" is not of the form name=value"), "{message}");
    assert!(refused(&["module=4mm"]).contains("did you mean geometry.module?"));
    assert!(refused(&["geometry.module=4"]).contains("did you mean 4 mm"));
    assert!(refused(&["geometry.module=4mm", "geometry.module=5mm"]).contains("geometry.module is set twice"));
    assert!(refused(&["geometry.planet_addendum=1.2"]).contains("changes nothing without"));
    assert!(refused(&["contact.law=line"]).contains("does not change the geometry"));
    let angle = refused(&["geometry.shaft_angle=80deg"]);
    assert!(angle.contains("is not 90 deg, the only possible value") && angle.contains("only at 90 deg"), "{angle}");
    assert!(!angle.contains('['), "{angle}");
}

/// ISO 23509: s_mn = m_mn (π/2 + 2 (x_sm + x_hm tan α)).
#[test]
fn thickness_modification_and_thickness_agree_with_a_shift() -> Result<()> {
    let design = Design::new(&["geometry.thickness_shift=0.06", "geometry.pressure_angle=22.5deg"])?;
    let document = document(&design)?;
    for gear in ["planet", "side_gear"] {
        let of = |name: &str| {
            let value = document.pointer(&format!("/{gear}/{name}/value")).and_then(Value::as_f64);
            value.unwrap_or_else(|| panic!("{gear} {name}"))
        };
        let shift = of("thickness_modification_coefficient_x_sm")
            + of("profile_shift_coefficient_x_hm") * 22.5f64.to_radians().tan();
        let module =
            document.pointer("/pair/mean_normal_module_m_mn/value").and_then(Value::as_f64).unwrap_or(f64::NAN);
        let thickness = module * (std::f64::consts::FRAC_PI_2 + 2.0 * shift);
        let found = of("mean_normal_circular_tooth_thickness_s_mn");
        assert!((found / thickness - 1.0).abs() < 1e-9, "{gear}: {found} {thickness}");
    }
    Ok(())
}
