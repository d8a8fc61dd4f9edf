//! A value declared to have no effect in a scene changes no bit of any output. A value declared to have an effect
//! changes some output in some scene. The conditions are those of `variables::effective`.

mod alternatives;

use std::collections::HashMap;
use std::sync::LazyLock;

use crate::common::random::Draws;
use crate::mirror::random;
use crate::mirror::scene::{Scene, Step};
use alternatives::{Requirement, alternatives};
use bevel_differential::contact::ContactLaw;
use bevel_differential::declaration::Condition;
use bevel_differential::model::{
    GearCache, GearContact, Given, HostInputs, Inputs, Method, Parameters, Simulation, Start,
};
use bevel_differential::problem::Problem;
use bevel_differential::variables::effective::{Situation, has_effect};
use bevel_differential::variables::{Access, Range, Variable, number, table};
use fastrand::Rng;

/// Cache of gears from earlier starts, because most values do not affect the gears. The tests in `gear_cache` show that
/// cached gears equal newly built ones.
static GEARS: LazyLock<GearCache> = LazyLock::new(GearCache::default);

/// Parameters, inputs and steps of a scene.
#[derive(Clone)]
struct Run {
    parameters: Parameters,
    inputs: Inputs,
    steps: Vec<Step>,
}

/// True if `row` has no effect without `effects.tooth_fault`.
fn is_of_fault(row: &Variable) -> bool {
    matches!(row.switch, Some(Condition::Test(test)) if test.name() == "effects.tooth_fault")
}

impl Run {
    fn random(index: u64) -> Option<Self> {
        Self::drawn(random::scene, index)
    }

    fn drawn(draw: fn(u64) -> Option<Scene>, index: u64) -> Option<Self> {
        let mut scene = draw(index)?;
        random::warm(&mut Rng::with_seed(index ^ random::WARM), &mut scene.parameters);
        Some(Self { parameters: scene.parameters, inputs: scene.inputs, steps: scene.steps })
    }

    /// Simulation at its start.
    fn started(&self) -> Result<Simulation, Vec<Problem>> {
        let given = Given { cache: Some(&GEARS), ..Given::default() };
        Simulation::start_with(&self.parameters, &self.inputs, 0.0, &given)
    }

    /// True if the simulation can start.
    fn starts(&self) -> bool {
        self.started().is_ok()
    }

    /// Bits of all outputs at the start and after each step. A step that fails ends the run.
    fn bits(&self) -> Result<Vec<u64>, Vec<Problem>> {
        self.bits_while(|_| true)
    }

    /// True if the bits differ from the bits in `from`.
    fn differs(&self, from: &[u64]) -> Result<bool, Vec<Problem>> {
        Ok(self.bits_while(|bits| from.starts_with(bits))? != from)
    }

    /// Bits of all outputs at the start and after each step. The run ends early if a step fails, or if `go_on` returns
    /// false for all bits so far. Fails if the simulation cannot start.
    fn bits_while(&self, go_on: impl Fn(&[u64]) -> bool) -> Result<Vec<u64>, Vec<Problem>> {
        let mut simulation = self.started()?;
        let mut bits = Vec::new();
        let mut read = |simulation: &mut Simulation| {
            bits.extend(table().rows.iter().filter_map(|row| match row.access {
                Access::Output(of) => Some(of.read(simulation).to_bits()),
                _ => None,
            }));
            go_on(&bits)
        };
        let mut goes_on = read(&mut simulation);
        let mut time = 0.0;
        for step in &self.steps {
            if !goes_on {
                break;
            }
            time += step.size;
            if simulation.ramps_inputs() {
                simulation.ramp_inputs(&HostInputs::held(&step.inputs), time);
            } else {
                simulation.set_inputs(&step.inputs);
                simulation.set_input_derivatives(step.derivatives);
            }
            if simulation.advance(time).is_err() {
                break;
            }
            goes_on = read(&mut simulation);
        }
        Ok(bits)
    }

    fn set(&mut self, row: &Variable, value: f64, situation: Situation) {
        match row.access {
            Access::Real(at) => *at(&mut self.parameters) = value,
            Access::Integer(at) => *at(&mut self.parameters) = value as i32,
            Access::Boolean(at) => *at(&mut self.parameters) = value != 0.0,
            Access::Enumeration(_, _, set) => set(&mut self.parameters, value as i32),
            Access::Input(at) => {
                // inputs change at the same times as before, because any change restarts the integration
                let Range { max, .. } = row.range.unwrap_or(Range { min: 0.0, max: 1.0 });
                let by = value - *at(&mut self.inputs);
                let moved = |now: f64| if max > 1.0 { now + by } else { 1.0 - now };
                if situation.from_start {
                    *at(&mut self.inputs) = moved(*at(&mut self.inputs));
                }
                for step in &mut self.steps {
                    *at(&mut step.inputs) = moved(*at(&mut step.inputs));
                }
            }
            Access::Output(_) => {}
        }
    }

    fn get(&self, row: &Variable) -> Option<f64> {
        number(row, &mut self.parameters.clone(), &mut self.inputs.clone())
    }

    fn has_effect(&self, index: usize, situation: Situation) -> bool {
        has_effect(index, &self.parameters, situation)
    }
}

/// Draws a value of `row` within its range. It usually differs from `now`, but rounding and the range may give `now`
/// again.
fn other(row: &Variable, now: f64, d: &mut Rng) -> f64 {
    match row.access {
        Access::Boolean(_) => 1.0 - now,
        Access::Enumeration(kind, ..) => {
            let others: Vec<f64> = kind.choices.iter().map(|c| f64::from(c.value)).filter(|&v| v != now).collect();
            others[d.whole(0, others.len() as i32 - 1) as usize]
        }
        _ => {
            let Range { min, max } = row.range.unwrap_or(Range { min: 0.0, max: 1.0 });
            let near = now * d.between(0.7, 1.3);
            let far = min.max(0.0) + (max - min.max(0.0)) * 10f64.powf(d.between(-5.0, 0.0));
            let value = if now != 0.0 && d.share(0.7) { near } else { far }.clamp(min, max);
            if matches!(row.access, Access::Integer(_)) { value.round() } else { value }
        }
    }
}

/// Rows of parameters and inputs, with their indices.
fn settable() -> impl Iterator<Item = (usize, &'static Variable)> {
    let rows = table().rows.iter().enumerate();
    rows.filter(|(_, row)| !matches!(row.access, Access::Output(_)))
}

/// Changes `run` so that `requirement` is met.
fn satisfy(run: &mut Run, requirement: &Requirement, d: &mut Rng) {
    let (row, start) = (requirement.row, Situation::START);
    let value = match requirement.sign {
        '=' => requirement.values[d.whole(0, requirement.values.len() as i32 - 1) as usize],
        '!' => {
            let Access::Enumeration(kind, ..) = row.access else {
                if run.get(row) == Some(requirement.values[0]) {
                    let most = row.range.map_or(1.0, |range| range.max.min(10.0));
                    run.set(row, requirement.values[0] + 0.02 * (most - requirement.values[0]), start);
                }
                return;
            };
            let all: Vec<f64> = kind.choices.iter().map(|c| f64::from(c.value)).collect();
            let left: Vec<f64> = all.into_iter().filter(|v| !requirement.values.contains(v)).collect();
            if run.get(row).is_some_and(|now| left.contains(&now)) {
                return;
            }
            left[d.whole(0, left.len() as i32 - 1) as usize]
        }
        _ => {
            let least = requirement.values[0];
            if run.get(row).is_some_and(|now| now > least) {
                return;
            }
            let most = row.range.map_or(1.0, |range| range.max.min(10.0));
            if matches!(row.access, Access::Integer(_)) { 6.0 } else { least + 0.02 * (most - least) }
        }
    };
    run.set(row, value, start);
}

#[test]
fn a_value_without_effect_in_a_scene_changes_no_bit() {
    let count: u64 = std::env::var("EFFECTIVE_SCENES").ok().and_then(|n| n.parse().ok()).unwrap_or(60);
    let (mut compared, mut wrong) = (0, Vec::new());
    for index in 0..count {
        let Some(mut run) = Run::random(index) else { continue };
        let d = &mut Rng::with_seed(index ^ 0x5eed);
        // conditions that random scenes seldom meet
        for (_, row) in settable() {
            for requirement in alternatives(row).concat() {
                if !d.share(0.03) {
                    continue;
                }
                let before = run.clone();
                satisfy(&mut run, &requirement, d);
                if !run.starts() {
                    run = before;
                }
            }
        }
        start_quickly(&mut run.parameters);
        let Ok(expected) = run.bits() else { continue };
        let mut changed: Vec<(&'static Variable, f64, Situation)> = Vec::new();
        for (i, row) in settable() {
            for situation in [Situation::START, Situation::RUNNING] {
                if !run.has_effect(i, situation) && (situation.from_start || matches!(row.access, Access::Input(_))) {
                    changed.push((row, other(row, run.get(row).unwrap(), d), situation));
                }
            }
        }
        let with = |changed: &[(&'static Variable, f64, Situation)]| {
            let mut run = run.clone();
            changed.iter().for_each(|&(row, value, situation)| run.set(row, value, situation));
            run
        };
        // values that are refused need not be compared
        let found = loop {
            match with(&changed).bits() {
                Ok(bits) => break bits,
                Err(problems) => {
                    let before = changed.len();
                    changed.retain(|(row, ..)| problems.iter().all(|problem| problem.variable != row.name));
                    if changed.len() == before {
                        // the problem names an unchanged value that a changed one contradicts; keep only changes that
                        // a start accepts individually
                        changed.retain(|one| with(&[*one]).starts());
                    }
                    assert!(changed.len() < before, "scene {index}: {problems:?}");
                }
            }
        };
        compared += changed.len();
        if found != expected {
            for one in &changed {
                if let Ok(bits) = with(&[*one]).bits()
                    && bits != expected
                {
                    let names: Vec<&str> = table()
                        .rows
                        .iter()
                        .filter(|row| matches!(row.access, Access::Output(_)))
                        .map(|row| row.name)
                        .collect();
                    let place = bits.iter().zip(&expected).position(|(a, b)| a != b).unwrap_or(0);
                    wrong.push(format!(
                        "scene {index}: {} = {} changes {} at point {}",
                        one.0.name,
                        one.1,
                        names[place % names.len()],
                        place / names.len()
                    ));
                }
            }
            wrong.push(format!("scene {index} differs"));
        }
    }
    println!("{compared} values compared");
    assert!(compared > 50 * count as usize / 2, "{compared}");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Levels of gear contact, with their laws. Each uses different parameters.
const LEVELS: [(GearContact, ContactLaw); 6] = [
    (GearContact::Ideal, ContactLaw::Impact),
    (GearContact::Lumped, ContactLaw::Impact),
    (GearContact::Tooth, ContactLaw::Impact),
    (GearContact::Tooth, ContactLaw::Line),
    (GearContact::Tooth, ContactLaw::LineWeber),
    (GearContact::Solid, ContactLaw::Impact),
];
/// Maximum number of scenes in which an effect of a value is searched for.
const TRIES: u64 = 60;
/// One in `ROLLING` of these scenes has planets that roll over some teeth.
const ROLLING: u64 = 3;

/// Replaces a start in steady heat whose cycles would take minutes for all values of a scene.
fn start_quickly(p: &mut Parameters) {
    let is_slow = p.scene.gear_contact == GearContact::Solid || p.solver.method == Method::FixedStep;
    if is_slow && p.scene.start == Start::SteadyHeat {
        p.scene.start = Start::Equilibrium;
    }
}

/// Sets the level of gear contact of a scene, and switches off effects that this level does not support.
fn on_level(run: &mut Run, (contact, law): (GearContact, ContactLaw)) {
    let p = &mut run.parameters;
    (p.scene.gear_contact, p.contact.law) = (contact, law);
    p.effects.teeth.corner_contact |= contact == GearContact::Solid;
    start_quickly(p);
    for _ in 0..8 {
        let Err(problems) = run.started() else { return };
        for problem in problems {
            let row = table().rows.iter().find(|row| row.name == problem.variable).unwrap();
            match row.access {
                Access::Boolean(at) if row.name.starts_with("effects.") => *at(&mut run.parameters) = false,
                Access::Output(_) | Access::Boolean(_) | Access::Enumeration(..) => {}
                _ => run.set(
                    row,
                    number(row, &mut Parameters::default(), &mut Inputs::default()).unwrap().min(0.0),
                    Situation::START,
                ),
            }
        }
    }
}

/// Scene on a level of gear contact that meets some requirements.
struct Case {
    run: Run,
    /// Bits of the scene's outputs.
    expected: Vec<u64>,
    /// State of the random generator after the scene was drawn.
    draw: Rng,
}

/// Tooth fault of a case, for rows of `tooth_fault`: `Some(true)` if the tooth breaks at its onset, `Some(false)` if
/// only the trigger breaks it. Cases for other rows have `None`.
type Fault = Option<bool>;

/// True if some requirement switches on advice to the host, which needs more than a few steps.
fn needs_history(requirements: &[Requirement]) -> bool {
    requirements.iter().any(|requirement| requirement.row.name == "effects.coupling_advice")
}

/// Opens dog clutches for two steps, with so many teeth that some pass each other before the clutches close.
fn let_teeth_pass(run: &mut Run) {
    let dog = &mut run.parameters.specs.disconnect;
    (dog.teeth, dog.lash, dog.most_speed) = (400, 0.004, 1e3);
    run.inputs.dog_command = [0.0; 2];
    for (k, step) in run.steps.iter_mut().enumerate() {
        step.inputs.dog_command = [f64::from(u8::from(k >= 2)); 2];
    }
}

/// Cases by attempt, level, fault and requirements. They are cached, because many rows need the same cases.
#[derive(Default)]
struct Cases(HashMap<String, Option<Case>>);

impl Cases {
    fn case(
        &mut self,
        attempt: u64,
        level: (GearContact, ContactLaw),
        fault: Fault,
        requirements: &[Requirement],
    ) -> Option<&Case> {
        let named: Vec<_> = requirements
            .iter()
            .map(|requirement| (requirement.row.name, requirement.sign, &requirement.values))
            .collect();
        let key = format!("{attempt} {level:?} {fault:?} {named:?}");
        self.0.entry(key).or_insert_with(|| Self::new_case(attempt, level, fault, requirements)).as_ref()
    }

    fn new_case(
        attempt: u64,
        level: (GearContact, ContactLaw),
        fault: Fault,
        requirements: &[Requirement],
    ) -> Option<Case> {
        let draw = if attempt.is_multiple_of(ROLLING) { random::rolling } else { random::scene };
        let mut run = Run::drawn(draw, 1000 + attempt)?;
        let mut draw = Rng::with_seed(attempt ^ 0xfee1);
        if let Some(breaks) = fault {
            let fault = &mut run.parameters.specs.tooth_fault;
            (fault.at_onset, fault.onset, fault.tooth) = (breaks, 1e-6, 0);
        } else if requirements.iter().any(|of| of.row.name == "effects.disconnect") && attempt % 2 == 1 {
            let_teeth_pass(&mut run);
        } else if !needs_history(requirements) {
            run.steps.truncate(6);
        }
        on_level(&mut run, level);
        for requirement in requirements {
            satisfy(&mut run, requirement, &mut draw);
        }
        if (run.parameters.scene.gear_contact, run.parameters.contact.law) != level {
            return None;
        }
        let expected = run.bits().ok()?;
        Some(Case { run, expected, draw })
    }

    /// Returns true if another value of row `index` changes an output in some scene on `level` that meets
    /// `requirements`. Returns `None` if no such scene declares an effect of the row and accepts another value.
    fn has_witness(
        &mut self,
        index: usize,
        level: (GearContact, ContactLaw),
        requirements: &[Requirement],
    ) -> Option<bool> {
        let row = &table().rows[index];
        let of_level = [("scene.gear_contact", level.0 as i32), ("contact.law", level.1 as i32)];
        let contradicts = |requirement: &Requirement| {
            let value =
                of_level.iter().find(|(name, _)| *name == requirement.row.name).map(|&(_, value)| f64::from(value));
            value.is_some_and(|value| requirement.values.contains(&value) != (requirement.sign == '='))
        };
        if requirements.iter().any(contradicts) {
            return None;
        }
        let fault = is_of_fault(row).then_some(!matches!(row.access, Access::Input(_)));
        let mut exists = false;
        for attempt in 0..TRIES {
            if attempt == TRIES / 2 && !exists {
                return None;
            }
            let Some(Case { run, expected, draw }) = self.case(attempt, level, fault, requirements) else { continue };
            if !run.has_effect(index, Situation::START) {
                continue;
            }
            let d = &mut draw.clone();
            for _ in 0..3 {
                let mut changed = run.clone();
                changed.set(row, other(row, run.get(row).unwrap(), d), Situation::START);
                let Ok(differs) = changed.differs(expected) else { continue };
                exists |= changed.get(row) != run.get(row);
                if differs {
                    return Some(true);
                }
            }
        }
        exists.then_some(false)
    }
}

#[test]
fn a_value_with_effect_changes_some_output_on_every_level_of_teeth_and_in_every_alternative_of_its_condition() {
    let (mut wrong, mut cases) = (Vec::new(), Cases::default());
    let chosen = std::env::var("EFFECTIVE_ROWS").unwrap_or_default();
    for (i, row) in settable().filter(|(_, row)| row.name.contains(&chosen)) {
        // a value that always has an effect must change an output on one level only, or on none if every scene refuses
        // other values
        let always = row.switch.is_none() && row.when.is_none();
        let mut found = Vec::new();
        for level in LEVELS {
            if always && found.contains(&Some(true)) {
                break;
            }
            for (k, requirements) in alternatives(row).iter().enumerate() {
                found.push(cases.has_witness(i, level, requirements));
                if !always && found.ends_with(&[Some(false)]) {
                    wrong.push(format!("{} has no effect in alternative {k} on {level:?}", row.name));
                }
            }
        }
        let refused = always && found.iter().all(Option::is_none);
        if !refused && !found.contains(&Some(true)) {
            wrong.push(format!("{} has no effect in any scene", row.name));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
