//! Events of a simulation: a tooth breaks, friction starts or stops holding a body, or a dog clutch switches.

use serde::{Deserialize, Serialize};

use crate::model::effect_kinds::FrictionState;
use crate::model::scene::{Dogs, PAIRS, RubbingKind};
use crate::numeric::finite;

/// Kind of an event.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[repr(u8)]
pub enum Happening {
    /// Nothing has happened yet.
    #[default]
    Nothing = 0,
    /// A brake starts to hold a wheel: the wheel stops, or the brake is applied at standstill.
    WheelStops = 1,
    /// A brake no longer holds a wheel: the wheel breaks loose, or the brake is released at standstill.
    WheelBreaksLoose = 2,
    /// A clutch, washer or lock starts to stick, or the lock is closed at standstill.
    ClutchSticks = 3,
    /// A clutch, washer or lock starts to slip, or the lock is opened while it sticks.
    ClutchSlips = 4,
    /// The tooth of the tooth fault breaks.
    ToothBreaks = 5,
    /// A dog clutch engages.
    DogEngages = 6,
    /// A dog clutch disengages.
    DogDisengages = 7,
}

/// An event.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Event {
    /// Kind of the event.
    pub what: Happening,
    /// Number of the pair that friction starts or stops holding, or side of a dog clutch. It is 0 for teeth.
    pub body: u8,
    /// Time [s].
    pub time: f64,
    /// Number of the event since the start, from 1; 0 before the first event.
    pub count: u32,
}

/// Number of events that a simulation stores.
pub const REMEMBERED: usize = 8;

/// The last events, newest first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Events {
    recent: [Event; REMEMBERED],
}

finite! {
    Event { time; what, body, count }
    Events { recent }
}

/// Options of a call that advances the motion.
#[derive(Clone, Copy, Debug, Default)]
pub struct AdvanceOptions {
    /// True if the motion stops at the first event.
    pub pauses: bool,
    /// True if the call ends before the next communication point.
    pub is_part: bool,
}

impl Event {
    /// Number of the side (1 left, 2 right) or of the planet group to which the event belongs; 0 for teeth.
    pub fn number(&self) -> i32 {
        match self.what {
            Happening::Nothing | Happening::ToothBreaks => 0,
            Happening::DogEngages | Happening::DogDisengages => i32::from(self.body) + 1,
            _ => RubbingKind::of(usize::from(self.body)).1 as i32 + 1,
        }
    }
}

impl Events {
    /// Last event.
    pub fn last(&self) -> &Event {
        &self.recent[0]
    }

    /// Number of events since the start.
    pub fn count(&self) -> u32 {
        self.last().count
    }

    /// First remembered event after event number `count`, or `None` if that was the last one.
    pub fn after(&self, count: u32) -> Option<&Event> {
        let new = self.count().wrapping_sub(count);
        let is_new = |event: &&Event| self.count().wrapping_sub(event.count) < new;
        self.recent.iter().rev().find(is_new)
    }

    /// Records an event at `time` [s].
    pub fn record(&mut self, what: Happening, body: usize, time: f64) {
        let event = Event { what, body: body as u8, time, count: self.count().wrapping_add(1) };
        self.recent.rotate_right(1);
        self.recent[0] = event;
    }

    /// Records an event at `time` [s] for each dog clutch that switches between the states `before` and `after`. Returns
    /// true if there is an event.
    pub fn record_dogs(&mut self, [before, after]: [&Dogs; 2], time: f64) -> bool {
        let count = self.count();
        for s in 0..2 {
            match (before.closed[s], after.closed[s]) {
                (None, Some(_)) => self.record(Happening::DogEngages, s, time),
                (Some(_), None) => self.record(Happening::DogDisengages, s, time),
                _ => {}
            }
        }
        self.count() != count
    }

    /// Records an event at `time` [s] for each body that friction starts or stops holding between its states `before`
    /// and `after`. Returns true if there is an event.
    pub fn record_friction(&mut self, [before, after]: [&[FrictionState; PAIRS]; 2], time: f64) -> bool {
        let count = self.count();
        for i in 0..PAIRS {
            let happening = match (RubbingKind::of(i).0 == RubbingKind::Wheel, before[i].holds(), after[i].holds()) {
                (_, false, false) | (_, true, true) => continue,
                (true, _, true) => Happening::WheelStops,
                (true, _, false) => Happening::WheelBreaksLoose,
                (false, _, true) => Happening::ClutchSticks,
                (false, _, false) => Happening::ClutchSlips,
            };
            self.record(happening, i, time);
        }
        self.count() != count
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::effect_kinds::Mode;

    /// Numbers of the events that a reader finds after event number `seen`.
    fn found(events: &Events, mut seen: u32) -> Vec<u32> {
        let mut all = Vec::new();
        while let Some(event) = events.after(seen) {
            seen = event.count;
            all.push(seen);
        }
        all
    }

    #[test]
    fn events_are_found_in_order_and_the_oldest_are_forgotten() {
        let mut events = Events::default();
        assert_eq!(events.after(0), None);
        for k in 1..=11 {
            events.record(Happening::WheelStops, RubbingKind::Wheel.number(0), f64::from(k));
        }
        assert_eq!((events.count(), events.last().time), (11, 11.0));
        assert_eq!(found(&events, 0), [4, 5, 6, 7, 8, 9, 10, 11]);
        assert_eq!(found(&events, 9), [10, 11]);
        assert_eq!(found(&events, 11), []);
    }

    #[test]
    fn event_numbers_may_wrap() {
        let mut events = Events { recent: [Event { count: u32::MAX - 1, ..Event::default() }; REMEMBERED] };
        for _ in 0..3 {
            events.record(Happening::ToothBreaks, 0, 1.0);
        }
        assert_eq!(found(&events, u32::MAX - 1), [u32::MAX, 0, 1]);
    }

    #[test]
    fn only_bodies_that_friction_starts_or_stops_holding_cause_events() {
        let free = FrictionState::default();
        let held = FrictionState { stiffness: 1e5, ..free };
        let slides = FrictionState { mode: Mode::Forward, ..held };
        let (left, right) = (RubbingKind::Wheel.number(0), RubbingKind::Wheel.number(1));
        let changes = [
            (left, free, held, Happening::WheelStops),
            (right, held, free, Happening::WheelBreaksLoose),
            (right, slides, held, Happening::WheelStops),
            (left, held, slides, Happening::WheelBreaksLoose),
            (0, free, held, Happening::ClutchSticks),
            (1, held, free, Happening::ClutchSlips),
            (left, free, slides, Happening::Nothing),
            (left, slides, free, Happening::Nothing),
            (0, held, FrictionState { stiffness: 2e5, ..held }, Happening::Nothing),
        ];
        for (body, from, to, what) in changes {
            let (mut before, mut after, mut events) = ([slides; PAIRS], [slides; _], Events::default());
            (before[body], after[body]) = (from, to);
            let is_event = what != Happening::Nothing;
            assert_eq!(events.record_friction([&before, &after], 0.5), is_event, "{body}: {from:?} to {to:?}");
            let expected = Event { what, body: body as u8, time: 0.5, count: 1 };
            assert_eq!(*events.last(), if is_event { expected } else { Event::default() });
        }
    }
}
