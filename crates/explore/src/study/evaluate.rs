//! Points of a study, block by block: the piece of work that is done, kept and merged as one.

use std::cell::OnceCell;

use softstop::internals::budget;
use softstop::{Machine, Scene};
use softstop_console::column::Unit;
use softstop_console::failure::Failure;
use softstop_console::interrupt;
use softstop_dynamics::continuation::{Direction, TestFunction};
use softstop_dynamics::figure::Figure;
use softstop_dynamics::parallel;
use softstop_dynamics::settled::SettledMotion;
use softstop_dynamics::zone::{
    free_amplitude, grazing_frequencies, hysteresis_batch, loss_of_stability,
};
use softstop_dynamics::{
    CycleMetrics, Exponents, MotionKind, Orbit, Regime, StroboscopicMap, Zone,
};

use super::file::Study;
use super::outputs::{Observable, Output, OutputKind, kind};

/// Points whose motions go together in the lanes: it may not depend on how many threads there are.
const TOGETHER: usize = 256;

impl Study {
    /// All outputs of a block, column by column, in the machine's own units; NaN where there is nothing.
    ///
    /// # Errors
    /// [`Failure::Interrupted`].
    pub(super) fn evaluate(&self, block: u64) -> Result<Vec<f64>, Failure> {
        let machines: Vec<Machine> = self.block(block).map(|it| self.machine_at(it)).collect();
        let groups: Vec<&[Machine]> = machines.chunks(TOGETHER).collect();
        let told = parallel::try_map(&groups, |machines| {
            let mut told = Vec::with_capacity(machines.len() * self.width());
            for evaluation in self.prepare(machines)? {
                told.extend(self.row(evaluation.as_ref()));
            }
            Ok::<_, Failure>(told)
        });
        let rows = told?.concat();
        if interrupt::requested() {
            return Err(Failure::Interrupted);
        }
        let width = self.width();
        let column = |column| rows.iter().skip(column).step_by(width);
        Ok((0..width).flat_map(column).copied().collect())
    }

    /// Numbers that a point takes in a block.
    pub(super) fn width(&self) -> usize {
        self.outputs.iter().map(|output| output.width()).sum()
    }

    /// The outputs of a point, none of which is there if they are over the budget.
    fn row(&self, evaluation: Option<&PointEvaluation<'_>>) -> Vec<f64> {
        let told = |value: &dyn Fn(Output) -> [f64; 2]| {
            let mut row = Vec::with_capacity(self.width());
            for output in &self.outputs {
                row.extend(&value(*output)[..output.width()]);
            }
            row
        };
        let within = evaluation.and_then(|evaluation| {
            let (row, spent) = budget::within(self.budget.windows(), || {
                told(&|output| evaluation.value(output))
            });
            (spent < self.budget.windows()).then_some(row)
        });
        within.unwrap_or_else(|| told(&|output| output.over_budget()))
    }

    /// What all outputs of some points are told from; nothing of those over the budget.
    ///
    /// Points that go together may cost what one of them may: then so may each of them alone. If they cost more, they
    /// are halved, so a point's answer does not depend on the points beside it.
    fn prepare<'a>(
        &'a self,
        machines: &'a [Machine],
    ) -> Result<Vec<Option<PointEvaluation<'a>>>, Failure> {
        let (prepared, spent) =
            budget::within(self.budget.windows(), || self.prepare_together(machines));
        if interrupt::requested() {
            return Err(Failure::Interrupted);
        }
        if spent < self.budget.windows() {
            return Ok(prepared?.into_iter().map(Some).collect());
        }
        let (first, rest) = machines.split_at(machines.len() / 2);
        if first.is_empty() {
            return Ok(rest.iter().map(|_| None).collect());
        }
        let mut prepared = self.prepare(first)?;
        prepared.extend(self.prepare(rest)?);
        Ok(prepared)
    }

    fn prepare_together<'a>(
        &'a self,
        machines: &'a [Machine],
    ) -> Result<Vec<PointEvaluation<'a>>, Failure> {
        let wanted = |is: fn(Output) -> bool| self.outputs.iter().any(|output| is(*output));
        let motions: Vec<_> = machines.iter().map(|it| (&it.scene, it.start)).collect();
        let seen = match wanted(Output::is_of_motion) {
            true => {
                let seen = self.settling.follow_motions(&motions, &interrupt::watch);
                seen.ok_or(Failure::Interrupted)?
            }
            false => Vec::new(),
        };
        let zones = match wanted(Output::is_of_zone) {
            true => {
                let scenes = machines.iter().map(|machine| machine.scene.clone());
                hysteresis_batch(&scenes.collect::<Vec<_>>(), &interrupt::watch)
            }
            false => Vec::new(),
        };
        let mut seen = seen.into_iter().map(Result::ok);
        let mut zones = zones.into_iter().map(Result::ok);
        let prepared = machines.iter().map(|machine| PointEvaluation {
            study: self,
            machine,
            is_valid: machine.validate().is_ok(),
            seen: seen.next().flatten(),
            zone: zones.next().flatten(),
            map: OnceCell::new(),
            motion: OnceCell::new(),
            orbit: OnceCell::new(),
        });
        Ok(prepared.collect())
    }
}

/// What the outputs of a point are told from, each made when the first of them asks.
struct PointEvaluation<'a> {
    study: &'a Study,
    machine: &'a Machine,
    is_valid: bool,
    seen: Option<SettledMotion>,
    zone: Option<Zone>,
    map: OnceCell<Option<StroboscopicMap>>,
    motion: OnceCell<Option<(MotionKind, Option<f64>)>>,
    orbit: OnceCell<Option<(Orbit, CycleMetrics)>>,
}

/// Where there is nothing.
const NOTHING: [f64; 2] = [f64::NAN; 2];

impl PointEvaluation<'_> {
    /// An output, in the machine's own units.
    fn value(&self, output: Output) -> [f64; 2] {
        if !self.is_valid {
            return match output.kind {
                OutputKind::Observable(Observable::Kind) => [kind(&MotionKind::Lost), f64::NAN],
                _ => NOTHING,
            };
        }
        if output.kind == OutputKind::Observable(Observable::Z) {
            return self.z().unwrap_or(NOTHING);
        }
        let value = match output.kind {
            OutputKind::Observable(observable) => self.observable(observable),
            OutputKind::Figure(figure) => self.figure(figure),
        };
        let own = |value| match output.unit {
            Unit::Own(dimension) => self.machine.to_own(dimension, value),
            _ => value,
        };
        [value.map_or(f64::NAN, own), f64::NAN]
    }

    fn observable(&self, observable: Observable) -> Option<f64> {
        match observable {
            Observable::Kind => Some(kind(self.motion().map_or(&MotionKind::Lost, |it| &it.0))),
            Observable::Z => None,
            Observable::SettledWithin => {
                let seen = self.seen.as_ref()?;
                seen.periods.map(|_| seen.followed as f64)
            }
            Observable::Impacts => Some(self.seen.as_ref()?.impacts_per_period()),
            Observable::Exponent => match self.seen.as_ref()?.periods {
                Some(_) => Some(Exponents::of(self.orbit()?).per_period[0]),
                None => self.wandering_exponent(),
            },
            Observable::Trace => Some(self.orbit()?.monodromy.trace()),
            Observable::Determinant => Some(self.orbit()?.monodromy.determinant()),
            Observable::G0 => Some(grazing_frequencies(self.scene()).ok()?.1),
            Observable::Sn => Some(self.zone.as_ref()?.high.frequency),
            Observable::Pd => self.flip().filter(|flip| flip.is_finite()),
            Observable::AtSn => Some(self.zone.as_ref()?.high.point.before_impact_velocity()),
        }
    }

    fn figure(&self, figure: Figure) -> Option<f64> {
        let frequency = self.scene().excitation.frequency;
        match figure {
            Figure::Velocity => Some(self.seen.as_ref()?.hardest_impact()),
            Figure::MaxPosition => self.seen.as_ref()?.max_position(self.map()?).ok(),
            Figure::Share => {
                let (low, high) = self.own_range()?;
                let place = (frequency - low) / (high - low);
                Some(place.min(1.0 - place))
            }
            Figure::FrequencyG0 => Some(frequency - grazing_frequencies(self.scene()).ok()?.1),
            Figure::FrequencySn => Some(self.own_range()?.1 - frequency),
            Figure::FrequencyPd => Some(frequency - self.flip()?),
            Figure::ClearanceG0 => {
                let scene = self.scene();
                Some(scene.least_clearance() - free_amplitude(scene, frequency))
            }
            Figure::Certainty => {
                let of = self.study.certainty;
                let settling = self.study.settling;
                settling.single_impact_certainty(
                    self.scene(),
                    of.starts,
                    of.region(),
                    &interrupt::watch,
                )
            }
            figure => {
                let (orbit, stroke) = self.periodic()?;
                figure.of_motion(orbit, stroke).filter(|it| !it.is_nan())
            }
        }
    }

    fn scene(&self) -> &Scene {
        &self.machine.scene
    }

    fn map(&self) -> Option<&StroboscopicMap> {
        let map = || Some(self.seen.as_ref()?.watched_map(&self.scene().check().ok()?));
        self.map.get_or_init(map).as_ref()
    }

    fn motion(&self) -> Option<&(MotionKind, Option<f64>)> {
        let motion = || self.seen.as_ref()?.motion_kind(self.map()?).ok();
        self.motion.get_or_init(motion).as_ref()
    }

    /// The larger exponent of a motion that does not return: of chaos the growth of small differences; of an unsettled motion
    /// by the larger multiplier, in which differences that turn or shear without growth do not count.
    fn wandering_exponent(&self) -> Option<f64> {
        let (kind, growth) = self.motion()?;
        if *kind != MotionKind::Unsettled {
            return *growth;
        }
        let map = self.map()?;
        let passage = map.apply(self.seen.as_ref()?.from.into()).ok()?;
        let [larger, _] = passage.monodromy.multipliers();
        Some(larger.norm().ln() / map.periods() as f64)
    }

    /// z = p/n as impacts and drive periods; complete chatter has no end of impacts.
    fn z(&self) -> Option<[f64; 2]> {
        let seen = self.seen.as_ref()?;
        let regime = seen.regime()?;
        let chatters =
            self.scene().wall().is_some() && matches!(self.motion()?.0, MotionKind::Chatter { .. });
        let impacts = match chatters {
            true => f64::INFINITY,
            false => regime.impacts as f64,
        };
        Some([impacts, regime.periods as f64])
    }

    /// The motion that returns, by Newton's method, and its figures.
    fn periodic(&self) -> Option<&(Orbit, CycleMetrics)> {
        let find = || {
            let seen = self.seen.as_ref()?;
            let orbit = Orbit::find_periodic(self.scene(), seen.end.into(), seen.periods?).ok()?;
            let is_same = Some(orbit.regime()) == seen.regime();
            let stroke = CycleMetrics::of(&orbit).ok()?;
            is_same.then_some((orbit, stroke))
        };
        self.orbit.get_or_init(find).as_ref()
    }

    fn orbit(&self) -> Option<&Orbit> {
        self.periodic().map(|(orbit, _)| orbit)
    }

    /// The frequency of s_PD in rad/s, minus infinity if there is none; nothing without a z = 1 motion to follow.
    fn flip(&self) -> Option<f64> {
        self.seen.as_ref()?;
        let orbit = self.single_impact_orbit()?;
        let flip = loss_of_stability(&orbit, Direction::Down, TestFunction::Flip).ok()?;
        Some(flip.map_or(f64::NEG_INFINITY, |flip| flip.parameter))
    }

    /// The motion if it is one of z = 1, otherwise the hardest of the zone here.
    fn single_impact_orbit(&self) -> Option<Orbit> {
        let is_one = self.seen.as_ref().and_then(SettledMotion::regime) == Some(Regime::ONE);
        match is_one {
            true => self.orbit().cloned(),
            false => self.zone.as_ref()?.orbit_at(self.place()?).ok(),
        }
    }

    /// Lowest and highest frequency in rad/s up to which the z = 1 motion goes on within the zone: its ends, but where the
    /// branch folds back within it.
    fn own_range(&self) -> Option<(f64, f64)> {
        let zone = self.zone.as_ref()?;
        if !zone.has_inner_folds() {
            return Some((zone.frequency_g0, zone.high.frequency));
        }
        zone.range_of(&self.single_impact_orbit()?).ok()
    }

    /// Place in the zone: 0 at g0, 1 at s_SN.
    fn place(&self) -> Option<f64> {
        let zone = self.zone.as_ref()?;
        let frequency = self.scene().excitation.frequency;
        Some((frequency - zone.frequency_g0) / (zone.high.frequency - zone.frequency_g0))
    }
}
