//! Reports of the interference check.

use answers::geometry::design::Design;
use answers::geometry::interference::InterferenceCheck;
use answers::geometry::json;
use anyhow::{Context, Result};
use serde_json::Value;

/// Text of a check without line breaks.
fn words(check: &InterferenceCheck) -> String {
    check.text().split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn the_studys_gears_turn_freely_and_thicker_ones_are_reported_with_position_and_depth() -> Result<()> {
    let design = Design::new::<&str>(&[])?;
    let reported =
        |check: &InterferenceCheck| -> Result<Value> { Ok(serde_json::from_str(&json::text(&design, Some(check))?)?) };
    let free = InterferenceCheck::new(&design, 0.0)?;
    assert!(!free.any() && free.text().contains("no interference"), "{}", free.text());
    assert_eq!(reported(&free)?["interference"]["found"], Value::Bool(false));
    // 0.1 mm of backlash minus 0.2 mm: half of 0.1 mm cos α at the heel
    let thick = InterferenceCheck::new(&design, 2e-4)?;
    let depth = 0.05 * 20f64.to_radians().cos();
    assert!(thick.any() && words(&thick).contains(&format!("depth at heel: {depth:.4} mm")), "{}", thick.text());
    let middle = &reported(&thick)?["interference"]["middle"];
    let worst = &middle["approaches"][0];
    assert_eq!((&worst["planet"], &worst["side_gear"]), (&Value::from("flank"), &Value::from("flank")));
    let gap = worst["at_heel"].as_f64().context("a number")?;
    assert!((gap + depth).abs() < middle["resolution"].as_f64().context("a number")?, "{worst}");
    Ok(())
}

#[test]
fn a_tip_beyond_its_limit_is_reported_by_gear_and_part() -> Result<()> {
    let check = InterferenceCheck::new(&Design::new(&["geometry.addendum_system=standard"])?, 0.0)?;
    let text = words(&check);
    assert!(
        text.contains("the side gear's tip enters the planet's flank below the base circle. depth at toe: 0.0"),
        "{text}"
    );
    let mitre = ["geometry.planet_teeth=14", "geometry.side_teeth=14", "geometry.planet_count=4"];
    let check = InterferenceCheck::new(&Design::new(&mitre)?, 0.0)?;
    assert!(check.any() && words(&check).contains("tip cones of neighbouring planets overlap"), "{}", check.text());
    Ok(())
}
