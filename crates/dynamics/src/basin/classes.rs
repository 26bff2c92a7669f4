//! What the cells have come to, basin by basin.

use super::survey::{Fate, Survey};
use super::{Basins, Class, wilson};
use crate::attractors::SurveyError;
use crate::motion::MotionKind;
use crate::orbit::{BATCH_PERIODS, Exponents, Orbit};

impl Survey<'_> {
    /// All basins: periodic motions by period, impacts and hardest impact, then the others.
    pub(super) fn report(self) -> Result<Basins, SurveyError> {
        let mut basins = Basins {
            grid: *self.grid,
            classes: Vec::new(),
            cells: vec![0; self.fates.len()],
        };
        let orbits = self.book.orbits.iter().map(|known| &known.orbit);
        let mut orbits: Vec<(usize, &Orbit)> = orbits.enumerate().collect();
        let key = |orbit: &Orbit| (orbit.periods, orbit.impacts.len());
        orbits.sort_by(|(_, a), (_, b)| key(a).cmp(&key(b)).then(a.compare_velocity(b)));
        for (index, orbit) in orbits {
            let class = Class {
                orbit: Some(Box::new(orbit.clone())),
                ..Class::of(MotionKind::of(orbit))
            };
            self.enter(&mut basins, Fate::Orbit(index), class);
        }
        self.enter(&mut basins, Fate::AtRest, Class::of(MotionKind::Rest));
        if let Some(class) = self.wandering()? {
            self.enter(&mut basins, Fate::Wandering, class);
        }
        let lost = Class {
            error: self.lost.as_ref().map(|(_, error)| error.clone()),
            ..Class::of(MotionKind::Lost)
        };
        self.enter(&mut basins, Fate::Lost, lost);
        Ok(basins)
    }

    /// What the cells are that have not returned.
    fn wandering(&self) -> Result<Option<Class>, SurveyError> {
        let mut fates = self.fates.iter();
        let Some(cell) = fates.position(|fate| *fate == Fate::Wandering) else {
            return Ok(None);
        };
        let (state, ask) = (self.states[cell].into(), || self.fleet.note(0));
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

    /// Enters the basin of all cells with a fate, if there are any.
    fn enter(&self, basins: &mut Basins, fate: Fate, class: Class) {
        let all = self.fates.len();
        let mut own = 0;
        for (cell, _) in self.fates.iter().enumerate().filter(|it| *it.1 == fate) {
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
    const fn of(motion: MotionKind) -> Self {
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
