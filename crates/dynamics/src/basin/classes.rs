//! What the cells have come to, basin by basin.

use super::survey::{BasinSurvey, CellOutcome};
use super::{Basins, Class, wilson};
use crate::motion::MotionKind;
use crate::orbit::{BATCH_PERIODS, Exponents, Orbit, OrbitError};

impl BasinSurvey<'_> {
    /// All basins: periodic motions by period, impacts and hardest impact, then the others.
    pub(super) fn report(self) -> Result<Basins, OrbitError> {
        let mut basins = Basins {
            grid: *self.grid,
            classes: Vec::new(),
            cells: vec![0; self.outcomes.len()],
        };
        let orbits = self.catalogue.orbits.iter().map(|known| &known.orbit);
        let mut orbits: Vec<(usize, &Orbit)> = orbits.enumerate().collect();
        let key = |orbit: &Orbit| (orbit.periods, orbit.impacts.len());
        orbits.sort_by(|(_, a), (_, b)| key(a).cmp(&key(b)).then(a.compare_velocity(b)));
        for (index, orbit) in orbits {
            let class = Class {
                orbit: Some(Box::new(orbit.clone())),
                ..Class::of(MotionKind::of(orbit))
            };
            self.enter(&mut basins, CellOutcome::Orbit(index), class);
        }
        self.enter(
            &mut basins,
            CellOutcome::AtRest,
            Class::of(MotionKind::Rest),
        );
        if let Some(class) = self.wandering()? {
            self.enter(&mut basins, CellOutcome::Wandering, class);
        }
        let lost = Class {
            error: self.lost.as_ref().map(|(_, error)| error.clone()),
            ..Class::of(MotionKind::Lost)
        };
        self.enter(&mut basins, CellOutcome::Lost, lost);
        Ok(basins)
    }

    /// What the cells are that have not returned.
    fn wandering(&self) -> Result<Option<Class>, OrbitError> {
        let mut outcomes = self.outcomes.iter();
        let Some(cell) = outcomes.position(|outcome| *outcome == CellOutcome::Wandering) else {
            return Ok(None);
        };
        let (state, ask) = (self.states[cell].into(), || self.ensemble.note(0));
        let (exponents, _) =
            Exponents::along_with_monitor(self.scene, state, BATCH_PERIODS.0, ask)?;
        let motion = match exponents.is_positive() {
            true => MotionKind::Chaos,
            false => MotionKind::Unsettled,
        };
        Ok(Some(Class {
            exponents: Some(exponents),
            ..Class::of(motion)
        }))
    }

    /// Enters the basin of all cells with an outcome, if there are any.
    fn enter(&self, basins: &mut Basins, outcome: CellOutcome, class: Class) {
        let all = self.outcomes.len();
        let mut own = 0;
        for (cell, _) in self
            .outcomes
            .iter()
            .enumerate()
            .filter(|it| *it.1 == outcome)
        {
            basins.cells[cell] = basins.classes.len() as u16;
            own += 1;
        }
        if own > 0 {
            basins.classes.push(Class {
                cells: own,
                share: own as f64 / all as f64,
                interval: wilson(own, all),
                ..class
            });
        }
    }
}

impl Class {
    /// One without cells so far.
    pub(super) const fn of(motion: MotionKind) -> Self {
        Self {
            motion,
            orbit: None,
            exponents: None,
            error: None,
            cells: 0,
            share: 0.0,
            interval: [0.0; 2],
        }
    }
}
