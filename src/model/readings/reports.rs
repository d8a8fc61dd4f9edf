//! Warnings that a simulation reports once during a run: a law used outside its published range, a stress above the
//! strength, a p·v above its limit.

use crate::declaration::units::{RPM, W_PER_MM2};
use crate::friction::FrictionLaw;
use crate::model::dynamics::{FrictionEquations, with_equations};
use crate::model::effect_kinds::FrictionState;
use crate::model::effects::EFFECTS;
use crate::model::effects::strength::{Stressed, Tally};
use crate::model::effects::warm_up::{AMBIENT_CHANGE, SUMP_CHANGE};
use crate::model::run::{Simulation, effort, six_digits};
use crate::model::scene::{MAX_PLANETS, Method, RubbingKind};
use crate::numeric::PI;
use crate::problem::{Problem, distinct_texts};

/// Inputs that change outside temperatures, and the names of these temperatures in messages.
const OUTSIDE: [(&str, &str); 2] = [(AMBIENT_CHANGE, "ambient"), (SUMP_CHANGE, "the sump")];

/// Speed that no differential exceeds [rad/s].
const HIGHEST_SPEED: f64 = 3e3;
/// Largest energy residual of fixed steps that is not reported, as a fraction of the energy that passed. In 32 scenes
/// with dry friction, torques were wrong from 2.9e-4 on, and right up to 4e-5.
const MOST_RESIDUAL: f64 = 1e-4;
/// Names of the planets' spin speeds.
const SPINS: [&str; MAX_PLANETS] =
    ["planet[1].spin_speed", "planet[2].spin_speed", "planet[3].spin_speed", "planet[4].spin_speed"];

/// Warnings that have been reported in a run.
#[derive(Clone, Copy, Debug, Default)]
pub struct Reported {
    friction_law: bool,
    stress: [bool; Stressed::ALL.len()],
    pv: [bool; EFFECTS.len()],
    outside: [bool; OUTSIDE.len()],
    end: bool,
    rattle: bool,
    chatter: bool,
    coupling: bool,
    speed: bool,
    blocked: bool,
}

/// Returns the warning that `find` returns, unless one has been `reported`, and marks it as reported.
fn once(reported: &mut bool, find: impl FnOnce() -> Option<Problem>) -> Option<Problem> {
    let found = if *reported { None } else { find() };
    *reported |= found.is_some();
    found
}

impl Simulation {
    /// Returns the warnings about the time up to now that are not in `reported` yet, and adds them to it.
    pub fn unreported(&self, reported: &mut Reported) -> Vec<Problem> {
        let mut found = Vec::new();
        found.extend(once(&mut reported.friction_law, || self.outside_friction_law()));
        if self.model.strength.is_some() {
            for (what, reported) in Stressed::ALL.into_iter().zip(&mut reported.stress) {
                found.extend(once(reported, || {
                    let overload = self.memories.strength.get()?.tally.overloads.of(what)?;
                    Some(overload.warning(what, &self.model.ideal.plan))
                }));
            }
        }
        found.extend(once(&mut reported.speed, || self.too_fast()));
        found.extend(once(&mut reported.blocked, || self.blocked_by_clutches()));
        found.extend(once(&mut reported.coupling, || self.costly_coupling()));
        found.extend(once(&mut reported.rattle, || effort::rattle_warning(&self.model, &self.state)));
        found.extend(once(&mut reported.chatter, || effort::chatter_warning(&self.model, &self.inputs, &self.state)));
        for (effect, reported) in EFFECTS.iter().zip(&mut reported.pv) {
            found.extend(once(reported, || self.above_pv_limit(effect.name, effect.pv_limit?)));
        }
        let outside = OUTSIDE.into_iter().zip(self.temperatures_outside());
        for (((variable, what), beyond), reported) in outside.zip(&mut reported.outside) {
            found.extend(once(reported, || {
                let [commanded, kept] = beyond?;
                Some(problem!(
                    variable,
                    "would set {what} to {commanded:.2} K; {what} is kept at {kept:.2} K, the end of the range; \
                     reported once"
                ))
            }));
        }
        found
    }

    /// Warning about two clutches that both hold and thereby stop all rotation.
    fn blocked_by_clutches(&self) -> Option<Problem> {
        let [left, right] = self.model.ideal.plan.clutch_ratio;
        let (left, right) = (left?, right?);
        let mut clutches = self.state.friction[RubbingKind::Clutch.numbers()].iter();
        // Willis: the speeds of both sides add up to twice that of the carrier
        (left + right != 2.0 && clutches.all(FrictionState::holds)).then(|| {
            problem!(
                "left.clutch_command",
                "both clutches hold, and the ratios {left} and {right} of their shafts do not add up to 2, so that nothing \
                 can turn: open one of them; reported once"
            )
        })
    }

    /// Warning about the cut between host and unit if it is unstable, or if it changes much of the transmitted energy.
    fn costly_coupling(&self) -> Option<Problem> {
        let coupling = self.memories.coupling_advice.get().filter(|coupling| coupling.is_conspicuous())?;
        let cut = self.cut_with_mobility();
        let growth = coupling.growth(&cut)?;
        let port = ["carrier", "left side", "right side"][growth.port];
        let what = if growth.is_unstable {
            format!(
                "unstable cut at the {port}: a swing of the torque grows from period to period, because the host answers late"
            )
        } else {
            format!("the cut at the {port} changes much energy")
        };
        let (advice, _) = coupling.advice(self.model.parameters.specs.coupling_advice.wanted_ratio, &cut);
        let advised = if advice > 0.0 {
            format!("coupling.step_advice is {} s", six_digits(advice))
        } else {
            "there is no coupling.step_advice".into()
        };
        Some(problem!(
            "coupling.energy_ratio",
            "{what}; coupling.energy_ratio is {} with steps of {} s at t = {:.6} s; {advised}; shorter steps, input derivatives, \
             or moving the cut inside help (docs/coupling.md); reported once",
            six_digits(coupling.ratio()),
            six_digits(coupling.step()),
            self.state.time()
        ))
    }

    /// Warning about the fastest body if no differential reaches its speed.
    fn too_fast(&self) -> Option<Problem> {
        let layout = &self.model.layout;
        let turns = |i: &usize| !(layout.has_pins && [layout.seat(0), layout.seat(1)].contains(i));
        let is_fast = |i: usize| self.state.v[i].abs() > HIGHEST_SPEED;
        if !(0..layout.count()).filter(turns).any(is_fast) {
            return None;
        }
        let motion = self.motion();
        let spins = SPINS.into_iter().zip(motion.spin_speed);
        let wheels = [("left.wheel_speed", motion.wheel_speed[0]), ("right.wheel_speed", motion.wheel_speed[1])];
        let gears = [
            ("left.speed", motion.side_speed[0]),
            ("right.speed", motion.side_speed[1]),
            ("carrier.speed", motion.carrier_speed),
        ];
        // if speeds are equal, the last one is named
        let all = spins.chain(wheels).chain(gears);
        let (variable, speed) = all.max_by(|(_, a), (_, b)| a.abs().total_cmp(&b.abs()))?;
        if speed.abs() <= HIGHEST_SPEED {
            return None;
        }
        Some(problem!(
            variable,
            "{} rad/s = {} rpm at t = {:.6} s is beyond {HIGHEST_SPEED} rad/s = {:.0} rpm, faster than any \
             differential turns: look at drives, loads, and inertias of the wheels (inertia.left_end, \
             inertia.right_end); reported once",
            six_digits(speed),
            six_digits(RPM.show(speed)),
            self.state.time(),
            RPM.show(HIGHEST_SPEED)
        ))
    }

    /// Commanded and applied temperatures of ambient and sump [K], if the command is outside the range.
    fn temperatures_outside(&self) -> [Option<[f64; 2]>; 2] {
        let Some(network) = &self.model.thermal else { return [None; 2] };
        let changes = self.inputs.changes_outside();
        let (commanded, kept) = (network.around.commanded(changes), network.around.changed(changes));
        [(Some(commanded.ambient), Some(kept.ambient)), (commanded.sump, kept.sump)]
            .map(|(commanded, kept)| Some([commanded?, kept?]).filter(|[commanded, kept]| commanded != kept))
    }

    /// Warning about the surface of `effect` whose p·v exceeds its limit the most at this instant; `None` if no p·v
    /// exceeds it. `variable` is the name of the limit.
    #[inline(never)]
    fn above_pv_limit(&self, effect: &str, variable: &'static str) -> Option<Problem> {
        let (model, inputs, state) = (&self.model, &self.inputs, &self.state);
        let surfaces = &model.body_effects().surfaces;
        let limit = surfaces.iter().find(|surface| surface.effect == effect)?.sliding.pv_limit;
        if limit == 0.0 {
            return None;
        }
        let mut worst: Option<(&str, usize, f64)> = None;
        with_equations!(model, state, inputs, |equations| {
            equations.each_pv(&state.point::<N>(), |surface, pair, pv| {
                if surface.effect == effect && pv > worst.map_or(limit, |(.., most)| most) {
                    worst = Some((surface.place, pair, pv));
                }
            });
        });
        let (place, pair, pv) = worst?;
        let body = model.ideal.plan.rubbing_body(pair);
        let [pv, limit] = distinct_texts([pv, limit].map(|of| W_PER_MM2.show(of)), 3);
        let time = state.time();
        Some(problem!(
            variable,
            "p v of {body}{place} is {pv} W/mm2, above the limit of {limit} W/mm2, at t = {time:.6} s; reported once"
        ))
    }

    /// Returns the warnings that are known only at the end of a run and are not in `reported` yet, and adds them to it.
    pub fn unreported_at_end(&mut self, reported: &mut Reported) -> Vec<Problem> {
        if std::mem::replace(&mut reported.end, true) {
            return Vec::new();
        }
        let found = [self.counted_start(), self.short_rolling(), self.too_long_fixed_steps()];
        found.into_iter().flatten().collect()
    }

    /// Warning if safety and damage include a start that was not in equilibrium, with the times of the smallest safety
    /// factors.
    fn counted_start(&mut self) -> Option<Problem> {
        self.model.strength.as_ref()?;
        let tally = self.read_present(|simulation, _| simulation.memories.strength.get().map(|of| of.tally));
        let Tally { utilisation, counts_start, .. } = tally?;
        if !counts_start || utilisation.root.share == 0.0 {
            return None;
        }
        let [root, flank] = [utilisation.root, utilisation.flank].map(|of| (of.safety(), of.time));
        Some(problem!(
            "strength.rate_from",
            "safety and damage include the start, which was not in equilibrium: the smallest safety factor of the \
             roots was {:.3} at t = {:.6} s, that of the flanks {:.3} at t = {:.6} s; count them from after the \
             run-in",
            root.0,
            root.1,
            flank.0,
            flank.1
        ))
    }

    /// Warning if planets have rolled, but no tooth of them from the mesh with one side gear to the mesh with the
    /// other.
    fn short_rolling(&self) -> Option<Problem> {
        self.model.strength.as_ref()?;
        let rolled = self.motion().spin_angle.into_iter().fold(0.0, |most: f64, angle| most.max(angle.abs()));
        let pitch = self.model.pair.gears[0].tooth_pitch();
        (rolled > pitch && rolled < PI).then(|| {
            problem!(
                "safety.root_min",
                "the planets rolled {:.0} deg, less than half a revolution, so no tooth of a planet met both side gears: \
                 the alternating stress of a longer run, whose strength is about 0.7 times that of pulsating stress, is \
                 not in safety and damage; simulate half a revolution or more",
                rolled.to_degrees()
            )
        })
    }

    /// Warning if fixed steps lose or create much of the energy that passed the differential. This energy is estimated
    /// from the present power.
    fn too_long_fixed_steps(&mut self) -> Option<Problem> {
        let solver = &self.model.parameters.solver;
        if solver.method != Method::FixedStep {
            return None;
        }
        let (size, steps) = (solver.fixed_step, self.state.statistics.accepted);
        let residual = self.ledger().energy_residual;
        let stored = self.energy(&self.state).abs();
        let passed = self.forces().power_in.abs() * size * steps as f64;
        let scale = stored + passed + self.state.sums.heat.iter().sum::<f64>();
        (residual.abs() > MOST_RESIDUAL * scale).then(|| {
            problem!(
                "solver.fixed_step",
                "steps of {size} s are too long for this scene: solver.energy_residual is {} J, {} percent of the energy \
                 that passed; torques and speeds may be wrong: shorten the steps until it falls below {} percent, or \
                 choose solver.method = adaptive",
                six_digits(residual),
                six_digits(100.0 * residual.abs() / scale),
                100.0 * MOST_RESIDUAL
            )
        })
    }

    /// Warning about a quantity outside the range of the tooth friction law at this instant; `None` if all quantities
    /// are inside. Coulomb's law has no such range.
    fn outside_friction_law(&self) -> Option<Problem> {
        let (model, state) = (&self.model, &self.state);
        let p = &model.parameters;
        if !p.effects.tooth_friction || p.specs.tooth_friction.law == FrictionLaw::CoulombStribeck {
            return None;
        }
        let mut found = None;
        let (equations, point) = (self.teeth_equations()?, state.point());
        let friction = equations.flank_friction()?;
        for g in 0..model.ideal.plan.groups().len() {
            for s in 0..2 {
                equations.slices(&point, g, s, |slice| {
                    if found.is_none() {
                        found = slice.sliding.as_ref().and_then(|sliding| friction.outside(sliding));
                    }
                });
            }
        }
        found.map(|what| problem!("tooth_friction.law", "{what} at t = {:.6} s; reported once", state.time()))
    }
}
