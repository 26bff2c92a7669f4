//! The basins of a survey: classes of cells by the motions that they have come to.

use super::Basins;
use super::basin_survey::BasinSurvey;
use crate::attractors::Attractor;
use crate::attractors::catalogue::KnownOrbit;
use crate::ensemble::MemberStatus;
use crate::motion_kind::MotionKind;
use crate::orbit::{LyapunovExponents, Orbit, OrbitError};

impl BasinSurvey<'_> {
    /// The basins of a survey, class by class: periodic motions by period, impacts and hardest impact, then rest, wandering and
    /// lost ones. `first`: the exponents of the first wandering cell, if they are known.
    pub(super) fn into_basins(
        self,
        first: Option<LyapunovExponents>,
    ) -> Result<Basins, OrbitError> {
        let mut basins = Basins {
            grid: *self.grid,
            classes: Vec::new(),
            cells: vec![0; self.outcomes.len()],
            lost: self.lost.as_ref().map(|(_, error)| error.clone()),
        };
        let mut known: Vec<(usize, &KnownOrbit)> =
            self.catalogue.orbits.iter().enumerate().collect();
        let key = |orbit: &Orbit| (orbit.periods, orbit.impacts.len());
        known.sort_by(|(_, a), (_, b)| {
            let (a, b) = (&a.orbit, &b.orbit);
            key(a).cmp(&key(b)).then(a.compare_velocity(b))
        });
        for (index, known) in known {
            let class = |starts| Attractor {
                residuals: Some(known.residuals),
                ..Attractor::from_orbit(&known.orbit, starts)
            };
            self.enter_class(&mut basins, |it| it.attractor() == Some(index), class);
        }
        let (wandering, exponents) = self.classify_wandering_cells(first)?;
        for (outcome, motion) in [
            (MemberStatus::AtRest, MotionKind::Rest),
            (MemberStatus::Wandering, wandering),
            (MemberStatus::Lost, MotionKind::Lost),
        ] {
            let first = self.outcomes.iter().position(|it| *it == outcome);
            let Some(first) = first else { continue };
            let class = |starts| Attractor {
                exponents: exponents.filter(|_| outcome == MemberStatus::Wandering),
                ..Attractor::new(motion, self.states[first], starts)
            };
            self.enter_class(&mut basins, |it| it == outcome, class);
        }
        Ok(basins)
    }

    /// Enters in the basins the class of all cells for whose outcome `has_come` is true, if there are any.
    fn enter_class(
        &self,
        basins: &mut Basins,
        has_come: impl Fn(MemberStatus) -> bool,
        class: impl FnOnce((usize, usize)) -> Attractor,
    ) {
        let number = basins.classes.len() as u16;
        let mut own = 0;
        for (cell, outcome) in basins.cells.iter_mut().zip(&self.outcomes) {
            if has_come(*outcome) {
                *cell = number;
                own += 1;
            }
        }
        if own > 0 {
            basins.classes.push(class((own, self.outcomes.len())));
        }
    }
}
