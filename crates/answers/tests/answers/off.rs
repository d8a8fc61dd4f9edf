//! Outputs of effects that are off, and accepted start values.

use std::path::Path;

use answers::scene::run::SceneRun;
use answers::scene::{Scene, load, off};
use anyhow::Result;
use bevel_differential::model::EFFECTS;
use bevel_differential::model::effects::EffectEntry;
use bevel_differential::variables::unset::NOBODY_SET;

fn scene(outputs: &str, more: &str) -> Result<Scene> {
    let text = format!("description = \"d\"\nstop_time = 0.01\nstep = 1e-3\noutputs = [{outputs}]\n{more}");
    load::parse("test", Path::new("test.toml"), &text)
}

fn outputs(effect: &EffectEntry) -> Vec<&'static str> {
    effect.readings.iter().map(|one| one.name).chain(effect.heat.map(|heat| heat.output)).collect()
}

#[test]
fn every_output_of_a_switched_effect_is_off_without_the_switch_and_on_with_it() -> Result<()> {
    let plain = scene("", "")?;
    for effect in EFFECTS {
        let Some(switch) = effect.switch else { continue };
        let on = scene("", &format!("[set]\n{switch} = true\n"))?;
        for output in outputs(effect) {
            let why = off::reason(output, &plain).unwrap_or_default();
            assert!(
                why.contains(&format!("{switch} is off")) && why.contains(&format!("{switch} = true")),
                "{output}: {why}"
            );
            assert_eq!(off::reason(output, &on), None, "{output}");
        }
    }
    assert_eq!(off::reason("left.speed", &plain), None);
    Ok(())
}

#[test]
fn outputs_of_the_lock_are_on_if_it_is_commanded_at_any_time() -> Result<()> {
    let is_off = |more: &str| Ok::<_, anyhow::Error>(off::reason("heat.clutch", &scene("", more)?).is_some());
    for (more, wanted) in [
        ("", true),
        ("[set]\nlock.command = 0.0\n", true),
        ("[set]\nlock.command = 0.5\n", false),
        ("[[at]]\ntime = 0.005\nlock.command = 1.0\n", false),
        ("[[table]]\ninput = \"lock.command\"\ntime = [0.0, 0.01]\nvalue = [0.0, 1.0]\n", false),
    ] {
        assert_eq!(is_off(more)?, wanted, "{more}");
    }
    Ok(())
}

#[test]
fn warnings_name_all_outputs_of_an_effect_once() -> Result<()> {
    let found = off::warnings(&scene("\"safety.root_min\", \"left.speed\", \"damage.side\", \"heat.drag\"", "")?);
    assert_eq!(found.len(), 2, "{found:?}");
    assert!(found[0].starts_with("safety.root_min, damage.side: effects.strength is off"), "{found:?}");
    Ok(())
}

#[test]
fn accepted_start_values_leave_the_warning() -> Result<()> {
    let listed = |accepted: &str| {
        let own = scene("\"left.speed\"", &format!("{accepted}\n[set]\ngeometry.module = \"5 mm\"\n"))?;
        let warnings = SceneRun::start(&own, own.step)?.warnings();
        Ok::<_, anyhow::Error>(warnings.into_iter().find(|text| text.starts_with(NOBODY_SET)).unwrap_or_default())
    };
    let some = listed("accept_start_values = [\"geometry.side_teeth\"]")?;
    assert!(listed("")?.contains("side_teeth") && !some.contains("side_teeth") && some.contains("planet_teeth"));
    assert_eq!(listed("accept_start_values = true")?, "");
    Ok(())
}
