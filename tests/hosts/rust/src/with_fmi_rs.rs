//! fmi-rs, from the authors of FMPy.

use std::collections::HashMap;
use std::error::Error;

use fmi_rs::fmi2::builder::FMU2Builder;
use fmi_rs::fmi2::types::fmi2Status;
use fmi_rs::model_description::fmi2::VariableType;

use crate::scene::{Rows, Scene, Typed};

pub fn run(fmu: &str, scene: &Scene) -> Result<Rows, Box<dyn Error>> {
    let builder = FMU2Builder::new(&fmu)?;
    let variables = &builder.model_description.modelVariables;
    let known: HashMap<&str, _> = variables.iter().map(|variable| (variable.name.as_str(), variable)).collect();
    let find = |name: &str| known.get(name).copied().ok_or(format!("fmi-rs does not know {name}"));
    let is_real = |name: &str| known.get(name).is_some_and(|v| matches!(v.variableType, VariableType::Real { .. }));
    let instance = builder.instantiate_cs("differential")?;
    for (name, value) in scene.start(is_real)? {
        let reference = [find(name)?.valueReference];
        done(
            name,
            match value {
                Typed::Real(value) => instance.setReal(&reference, &[value]),
                Typed::Integer(value) => instance.setInteger(&reference, &[value]),
                Typed::Boolean(value) => instance.setBoolean(&reference, &[value.into()]),
            },
        )?;
    }
    done("fmi2SetupExperiment", instance.setupExperiment(None, 0.0, Some(scene.stop())))?;
    done("fmi2EnterInitializationMode", instance.enterInitializationMode())?;
    done("fmi2ExitInitializationMode", instance.exitInitializationMode())?;
    let references: Vec<u32> =
        scene.outputs().map(|name| Ok(find(name)?.valueReference)).collect::<Result<_, String>>()?;
    let read = || -> Result<Vec<f64>, String> {
        let mut values = vec![0.0; references.len()];
        done("fmi2GetReal", instance.getReal(&references, &mut values))?;
        Ok(values)
    };
    let mut rows = Rows::from([(0, read()?)]);
    for k in 0..scene.steps() {
        for (name, value) in scene.changes(k) {
            done(name, instance.setReal(&[find(name)?.valueReference], &[value]))?;
        }
        done("fmi2DoStep", instance.doStep(k as f64 * scene.step, scene.step, 1))?;
        rows.insert(k + 1, read()?);
    }
    done("fmi2Terminate", instance.terminate())?;
    Ok(rows)
}

fn done(what: &str, status: fmi2Status) -> Result<(), String> {
    match status {
        fmi2Status::Ok | fmi2Status::Warning => Ok(()),
        other => Err(format!("{what}: {other:?}")),
    }
}
