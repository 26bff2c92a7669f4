//! The clock of impacts: it ticks in event mode, before the update that brings the state after an impact.

use softstop_fmi3::*;
use softstop_fmu::Options;

use super::events::MACHINES;
use super::integrator::Integrator;
use super::unit::{CLOCK, Unit};
use crate::common::ERROR;

const PERIOD: f64 = std::f64::consts::TAU / 1.15;
const END: f64 = 10.0 * PERIOD;

const WITH_CLOCK: Options = Options {
    exchange: false,
    clock: true,
    arrays: false,
};

fn begun(early: bool, values: &[(&str, f64)]) -> Unit {
    Unit::made((true, early), None, WITH_CLOCK).begin(values)
}

#[test]
fn it_ticks_at_each_impact_and_at_nothing_else() {
    for values in MACHINES {
        let unit = begun(true, values);
        let (mut point, mut others) = (0.0, 0);
        while point < END {
            let ending = unit.step(point, END - point);
            point = ending.time;
            assert!(!unit.ticks());
            unit.enter_event_mode();
            let before = unit.get("impact.count");
            // However often it is asked.
            let ticks = [(); 3].map(|()| unit.ticks());
            let velocity = unit.get("velocity");
            unit.update();
            let is_impact = unit.get("impact.count") > before;
            assert_eq!(ticks, [is_impact; 3], "{point}");
            assert!(!unit.ticks());
            let is_single = unit.get("impact.count") == before + 1.0;
            if is_single {
                assert_eq!(unit.get("impact.time"), point);
                assert!((unit.get("impact.velocity") - velocity).abs() < 1e-12);
            }
            others += u32::from(!is_impact);
            unit.leave_event_mode();
            assert!(!unit.ticks());
        }
        assert!(others > 5 && unit.get("impact.count") > 5.0);
    }
}

#[test]
fn after_a_step_that_may_not_end_early_it_tells_that_there_were_impacts() {
    for values in MACHINES {
        let (unit, mut told) = (begun(false, values), 0.0);
        for number in 0..500 {
            let (point, size) = (0.1 * f64::from(number), 0.1);
            if unit.step(point, size).event {
                unit.enter_event_mode();
                let ticks = unit.ticks();
                unit.update();
                let count = unit.get("impact.count");
                assert_eq!(ticks, count > told);
                told = count;
                unit.leave_event_mode();
            }
            assert!(!unit.ticks() && unit.get("impact.count") == told);
        }
        assert!(told > 5.0);
    }
}

#[test]
fn in_model_exchange_it_ticks_alike() {
    for values in MACHINES {
        let mut importer = Integrator::of(Unit::for_exchange(WITH_CLOCK), values);
        while importer.time < END {
            let next = importer.next.unwrap_or(END).min(END);
            while importer.time < next {
                let size = (next - importer.time).min(0.02);
                importer.step(size);
                assert!(!importer.unit.ticks());
            }
            importer.unit.enter_event_mode();
            let before = importer.unit.get("impact.count");
            let ticks = importer.unit.ticks();
            importer.leave_event_mode();
            let is_impact = importer.unit.get("impact.count") > before;
            assert_eq!(ticks, is_impact, "{}", importer.time);
            assert!(!importer.unit.ticks());
        }
        assert!(importer.unit.get("impact.count") > 5.0);
    }
}

#[test]
fn a_kept_state_ticks_as_well() {
    let (one, other) = (begun(true, &[]), begun(true, &[]));
    one.step(0.0, END);
    one.enter_event_mode();
    let state = one.keep();
    one.update();
    assert!(!one.ticks());
    for unit in [&one, &other] {
        unit.go_back(state);
        assert!(unit.ticks());
    }
    one.free(state);
}

#[test]
fn it_cannot_be_set_has_no_interval_and_is_of_units_that_tell_of_it() {
    let made = [(); 3].map(|()| begun(true, &[]));
    let [one, two, three] = made.each_ref().map(|unit| unit.instance);
    let (mut interval, mut qualifier) = (0.0, 0);
    let (interval, qualifier) = (&raw mut interval, &raw mut qualifier);
    // SAFETY: one reference and one value.
    let statuses = unsafe {
        [
            fmi3SetClock(one, &CLOCK, 1, &1),
            fmi3GetIntervalDecimal(two, &CLOCK, 1, interval, qualifier),
            fmi3SetIntervalDecimal(three, &CLOCK, 1, &1.0),
        ]
    };
    assert_eq!(statuses, [ERROR; 3]);
    let why = [
        "impact is an output",
        "no time-based clocks",
        "no time-based clocks",
    ];
    for (unit, why) in made.iter().zip(why) {
        assert!(unit.take_log()[0].contains(why));
    }
    let plain = Unit::begun((true, true), &[]);
    assert_eq!(plain.try_clock().0, ERROR);
    assert!(plain.take_log()[0].contains("no variable has the value reference 250"));
}
