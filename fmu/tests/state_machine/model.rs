//! What the standard and the unit's contract let one expect of a call.

use std::collections::BTreeMap;

use softstop_fmi::Row;
use softstop_fmi::variable::{Access, Kind};
use softstop_fmu::{Machine, StartValues, library_guid, table};

use super::calls::{Call, Null, StatusOf, Type};
use crate::common::{ERROR, InstantiateArguments, OK, Statuses, if_all, reference};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Life {
    Instantiated,
    Initializing,
    Running,
    Terminated,
}

/// Names of log categories: the unit's own and the standard's.
const CATEGORIES: [&str; 8] = [
    "events",
    "warnings",
    "errors",
    "logEvents",
    "logStatusWarning",
    "logStatusDiscard",
    "logStatusError",
    "logAll",
];

/// An instance as the importer must imagine it.
#[derive(Debug, Clone)]
pub struct Model {
    pub life: Life,
    experiment: bool,
    stop: Option<f64>,
    pub time: f64,
    pub previous: f64,
    /// Parameters by value reference.
    pub values: BTreeMap<u32, f64>,
    pub material: bool,
}

pub fn is(kind: &Kind, wanted: Type) -> bool {
    match kind {
        Kind::Real(_) => wanted == Type::Real,
        Kind::Count { .. } | Kind::Enumeration(_) => wanted == Type::Integer,
        Kind::Boolean => wanted == Type::Boolean,
    }
}

fn find(reference: u32, wanted: Type) -> Option<&'static Row<Machine>> {
    let row = table().by_reference(reference);
    row.filter(|row| is(&row.kind, wanted))
}

fn is_in_range(kind: &Kind, value: f64) -> bool {
    match kind {
        Kind::Real(_) => kind.contains(value),
        Kind::Count { min, max } => {
            value >= f64::from(*min) && max.is_none_or(|max| value <= f64::from(max))
        }
        Kind::Enumeration(items) => items.items.iter().any(|i| f64::from(i.value) == value),
        Kind::Boolean => true,
    }
}

fn is_initial(vr: u32) -> bool {
    ["initial.position", "initial.velocity"]
        .map(reference)
        .contains(&vr)
}

/// What the refusal of an instance is about.
pub fn refusal(arguments: &InstantiateArguments) -> Option<String> {
    let name = arguments.name.filter(|name| !name.is_empty());
    match &arguments.guid {
        _ if name.is_none() => Some("instanceName".to_owned()),
        None => Some("fmuGUID".to_owned()),
        _ if arguments.kind != 1 => Some(format!("fmuType = {}", arguments.kind)),
        own if *own == Some(library_guid()) => None,
        other => other.clone(),
    }
}

impl Model {
    pub fn new() -> Self {
        let parameters = table().rows().filter_map(|variable| match variable.access {
            Access::Parameter { slot, .. } => {
                Some((variable.reference, StartValues::DEFAULT.get(slot)))
            }
            _ => None,
        });
        Self {
            life: Life::Instantiated,
            experiment: false,
            stop: None,
            time: 0.0,
            previous: 0.0,
            values: parameters.collect(),
            material: true,
        }
    }

    fn value(&self, name: &str) -> f64 {
        self.values[&reference(name)]
    }

    /// Where a rigid stop stands, if there is one.
    fn wall(&self, values: &BTreeMap<u32, f64>) -> f64 {
        let value = |name| values[&reference(name)];
        let stop = value("clearance") + value("piercing.thickness") + value("piercing.travel");
        match value("stop.model") as i32 {
            1 => f64::INFINITY,
            6 => stop,
            _ if value("rigid.present") != 0.0 => stop + value("rigid.travel"),
            _ => f64::INFINITY,
        }
    }

    /// Whether the parameters describe a machine.
    pub fn is_sound(&self) -> bool {
        let count = self.value("stop.loading.count");
        let chain = self.value("stop.model") != 3.0
            || count == 1.0
            || (count == 2.0 && self.value("stop.loading.from[2]") > 0.0);
        chain && self.value("initial.position") <= self.wall(&self.values)
    }

    fn has_outputs(&self) -> bool {
        match self.life {
            Life::Instantiated => false,
            Life::Initializing => self.is_sound(),
            Life::Running | Life::Terminated => true,
        }
    }

    /// What will come of a call on the instance alone; the mass is at `position`.
    pub fn expected(&self, call: &Call, position: f64) -> Statuses {
        match call {
            Call::SetDebugLogging(_, names, null) => if_all(&[
                names.is_empty() || *null != Null::First,
                names.iter().all(|name| CATEGORIES.contains(name)),
            ]),
            Call::SetupExperiment(tolerance, start, stop) => if_all(&[
                self.life == Life::Instantiated,
                tolerance.is_none_or(|t| t.is_finite() && t >= 0.0),
                start.is_finite(),
                stop.is_none_or(|stop| stop.is_finite() && stop >= *start),
            ]),
            Call::EnterInitializationMode => {
                if_all(&[self.life == Life::Instantiated, self.experiment])
            }
            Call::ExitInitializationMode => {
                if_all(&[self.life == Life::Initializing, self.is_sound()])
            }
            Call::Terminate => if_all(&[self.life == Life::Running]),
            Call::Reset => &[OK],
            Call::Get(kind, references, null) => self.get(*kind, references, *null),
            Call::Set(kind, pairs, null) => self.set(*kind, pairs, *null, position),
            Call::Directional(unknowns, knowns, null) => self.directional(unknowns, knowns, *null),
            Call::SetInputDerivatives(rows, null) => if_all(&[
                matches!(
                    self.life,
                    Life::Instantiated | Life::Initializing | Life::Running
                ),
                rows.is_empty() || *null == Null::Nothing,
                rows.iter().all(|(vr, order, value)| {
                    find(*vr, Type::Real)
                        .is_some_and(|variable| matches!(variable.access, Access::Signal(_)))
                        && value.abs() <= 1e12
                        && ((1..=7).contains(order) || (*order > 7 && *value == 0.0))
                }),
            ]),
            Call::GetOutputDerivatives(rows, null) => if_all(&[
                matches!(self.life, Life::Running | Life::Terminated),
                rows.is_empty() || *null == Null::Nothing,
                rows.iter().all(|(vr, order)| {
                    (1..=2).contains(order)
                        && ((200..=203).contains(vr) || (209..=216).contains(vr))
                }),
            ]),
            Call::Status(of, kind, null) => if_all(&[
                *null != Null::First,
                matches!(
                    (of, kind),
                    (StatusOf::Step, 0) | (StatusOf::Real, 2) | (StatusOf::Boolean, 3)
                ),
            ]),
            Call::CancelStep => &[ERROR],
            other => unreachable!("{other:?} is judged elsewhere"),
        }
    }

    fn get(&self, kind: Type, references: &[u32], null: Null) -> Statuses {
        let outputs = references.iter().any(|vr| {
            table()
                .by_reference(*vr)
                .is_some_and(|variable| variable.is_calculated())
        });
        if_all(&[
            references.is_empty() || null == Null::Nothing,
            references.iter().all(|vr| find(*vr, kind).is_some()),
            !outputs || self.has_outputs(),
        ])
    }

    fn set(&self, kind: Type, pairs: &[(u32, f64)], null: Null, position: f64) -> Statuses {
        if kind == Type::String {
            return if_all(&[pairs.is_empty()]);
        }
        let may_be_set = |(vr, value): &(u32, f64)| {
            find(*vr, kind).is_some_and(|variable| {
                is_in_range(&variable.kind, *value)
                    && match variable.access {
                        Access::Parameter { tunable, .. } => tunable || self.life != Life::Running,
                        Access::Signal(_) | Access::Input(_) => true,
                        _ => false,
                    }
            })
        };
        let mut after = self.values.clone();
        after.extend(pairs.iter().copied());
        let tuned = after != self.values;
        if_all(&[
            self.life != Life::Terminated,
            pairs.is_empty() || null == Null::Nothing,
            pairs.iter().all(may_be_set),
            self.life != Life::Running || !tuned || position <= self.wall(&after),
        ])
    }

    fn directional(&self, unknowns: &[u32], knowns: &[(u32, f64)], null: Null) -> Statuses {
        let output = |vr: &u32| find(*vr, Type::Real).is_some_and(|variable| variable.is_output());
        let known = |(vr, seed): &(u32, f64)| {
            seed.is_finite()
                && find(*vr, Type::Real).is_some_and(|variable| match variable.access {
                    Access::Signal(_) => true,
                    Access::Parameter { .. } => self.life == Life::Initializing || is_initial(*vr),
                    _ => false,
                })
        };
        let answered = if_all(&[
            self.has_outputs(),
            unknowns.is_empty() || null != Null::First,
            knowns.is_empty() || null != Null::Second,
            unknowns.iter().all(output),
            knowns.iter().all(known),
        ]);
        let by_start = knowns.iter().any(|(vr, _)| is_initial(*vr));
        if answered == [OK] && by_start && self.life != Life::Initializing {
            return &[OK, ERROR];
        }
        answered
    }

    /// Whether a step from `point` is carried out.
    pub fn expected_step(&self, point: f64, size: f64) -> Statuses {
        let end = point + size;
        // The unit's contract: within a billionth of the time, and half a step at most.
        let counting = 1e-9 * self.time.abs().max(1.0);
        let tolerance = counting
            .min(0.5 * size)
            .max(16.0 * f64::EPSILON * self.time.abs());
        if_all(&[
            self.life == Life::Running,
            point.is_finite() && size.is_finite() && size > 0.0 && end.abs() < 1e15,
            (point - self.time).abs() <= tolerance,
            self.stop
                .is_none_or(|stop| end <= stop + 1e-9 * stop.abs().max(1.0)),
        ])
    }

    /// What a call that was carried out leaves behind.
    pub fn take(&mut self, call: &Call) {
        match call {
            Call::SetupExperiment(_, start, stop) => {
                (self.experiment, self.time, self.stop) = (true, *start, *stop);
                self.previous = *start;
            }
            Call::EnterInitializationMode => self.life = Life::Initializing,
            Call::ExitInitializationMode => self.life = Life::Running,
            Call::Terminate => self.life = Life::Terminated,
            Call::Reset => *self = Self::new(),
            Call::Set(kind, pairs, _) => self.adopt(*kind, pairs),
            _ => {}
        }
    }

    /// Parameters are read as they were set.
    pub fn check_values(&self, references: &[u32], read: &[f64]) {
        for (vr, value) in references.iter().zip(read) {
            let set = self.values.get(vr).copied();
            let material =
                (*vr == reference("material")).then_some(f64::from(u8::from(self.material)));
            if let Some(expected) = set.or(material) {
                assert_eq!(*value, expected, "value reference {vr}");
            }
        }
    }

    fn adopt(&mut self, kind: Type, pairs: &[(u32, f64)]) {
        for (vr, value) in pairs {
            let value = match kind {
                Type::Boolean => f64::from(u8::from(*value != 0.0)),
                _ => *value,
            };
            if let Some(parameter) = self.values.get_mut(vr) {
                *parameter = value;
            } else if *vr == reference("material") {
                self.material = value != 0.0;
            }
        }
    }
}
