//! fmi-rs with the unit of FMI 3.0. By default it would use event mode; here steps are as in the other scripts.

use std::collections::HashMap;
use std::error::Error;

use fmi_rs::fmi3::FMU3;
use fmi_rs::fmi3::builder::FMU3Builder;
use fmi_rs::fmi3::types::fmi3Status;
use fmi_rs::model_description::fmi3::{Causality, ModelVariable, VariableType};

use crate::scene::{Rows, Scene, Typed};

pub fn run(fmu: &str, scene: &Scene) -> Result<Rows, Box<dyn Error>> {
    let mut builder = FMU3Builder::new(&fmu)?;
    (builder.eventModeUsed, builder.earlyReturnAllowed) = (false, false);
    let variables = &builder.model_description.modelVariables;
    let known: HashMap<&str, _> = variables.iter().map(|variable| (variable.name.as_str(), variable)).collect();
    let find = |name: &str| known.get(name).copied().ok_or(format!("fmi-rs does not know {name}"));
    let is_real = |name: &str| known.get(name).is_some_and(|v| matches!(v.variableType, VariableType::Float64 { .. }));
    let instance = builder.instantiate_cs("differential")?;
    let start = scene.start(is_real)?;
    let write = |structural: bool| -> Result<(), String> {
        for (name, value) in &start {
            let variable = find(name)?;
            if structural == matches!(variable.causality, Causality::StructuralParameter) {
                done(name, set(&instance, variable, *value)?)?;
            }
        }
        Ok(())
    };
    done("fmi3EnterConfigurationMode", instance.enterConfigurationMode())?;
    write(true)?;
    done("fmi3ExitConfigurationMode", instance.exitConfigurationMode())?;
    write(false)?;
    done("fmi3EnterInitializationMode", instance.enterInitializationMode(None, 0.0, Some(scene.stop())))?;
    done("fmi3ExitInitializationMode", instance.exitInitializationMode())?;
    let references: Vec<u32> =
        scene.outputs().map(|name| Ok(find(name)?.valueReference)).collect::<Result<_, String>>()?;
    let read = || -> Result<Vec<f64>, String> {
        let mut values = vec![0.0; references.len()];
        done("fmi3GetFloat64", instance.getFloat64(&references, &mut values))?;
        Ok(values)
    };
    let mut rows = Rows::from([(0, read()?)]);
    for k in 0..scene.steps() {
        for (name, value) in scene.changes(k) {
            done(name, instance.setFloat64(&[find(name)?.valueReference], &[value]))?;
        }
        let (mut event, mut terminate, mut early, mut last) = (false, false, false, 0.0);
        let begin = k as f64 * scene.step;
        let status = instance.doStep(begin, scene.step, true, &mut event, &mut terminate, &mut early, &mut last);
        done("fmi3DoStep", status)?;
        rows.insert(k + 1, read()?);
    }
    done("fmi3Terminate", instance.terminate())?;
    Ok(rows)
}

/// Sets a value by the function for the variable's type.
fn set(instance: &FMU3, variable: &ModelVariable, value: Typed) -> Result<fmi3Status, String> {
    let reference = [variable.valueReference];
    Ok(match (value, &variable.variableType) {
        (Typed::Real(value), _) => instance.setFloat64(&reference, &[value]),
        (Typed::Boolean(value), _) => instance.setBoolean(&reference, &[value]),
        (Typed::Integer(value), VariableType::Int32 { .. }) => instance.setInt32(&reference, &[value]),
        (Typed::Integer(value), VariableType::UInt64 { .. }) => {
            let count = u64::try_from(value).map_err(|_| format!("{} is not negative", variable.name))?;
            instance.setUInt64(&reference, &[count])
        }
        (Typed::Integer(value), _) => instance.setInt64(&reference, &[value.into()]),
    })
}

fn done(what: &str, status: fmi3Status) -> Result<(), String> {
    match status {
        fmi3Status::Ok | fmi3Status::Warning => Ok(()),
        other => Err(format!("{what}: {other:?}")),
    }
}
