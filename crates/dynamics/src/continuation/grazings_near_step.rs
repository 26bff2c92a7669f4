//! The grazing orbits on a step of a branch, or near one.

use super::chord_and_cubic::along_chord;
use super::equations::StepEnds;
use super::grazing_test::GrazingTest;
use super::period_map::PeriodMap;
use super::{Continuation, GrazingTouch, SpecialKind, SpecialPoint};
use crate::orbit::OrbitError;

impl Continuation<'_> {
    /// The grazing orbits that Newton's method reaches from either of two nodes, each with its share of the chord between them,
    /// from -`beyond` to 1 + `beyond`: the one for which `is_whole` holds, and true; else the first of each surface, and false.
    pub(super) fn grazings_near_step(
        &self,
        (from, to): StepEnds<'_, PeriodMap>,
        beyond: f64,
        is_whole: impl Fn(&GrazingTouch) -> bool,
    ) -> Result<(Vec<(f64, SpecialPoint)>, bool), OrbitError> {
        let way = &to.at - &from.at;
        let mut found: Vec<(f64, SpecialPoint)> = Vec::new();
        let mut surfaces = Vec::new();
        for node in [from, to] {
            for special in GrazingTest::of_node(&self.shooting, node).grazing_orbits(&self.shooting)
            {
                let SpecialKind::Grazing(mut graze) = special.kind else {
                    continue;
                };
                let at = self.unknowns_of(&special.point)?;
                let (share, off) = along_chord((&from.at, &way), &at);
                if !(-beyond..=1.0 + beyond).contains(&share) || off > beyond.max(1.0) * way.norm()
                {
                    continue;
                }
                graze.dies = from.here.point.impacts.len() > graze.impacts;
                let special = SpecialPoint {
                    kind: SpecialKind::Grazing(graze),
                    ..special.clone()
                };
                if is_whole(&graze) {
                    return Ok((vec![(share, special)], true));
                }
                if !surfaces.contains(&graze.surface) {
                    surfaces.push(graze.surface);
                    found.push((share, special));
                }
                // Past a corner the steps that follow find the others.
                if beyond > 0.0 {
                    break;
                }
            }
        }
        Ok((found, false))
    }
}
