//! Derived dimensions, flanks and the contact path of the 10/16 pair against independent golden numbers (tests/data).

use bevel_differential::geometry::{AddendumSystem, GearSpec, Pair, Tredgold};
use nalgebra::{Rotation3, Vector3};
use serde_json::Value;

const MM: f64 = 1e3;

fn spec(system: AddendumSystem) -> GearSpec {
    GearSpec { addendum_system: system, backlash: 0.0, ..GearSpec::default() }
}

/// The golden variants with the specifications that their labels describe.
fn variants() -> [(&'static str, GearSpec); 4] {
    // D, with the module m: working depth 1.6 m, h_ae2 = (0.430 + 0.370/u²) m, whole depth 1.788 m + 0.051 mm, u =
    // 16/10
    let m = 4.5e-3;
    let side = 0.430 + 0.370 / (1.6 * 1.6);
    let (planet, whole) = (1.6 - side, 1.788 + 0.051e-3 / m);
    let explicit = GearSpec {
        pressure_angle: 22.5f64.to_radians(),
        planet_addendum: planet,
        side_addendum: side,
        planet_dedendum: whole - planet,
        side_dedendum: whole - side,
        ..spec(AddendumSystem::Explicit)
    };
    [
        ("A_std_ha1_c0.25", spec(AddendumSystem::Standard)),
        ("B_gleason_1.0_0.540", GearSpec { backlash: 0.0, ..GearSpec::default() }),
        ("C_iso23509_cham", spec(AddendumSystem::Iso23509)),
        ("D_diff_22.5_0.8", explicit),
    ]
}

fn golden() -> Value {
    serde_json::from_str(include_str!("../data/golden_geometry.json")).expect("valid JSON")
}

/// Collects comparisons, so that one run shows all differences.
#[derive(Default)]
struct Comparison {
    wrong: Vec<String>,
    worst: (f64, String),
    count: usize,
}

impl Comparison {
    fn equal(&mut self, variant: &str, golden: &Value, key: &str, program: f64) {
        let expected = golden[key].as_f64().unwrap_or_else(|| panic!("{variant} has no number {key}"));
        let off = (program / expected - 1.0).abs();
        self.count += 1;
        if off > self.worst.0 {
            self.worst = (off, format!("{variant} {key}"));
        }
        if off.is_nan() || off > 1e-9 {
            self.wrong.push(format!("{variant} {key}: program {program}, golden {expected}, off {off:e}"));
        }
    }
}

#[test]
fn derived_dimensions_match_the_golden_ones() {
    let golden = golden();
    let mut c = Comparison::default();
    for (name, spec) in variants() {
        let (pair, g) = (Pair::new(&spec), &golden[name]);
        let planar = Tredgold::new(&pair);
        let m = pair.module * MM;
        let mut whole = |key: &str, value: f64| c.equal(name, g, key, value);
        whole("R_e", pair.outer_cone * MM);
        whole("R_m", pair.mean_cone * MM);
        whole("R_i", pair.inner_cone * MM);
        whole("psi_pitch_total_deg", pair.line_of_action().to_degrees());
        whole("psi_base_pitch_deg", pair.base_pitch.to_degrees());
        whole("eps_sphere_unlimited", pair.path.unclipped_ratio);
        whole("eps_sphere_limited", pair.path.contact_ratio);
        whole("max_tip_cone_gear1_deg", pair.limit_tip_angle(0).to_degrees());
        whole("max_tip_cone_gear2_deg", pair.limit_tip_angle(1).to_degrees());
        whole("max_addendum_gear1_mm(R_e tan)", pair.limit_addendum(0) * MM);
        whole("max_addendum_gear2_mm(R_e tan)", pair.limit_addendum(1) * MM);
        whole("eps_v_tredgold_unlimited", planar.contact_ratio);
        whole("psi_SAP_on_1_deg(tot-psi_a2)", (pair.line_of_action() - pair.tip_arc[1]).to_degrees());
        whole("psi_SAP_on_2_deg(tot-psi_a1)", (pair.line_of_action() - pair.tip_arc[0]).to_degrees());
        assert_eq!(Some(pair.path.clipped[0]), g["interference_mate2_tip_in_pinion1"].as_bool(), "{name}");
        assert_eq!(Some(pair.path.clipped[1]), g["interference_1_tip_in_2"].as_bool(), "{name}");
        for (i, key) in ["gear1_planet", "gear2_side"].into_iter().enumerate() {
            let (gear, g, name) = (&pair.gears[i], &g[key], format!("{name} {key}"));
            let mut of = |key: &str, value: f64| c.equal(&name, g, key, value);
            of("delta_deg", gear.pitch.to_degrees());
            of("delta_b_deg", gear.base.to_degrees());
            of("delta_a_deg_apex", gear.tip.to_degrees());
            of("delta_f_deg", gear.root.to_degrees());
            of("d_e", pair.outer_pitch_diameter(i) * MM);
            of("h_ae", gear.addendum * MM);
            of("h_fe", gear.dedendum * MM);
            of("z_v", planar.teeth[i]);
            of("d_v", planar.diameter[i] * MM);
            of("d_vb", planar.base_diameter[i] * MM);
            of("d_va", planar.tip_diameter[i] * MM);
            of("d_b_sphere", 2.0 * pair.outer_cone * pair.sin_base()[i] * MM);
            of("half_thickness_angle_deg", gear.half_pitch.to_degrees());
            of("s_e_circular", gear.half_pitch * pair.outer_pitch_diameter(i) * MM);
            of("tooth_angle_pitch_deg", gear.tooth_pitch().to_degrees());
            of("psi_pitch_deg", pair.pitch_arc[i].to_degrees());
            of("psi_tip_deg", pair.tip_arc[i].to_degrees());
            of("inv_pitch_rad", gear.inv(gear.pitch));
            of("inv_tip_rad", gear.inv(gear.tip));
            of("half_angle_base_deg", gear.half_angle(gear.base).to_degrees());
            of("half_angle_tip_deg", gear.half_angle(gear.tip).to_degrees());
            let land = 2.0 * gear.half_angle(gear.tip) * gear.tip.sin() * pair.outer_cone * MM;
            of("tip_land_mm_outer", land);
            of("tip_land_over_m", land / m);
        }
    }
    println!("{} values, worst relative deviation {:e} at {}", c.count, c.worst.0, c.worst.1);
    assert!(c.wrong.is_empty(), "{}", c.wrong.join("\n"));
}

#[test]
fn the_path_of_contact_has_the_golden_ends() {
    let golden = golden();
    for (name, spec) in variants() {
        let (pair, g) = (Pair::new(&spec), &golden[name]);
        let degrees = |v: &Value| v.as_f64().expect("a number").to_radians();
        let [planet, side] = ["gear1_planet", "gear2_side"].map(|k| &g[k]);
        // from the pitch point to each tip, but no further than the mate's tangent point
        let to_tip = |gear: &Value| degrees(&gear["psi_tip_deg"]) - degrees(&gear["psi_pitch_deg"]);
        let high = to_tip(planet).min(degrees(&side["psi_pitch_deg"]));
        let low = -to_tip(side).min(degrees(&planet["psi_pitch_deg"]));
        assert!((pair.path.high - high).abs() < 1e-12, "{name}");
        assert!((pair.path.low - low).abs() < 1e-12, "{name}");
    }
}

#[test]
fn backlash_thins_both_teeth_and_opens_the_golden_normal_gap() {
    let (tight, loose) = (Pair::new(&spec(AddendumSystem::Gleason)), Pair::new(&GearSpec::default()));
    // 0.1 mm at the outer pitch circle is 2.21349e-3 rad along the line of action
    assert!((loose.normal_backlash - 2.21349e-3).abs() < 5e-9, "{}", loose.normal_backlash);
    let play: f64 =
        (0..2).map(|i| 2.0 * (tight.gears[i].half_pitch - loose.gears[i].half_pitch) * loose.sin_base()[i]).sum();
    assert!((play / loose.normal_backlash - 1.0).abs() < 1e-12, "{play} {}", loose.normal_backlash);
}

/// Gleason's circular thickness factor. KHK's example of a straight bevel pair with 16/40 teeth, m = 4 mm, α = 20° and
/// K = 0.0259 has s₁ = 7.5119 mm and s₂ = 5.0545 mm.
#[test]
fn a_shift_of_thickness_makes_planets_thicker_and_side_gears_thinner() {
    let base =
        GearSpec { module: 4e-3, planet_teeth: 16, side_teeth: 40, backlash: 0.0, ..spec(AddendumSystem::Gleason) };
    let (plain, shifted) = (Pair::new(&base), Pair::new(&GearSpec { thickness_shift: 0.0259, ..base }));
    for (i, khk) in [7.5119, 5.0545].into_iter().enumerate() {
        let thickness = |pair: &Pair| pair.gears[i].half_pitch * pair.outer_pitch_diameter(i) * MM;
        assert!((thickness(&shifted) - khk).abs() < 1e-4, "{}", thickness(&shifted));
        let gained = if i == 0 { 1.0 } else { -1.0 } * 0.0259 * 4.0;
        assert!((thickness(&shifted) - thickness(&plain) - gained).abs() < 1e-12);
        // the land changes by the same angle, at the radius of the tip
        let land = |pair: &Pair| 2.0 * pair.gears[i].half_angle(pair.gears[i].tip) * pair.gears[i].tip.sin();
        let wanted = gained / (base.module * MM * f64::from(shifted.gears[i].teeth)) * 2.0 * shifted.gears[i].tip.sin();
        assert!((land(&shifted) - land(&plain) - wanted).abs() < 1e-14);
    }
    assert_eq!((shifted.normal_backlash, shifted.path), (plain.normal_backlash, plain.path));
}

fn rows(text: &str) -> impl Iterator<Item = Vec<&str>> {
    text.lines().filter(|l| !l.starts_with('#')).skip(1).map(|l| l.split(',').collect())
}

fn number(field: &str) -> f64 {
    field.parse().unwrap_or_else(|_| panic!("not a number: {field}"))
}

#[test]
fn flank_points_and_normals_match_the_golden_flank() {
    let pair = Pair::new(&spec(AddendumSystem::Standard));
    let (mut count, mut worst_point, mut worst_normal, mut worst_by_polar) = (0, 0.0f64, 0.0f64, 0.0f64);
    for row in rows(include_str!("../data/golden_flank.csv")) {
        let gear = &pair.gears[if row[0] == "planet" { 0 } else { 1 }];
        let f: Vec<f64> = row[2..].iter().map(|x| number(x)).collect();
        // ψ is printed to 12 digits. Half a unit is 5e-11° = 9e-13 rad, or 4e-11 mm on the sphere of 42 mm, as much as
        // the rounding of the printed coordinates. 1e-9 mm leaves some margin.
        let polar = gear.polar_at(f[1].to_radians());
        let expected = Vector3::new(f[5], f[6], f[7]);
        let point = gear.flank_point(polar, 1.0) * (pair.outer_cone * MM);
        worst_point = worst_point.max((point - expected).amax());
        let normal = Vector3::new(f[8], f[9], f[10]);
        let turned = (gear.flank_normal(polar, 1.0) - normal).amax();
        // The normal turns by dα_φ/dφ = cotα_φ cotφ, about 1/ψ near the base circle. On the base circle (ψ = 0), the
        // last bit of the polar angle turns it by √ε = 1.5e-8.
        let psi = f[1].to_radians();
        let allowed = if psi < 1e-6 { 3e-8 } else { 1e-11 + 4e-16 / psi };
        assert!(turned < allowed, "{row:?}: normal off {turned:e}, allowed {allowed:e}");
        if psi > 1e-6 {
            worst_normal = worst_normal.max(turned);
        }
        // with the printed polar angle, the point slides along its flank by δφ/cosα ≤ 1.2 δφ, within the same 1e-9 mm
        let by_polar = gear.flank_point(f[0].to_radians(), 1.0) * (pair.outer_cone * MM);
        worst_by_polar = worst_by_polar.max((by_polar - expected).amax());
        // the right flank is the mirror image
        let mirrored = |v: Vector3<f64>| Vector3::new(v.x, -v.y, v.z);
        assert_eq!(gear.flank_point(polar, -1.0), mirrored(gear.flank_point(polar, 1.0)));
        assert_eq!(gear.flank_normal(polar, -1.0), mirrored(gear.flank_normal(polar, 1.0)));
        // δφ = 9e-13 of the printed polar angle moves ψ by δφ sinφ/(cosδ_b sinψ), on the base circle by √(2 tanδ_b δφ)
        let arc_allowed = if psi < 1e-6 { 2e-6 } else { 3e-12 / psi };
        assert!((gear.action_arc(f[0].to_radians()) - psi).abs() < arc_allowed, "{row:?}");
        assert!((gear.half_angle(polar) - f[4].to_radians()).abs() < 1e-12, "{row:?}");
        count += 1;
    }
    println!("{count} points off by {worst_point:e} mm by ψ, {worst_by_polar:e} mm by φ; normals {worst_normal:e}");
    assert_eq!(count, 82);
    assert!(worst_point < 1e-9 && worst_by_polar < 1e-9);
}

#[test]
fn both_flanks_meet_on_the_golden_contact_path() {
    let pair = Pair::new(&spec(AddendumSystem::Gleason));
    let [planet, side] = &pair.gears;
    let radius = pair.outer_cone * MM;
    // frame of the file: planet axis z, side gear axis x; the side gear's own x axis points to the planet
    let side_frame = Rotation3::from_basis_unchecked(&[Vector3::z(), -Vector3::y(), Vector3::x()]);
    let (mut count, mut worst) = (0, 0.0f64);
    for row in rows(include_str!("../data/golden_contact_path_B.csv")) {
        let f: Vec<f64> = row.iter().map(|x| number(x)).collect();
        let s = f[0].to_radians();
        let polar = [planet.polar_at(pair.pitch_arc[0] + s), side.polar_at(pair.pitch_arc[1] - s)];
        // printed to 12 digits, of which half a unit is 9e-13 rad
        for i in 0..2 {
            assert!((polar[i] - f[1 + i].to_radians()).abs() < 2e-12, "{row:?}");
        }
        let (contact, tangent) = (Vector3::new(f[3], f[4], f[5]), Vector3::new(f[6], f[7], f[8]));
        let turn = [s / pair.sin_base()[0], s / pair.sin_base()[1]];
        assert!((turn[0] - f[9].to_radians()).abs() < 2e-12 && (turn[1] - f[10].to_radians()).abs() < 2e-12, "{row:?}");
        // each left flank, with its pitch point in the plane of the axes, then turned
        let about_z = |angle: f64| Rotation3::from_axis_angle(&Vector3::z_axis(), angle);
        let on_planet = about_z(f[9].to_radians() - planet.half_pitch);
        let on_side = side_frame * about_z(-f[10].to_radians() - side.half_pitch);
        let p = on_planet * planet.flank_point(polar[0], 1.0) * radius;
        let q = on_side * side.flank_point(polar[1], 1.0) * radius;
        worst = worst.max((p - contact).amax()).max((q - contact).amax());
        assert!((p - contact).amax() < 1e-9 && (q - contact).amax() < 1e-9, "{row:?}: {p} {q}");
        let normals = [on_planet * planet.flank_normal(polar[0], 1.0), on_side * side.flank_normal(polar[1], 1.0)];
        assert!((normals[0] - tangent).amax() < 1e-11, "{row:?}: {}", normals[0]);
        assert!((normals[1] + tangent).amax() < 1e-11, "{row:?}: {}", normals[1]);
        // lever arms in the file's header, in mm: constant along the path, with opposite signs in this frame
        let lever = [Vector3::z(), Vector3::x()].map(|axis| contact.cross(&tangent).dot(&axis));
        assert!((lever[0] - 21.1430839677).abs() < 1e-9 && (lever[1] + 33.8289343483).abs() < 1e-9, "{row:?}");
        assert!((pair.sin_base()[0] * radius - lever[0]).abs() < 1e-9, "{row:?}");
        assert!((pair.sin_base()[1] * radius + lever[1]).abs() < 1e-9, "{row:?}");
        count += 1;
    }
    println!("{count} contacts off by {worst:e} mm");
    assert!(count > 20);
}
