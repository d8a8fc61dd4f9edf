//! fmu-runner. It takes fmi2Warning for a failure, frees the instance without fmi2Terminate, and has no Booleans of its
//! own: they are set as integers.

use std::collections::HashMap;
use std::error::Error;

use fmu_runner::model_description::SignalType;
use fmu_runner::{Fmu, FmuInstance, fmi2Type};

use crate::scene::{Rows, Scene, Typed};

pub fn run(fmu: &str, scene: &Scene) -> Result<Rows, Box<dyn Error>> {
    let library = Fmu::unpack(fmu)?.load(fmi2Type::fmi2CoSimulation)?;
    let instance = FmuInstance::instantiate(&library, false)?;
    let known = library.variables();
    let find = |name: &str| known.get(name).ok_or(format!("fmu-runner does not know {name}"));
    let is_real = |name: &str| known.get(name).is_some_and(|v| matches!(v.signal_type, SignalType::Real(_)));
    for (name, value) in scene.start(is_real)? {
        let variable = find(name)?;
        match value {
            Typed::Real(value) => instance.set_reals(&HashMap::from([(variable, value)])),
            Typed::Integer(value) => instance.set_integers(&HashMap::from([(variable, value)])),
            Typed::Boolean(value) => instance.set_booleans(&HashMap::from([(variable, value.into())])),
        }
        .map_err(|error| format!("{name}: {error}"))?;
    }
    instance.setup_experiment(0.0, Some(scene.stop()), None)?;
    instance.enter_initialization_mode()?;
    instance.exit_initialization_mode()?;
    let outputs = scene.outputs().map(|name| find(name)).collect::<Result<Vec<_>, String>>()?;
    let read = || -> Result<Vec<f64>, Box<dyn Error>> {
        let values = instance.get_reals(&outputs)?;
        Ok(outputs.iter().map(|output| values[output]).collect())
    };
    let mut rows = Rows::from([(0, read()?)]);
    for k in 0..scene.steps() {
        for (name, value) in scene.changes(k) {
            instance.set_reals(&HashMap::from([(find(name)?, value)]))?;
        }
        instance.do_step(k as f64 * scene.step, scene.step, true)?;
        rows.insert(k + 1, read()?);
    }
    Ok(rows)
}
