//! A host with its own solver for model exchange, the classical Runge–Kutta method.

use bevel_differential::fmi2::*;
use bevel_differential::model::STATES;

use crate::common::Host;

/// A host that integrates the states.
pub struct Solver {
    pub host: Host,
    pub time: f64,
    /// Number of events so far.
    pub events: usize,
}

impl Solver {
    /// Creates and starts a solver with the scene that `set` defines.
    pub fn new(set: impl Fn(&Host)) -> Self {
        let host = Host::for_exchange();
        set(&host);
        host.start_exchange();
        Self { host, time: 0.0, events: 0 }
    }

    pub fn states(&self) -> [f64; STATES] {
        let mut x = [f64::NAN; STATES];
        // SAFETY: a live component and memory for all states
        assert_eq!(unsafe { fmi2GetContinuousStates(self.host.c, x.as_mut_ptr(), STATES) }, Status::Ok);
        x
    }

    pub fn set(&self, time: f64, x: &[f64; STATES]) {
        // SAFETY: a live component and all states
        unsafe {
            assert_eq!(fmi2SetTime(self.host.c, time), Status::Ok);
            assert_eq!(fmi2SetContinuousStates(self.host.c, x.as_ptr(), STATES), Status::Ok);
        }
    }

    pub fn rates(&self, time: f64, x: &[f64; STATES]) -> [f64; STATES] {
        let mut rates = [f64::NAN; STATES];
        self.set(time, x);
        // SAFETY: a live component and memory for all derivatives
        let status = unsafe { fmi2GetDerivatives(self.host.c, rates.as_mut_ptr(), STATES) };
        assert_eq!(status, Status::Ok, "{:?}", self.host.log());
        rates
    }

    fn indicators(&self) -> [f64; EVENT_INDICATORS] {
        let mut z = [f64::NAN; EVENT_INDICATORS];
        // SAFETY: a live component and memory for all indicators
        assert_eq!(unsafe { fmi2GetEventIndicators(self.host.c, z.as_mut_ptr(), EVENT_INDICATORS) }, Status::Ok);
        z
    }

    /// Takes one step, followed by an event if an indicator changed its sign or the instance requests an event.
    pub fn step(&mut self, h: f64) {
        let before = self.indicators();
        let x = self.states();
        let moved = |by: f64, k: &[f64; STATES]| std::array::from_fn(|i| x[i] + by * k[i]);
        let k1 = self.rates(self.time, &x);
        let k2 = self.rates(self.time + 0.5 * h, &moved(0.5 * h, &k1));
        let k3 = self.rates(self.time + 0.5 * h, &moved(0.5 * h, &k2));
        let k4 = self.rates(self.time + h, &moved(h, &k3));
        let mean: [f64; STATES] = std::array::from_fn(|i| (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]) / 6.0);
        self.time += h;
        self.set(self.time, &moved(h, &mean));
        let (mut event, mut end) = (-1, -1);
        // SAFETY: a live component and memory for the results
        let status = unsafe { fmi2CompletedIntegratorStep(self.host.c, 1, &mut event, &mut end) };
        assert_eq!((status, end), (Status::Ok, 0), "{:?}", self.host.log());
        let crossed = before.iter().zip(self.indicators()).any(|(a, b)| a.signum() != b.signum());
        if crossed || event == 1 {
            self.event();
        }
    }

    pub fn event(&mut self) -> EventInfo {
        self.events += 1;
        // SAFETY: a live component
        assert_eq!(unsafe { fmi2EnterEventMode(self.host.c) }, Status::Ok);
        let info = self.host.update();
        assert_eq!(info.new_discrete_states_needed, 0);
        // SAFETY: as above
        assert_eq!(unsafe { fmi2EnterContinuousTimeMode(self.host.c) }, Status::Ok);
        info
    }

    pub fn steps(&mut self, h: f64, n: usize) {
        (0..n).for_each(|_| self.step(h));
    }
}

/// Sets the level of gear contact and the inertias of the wheels.
pub fn level(host: &Host, level: i32) {
    assert_eq!(host.set_integer("scene.gear_contact", level), Status::Ok);
    assert_eq!(host.set_many(&["inertia.left_end", "inertia.right_end"], &[0.3, 0.5]), Status::Ok);
}
