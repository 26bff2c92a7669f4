//! What is searched: the machine, what may change of it, what is sought and what must hold.

use softstop::{Machine, Parameter};
use softstop_dynamics::attractors::Region;
use softstop_dynamics::run_up;
use softstop_dynamics::zone::ZoneKind;

use super::case::Case;
use super::cost::Cost;
use super::figure::{Figure, Sense};
use super::requirement::{Requirement, Scope};
use super::slope::Slope;
use super::space::{Axis, Interval};
use crate::robust::{self, Distribution, Tolerances};

/// The share that lies outside three standard deviations.
pub const VIOLATING: f64 = 0.0027;

/// What is searched, and where. All values are in the machine's own units.
#[derive(Debug, Clone)]
pub struct Problem {
    /// The machine; what is searched of it plays no part.
    pub machine: Machine,
    /// Which motions are searched.
    pub zone: ZoneKind,
    /// Which range of a zone whose branch folds back, as [`Zone::on_range`](softstop_dynamics::Zone::on_range) counts
    /// them; none: the hardest motion of all of them at each frequency.
    pub range: Option<usize>,
    /// Least distance M of s from 0 and 1, in [0, 0.5].
    pub margin: f64,
    /// The parameters that the search may choose, but the drive's frequency.
    pub axes: Vec<Axis>,
    /// Drive frequency, intersected with the zone.
    pub frequency: Interval,
    /// Parameters that follow others.
    pub links: Vec<Link>,
    /// What cannot be made exactly.
    pub tolerances: Vec<Tolerance>,
    /// How many times as wide as the tolerances the box is that a design keeps.
    pub reserve: f64,
    /// Half-width of that box along normal tolerances, in standard deviations.
    pub deviations: f64,
    /// Share of the machines with normal tolerances that may lose the motion or violate a requirement.
    pub violating: f64,
    /// What is sought.
    pub objective: Objective,
    /// What else is sought: a front trades it for the first.
    pub traded: Vec<Objective>,
    /// What must hold.
    pub requirements: Vec<Requirement>,
    /// The formula of [`Figure::Cost`].
    pub cost: Option<Cost>,
    /// The box of starts of which certainty and integrity are told, in SI units; that of all commands if none is stated.
    pub starts: Option<Region>,
    /// How the machine may be run up.
    pub run_up: run_up::RunUpSettings,
    /// Further operating points, in which all that is required must hold too.
    pub cases: Vec<Case>,
    /// What a case changes of the machine, if this is the problem of one.
    pub changes: Vec<(Parameter, f64)>,
    /// The problem of the drawing, if this is that of a case at the drawing's frequency.
    pub drawing: Option<Box<Problem>>,
}

/// A parameter that follows another one, in the machine's own units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Link {
    /// Which.
    pub parameter: Parameter,
    /// The other one.
    pub follows: Parameter,
    /// How often it holds the other.
    pub factor: f64,
    /// What is added.
    pub offset: f64,
}

/// How far a parameter may be from its value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerance {
    /// Which.
    pub parameter: Parameter,
    /// How far on either side.
    pub width: Width,
    /// How the values of the machines lie that are built.
    pub distribution: Distribution,
}

impl Tolerance {
    /// One whose values may lie anywhere within it.
    pub const fn new(parameter: Parameter, width: Width) -> Self {
        Self {
            parameter,
            width,
            distribution: Distribution::Box,
        }
    }

    /// True if it has a width, and values lie normally within.
    pub fn is_normal(&self) -> bool {
        !self.is_exact() && matches!(self.distribution, Distribution::Normal(_))
    }

    /// True if its width is zero.
    pub fn is_exact(&self) -> bool {
        matches!(self.width, Width::Own(0.0) | Width::Share(0.0))
    }
}

/// Half of a tolerance's width.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Width {
    /// In the machine's own units.
    Own(f64),
    /// As a share of the value.
    Share(f64),
}

impl Width {
    /// True if it can be one.
    pub fn is_allowed(&self) -> bool {
        match self {
            Self::Own(width) => width.is_finite() && *width >= 0.0,
            Self::Share(share) => (0.0..1.0).contains(share),
        }
    }

    /// Around a value, in the units of the value.
    pub fn around(&self, value: f64) -> f64 {
        match self {
            Self::Own(width) => *width,
            Self::Share(share) => share * value.abs(),
        }
    }
}

/// What is sought.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Objective {
    /// Of what.
    pub figure: Figure,
    /// [`Sense::Least`]: as much as can be, [`Sense::Most`]: as little.
    pub sense: Sense,
    /// Of the drawing's machine, or of the worst within the tolerances.
    pub scope: Scope,
}

impl Default for Objective {
    /// The highest before-impact velocity.
    fn default() -> Self {
        Self::new(Figure::Velocity, Sense::Least)
    }
}

impl Objective {
    /// As much of a figure of the drawing's machine as can be, or as little.
    pub const fn new(figure: Figure, sense: Sense) -> Self {
        Self {
            figure,
            sense,
            scope: Scope::Drawing,
        }
    }

    /// The value of a grade.
    pub(super) fn value_of(&self, score: f64) -> f64 {
        // The reciprocal of a reciprocal.
        self.score(score)
    }

    /// The worse of two values.
    pub(super) fn worse(&self, one: f64, other: f64) -> f64 {
        match self.score(one) < self.score(other) {
            true => one,
            false => other,
        }
    }

    /// The grade of a value, positive and the higher the better.
    pub fn score(&self, value: f64) -> f64 {
        match self.sense {
            Sense::Least => value,
            Sense::Most => value.recip(),
        }
    }

    /// The grade of a value with its derivatives.
    pub(super) fn slope(&self, of: Slope) -> Slope {
        let score = self.score(of.value);
        // d score / d value: 1, or that of the reciprocal.
        let by_value = match self.sense {
            Sense::Least => 1.0,
            Sense::Most => -score * score,
        };
        Slope {
            value: score,
            by: of.by.iter().map(|by| by * by_value).collect(),
        }
    }

    /// As a phrase after "the design with".
    pub fn words(&self) -> String {
        let most = match self.sense {
            Sense::Least => "highest",
            Sense::Most => "least",
        };
        let whose = match self.scope {
            Scope::Tolerances => " of the worst machine",
            Scope::Drawing => "",
        };
        format!("{most} {}{whose}", self.figure.meaning())
    }
}

impl Problem {
    /// The highest before-impact velocity of a machine anywhere in its zone.
    pub fn of(machine: Machine, axes: Vec<Axis>) -> Self {
        Self {
            machine,
            zone: ZoneKind::Hysteresis,
            range: None,
            margin: 0.0,
            axes,
            frequency: Interval::ANY,
            links: Vec::new(),
            tolerances: Vec::new(),
            reserve: 1.0,
            deviations: 3.0,
            violating: VIOLATING,
            objective: Objective::default(),
            traded: Vec::new(),
            requirements: Vec::new(),
            cost: None,
            starts: None,
            run_up: run_up::RunUpSettings::default(),
            cases: Vec::new(),
            changes: Vec::new(),
            drawing: None,
        }
    }

    /// Where the search may choose a parameter, the drive's frequency among them; none of one that it does not choose.
    pub fn range_of(&self, parameter: Parameter) -> Option<Interval> {
        let mut axes = self.axes.iter();
        let axis = axes.find(|axis| axis.parameter == parameter);
        let frequency = (parameter == Parameter::Frequency).then_some(self.frequency);
        axis.map(|it| it.range).or(frequency)
    }

    /// The axes that are searched.
    pub fn free_axes(&self) -> impl Iterator<Item = &Axis> {
        self.axes.iter().filter(|axis| !axis.range.is_held())
    }

    /// The machine with these values of the axes.
    pub fn machine_at(&self, values: &[f64]) -> Machine {
        let mut machine = self.machine.clone();
        for (axis, value) in self.axes.iter().zip(values) {
            machine.set(axis.parameter, *value);
        }
        for (parameter, value) in &self.changes {
            machine.set(*parameter, *value);
        }
        self.link(&mut machine);
        machine
    }

    /// Sets what follows.
    pub fn link(&self, machine: &mut Machine) {
        for link in &self.links {
            if let Some(value) = machine.value(link.follows) {
                machine.set(link.parameter, link.factor * value + link.offset);
            }
        }
    }

    /// The problem with a box that reaches over so many standard deviations of normal tolerances.
    #[must_use]
    pub fn with_deviations(&self, deviations: f64) -> Self {
        Self {
            deviations,
            ..self.clone()
        }
    }

    /// The problem with tolerances as they are stated, without reserve.
    pub fn as_built(&self) -> Self {
        Self {
            reserve: 1.0,
            ..self.clone()
        }
    }

    /// How many times as wide as a tolerance the box is that a design keeps.
    pub fn widening(&self, tolerance: &Tolerance) -> f64 {
        self.reserve * tolerance.distribution.over(self.deviations).1
    }

    /// Half-width of the box along a parameter of a machine, in its own units; none if that is exact or the machine has none.
    pub fn half_width(&self, machine: &Machine, parameter: Parameter) -> Option<f64> {
        let mut tolerances = self.tolerances.iter();
        let it = tolerances.find(|it| it.parameter == parameter)?;
        let width = self.widening(it) * it.width.around(machine.value(parameter)?);
        Some(width).filter(|width| *width > 0.0)
    }

    /// The box of tolerances, with its reserve, about a machine whose drive runs at its frequency; none if all of it is exact.
    pub fn spread(&self, machine: &Machine) -> Option<Tolerances> {
        let half_width = |it: &Tolerance| {
            let width = self.half_width(machine, it.parameter)?;
            let half_width = match it.parameter {
                Parameter::Preload if machine.preload_deflection.is_some() => width,
                parameter => machine.to_si(parameter.about().dimension, width),
            };
            Some(robust::AbsoluteTolerance {
                parameter: it.parameter,
                half_width,
                distribution: it.distribution.over(self.deviations).0,
            })
        };
        let all: Vec<_> = self.tolerances.iter().filter_map(half_width).collect();
        let spread = (!all.is_empty()).then(|| Tolerances::new(machine, &all));
        Some(spread?.ok()?.with_cost(self.cost.clone()))
    }

    /// True if something cannot be made exactly.
    pub fn has_tolerances(&self) -> bool {
        self.tolerances_in_use() > 0
    }

    /// How many of the tolerances are not zero.
    pub(super) fn tolerances_in_use(&self) -> usize {
        self.tolerances.iter().filter(|it| !it.is_exact()).count()
    }

    /// True if the values of something lie normally about the design.
    pub fn has_normal_tolerances(&self) -> bool {
        self.tolerances.iter().any(Tolerance::is_normal)
    }

    /// True if nothing is asked of a motion but its velocity and its place in the zone.
    pub fn is_plain(&self) -> bool {
        let asks_more = !self.requirements.is_empty() || !self.cases.is_empty();
        self.objective == Objective::default() && !asks_more
    }
}
