//! Plausible scenes at random: gears, loads, drives and effects of differentials that could be built.

use std::fmt::Write as _;

use anyhow::Result;

use crate::tools::random::Random;
use answers::scene::{Scene, load};

/// Communication steps of a scene, and cycles of the teeth that it lasts for.
const STEPS: f64 = 240.0;
const CYCLES: f64 = 2.6;
/// Load of a wheel [N·m] per cube of the outer cone distance [m³], around which loads are drawn: that of the study.
const LOAD: f64 = 835.0 / (0.042_45 * 0.042_45 * 0.042_45);

/// Quantities that are wanted of a scene, three of them.
const WANTS: [&str; 12] = [
    "left.speed:mean",
    "left.speed:peak_to_peak",
    "right.speed:rms",
    "carrier.torque:mean",
    "left.shaft_torque:max",
    "planet[1].left_normal_force:mean",
    "planet[1].left_normal_force:max",
    "planet[1].left_transmission_error:mean",
    "planet[1].left_transmission_error:peak_to_peak",
    "planet[1].left_transmission_error:mesh_order_1",
    "efficiency:mean",
    "planet[1].spin_speed:max",
];

/// Scene number `index` of `seed` with the text of its file, and what is wanted of it; some cannot be built.
pub fn scene(seed: u64, index: u64) -> Result<(Scene, [&'static str; 3])> {
    let d = &mut Random::new(seed.wrapping_mul(0x9e37_79b9).wrapping_add(index));
    let mut set = String::new();
    let mut put = |name: &str, value: String| {
        let _ = writeln!(set, "{name} = {value}");
    };
    let planet = d.whole(9, 14);
    let side = planet + d.whole(3, 12);
    let fitting: Vec<i32> = (2..=4).filter(|n| 2 * side % n == 0).collect();
    let module = d.between(2.5e-3, 7e-3);
    let cone = 0.5 * module * f64::from(planet).hypot(f64::from(side));
    put("geometry.planet_teeth", planet.to_string());
    put("geometry.side_teeth", side.to_string());
    put("geometry.planet_count", d.pick(&fitting).to_string());
    put("geometry.module", format!("{module:e}"));
    put("geometry.pressure_angle", format!("\"{:.2} deg\"", d.between(20.0, 24.0)));
    put("geometry.face_width", format!("{:e}", cone * d.between(0.2, 0.33)));
    put("geometry.backlash", format!("{:e}", module * d.between(0.01, 0.03)));
    if d.share(0.5) {
        put("geometry.planet_bore", format!("{:e}", module * d.between(2.0, 3.5)));
        put("geometry.side_bore", format!("{:e}", module * d.between(4.0, 7.0)));
    }
    let load = LOAD * cone.powi(3) * d.between(0.1, 1.2);
    let spin = d.between(400.0, 1500.0);
    let carrier = d.between(500.0, 2500.0);
    let loads = |put: &mut dyn FnMut(&str, String), uneven: f64| {
        put("left.load_torque", format!("{:e}", load));
        put("right.load_torque", format!("{:e}", load * uneven));
    };
    put("carrier.speed_command", format!("\"{carrier:.1} deg/s\""));
    match d.whole(0, 2) {
        0 => {
            put("scene.planet_spin", "\"imposed\"".into());
            put("planet.spin_command", format!("\"{spin:.1} deg/s\""));
            loads(&mut put, 1.0);
        }
        1 => {
            let half = 0.5 * spin * f64::from(planet) / f64::from(side);
            put("scene.carrier_drive", "\"torque\"".into());
            put("carrier.torque_command", format!("{:e}", 2.0 * load));
            for (side, speed) in [("left", carrier + 2.0 * half), ("right", carrier - 2.0 * half)] {
                put(&format!("scene.{side}_drive"), "\"speed\"".into());
                put(&format!("{side}.speed_command"), format!("\"{speed:.1} deg/s\""));
            }
        }
        _ => {
            // wheels with inertia, one of which loses grip
            put("scene.planet_spin", "\"imposed\"".into());
            put("planet.spin_command", format!("\"{spin:.1} deg/s\""));
            let inertia = load * 1e-3;
            put("inertia.left_end", format!("{inertia:e}"));
            put("inertia.right_end", format!("{:e}", inertia * d.between(0.5, 2.0)));
            loads(&mut put, 1.0);
        }
    }
    if d.share(0.5) {
        put("effects.tooth_errors", "true".into());
        put("tooth_errors.accuracy_grade", d.whole(5, 8).to_string());
        put("tooth_errors.seed", d.whole(1, 1000).to_string());
        if d.share(0.5) {
            put("tooth_errors.planet_tip_relief", format!("{:e}", module * d.between(0.002, 0.006)));
            put("tooth_errors.side_tip_relief", format!("{:e}", module * d.between(0.002, 0.006)));
        }
        if d.share(0.3) {
            put("tooth_errors.crowning", format!("{:e}", module * d.between(0.001, 0.004)));
        }
    }
    for (effect, share) in
        [("tooth_friction", 0.5), ("thrust_friction", 0.4), ("bearing_drag", 0.4), ("limited_slip", 0.2)]
    {
        if d.share(share) {
            put(&format!("effects.{effect}"), "true".into());
        }
    }
    put("limited_slip.preload", format!("{:e}", 0.05 * load));
    if d.share(0.3) {
        put("effects.pin_compliance", "true".into());
    }
    let first = d.below(WANTS.len());
    // of different kinds
    let wants = [0, 5, 9].map(|k| WANTS[(first + k) % WANTS.len()]);
    let stop = CYCLES * 360.0 / (f64::from(planet) * spin);
    let outputs: Vec<String> =
        wants.iter().filter_map(|want| want.split(':').next()).map(|name| format!("\"{name}\"")).collect();
    let text = format!(
        "description = \"drawn at random\"\nstop_time = {stop:e}\nstep = {:e}\noutputs = [{}]\n\n[set]\n{set}",
        stop / STEPS,
        outputs.join(", ")
    );
    let name = format!("random_{seed}_{index}");
    let file = std::path::PathBuf::from(format!("{name}.toml"));
    Ok((load::parse(&name, &file, &text)?, wants))
}
