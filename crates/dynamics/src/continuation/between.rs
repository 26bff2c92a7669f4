//! Points between two neighbours of a branch.

use super::Family;
use super::arclength::Node;
use super::follower::{Follower, WIDTH};
use super::locate::{locate, zero};
use super::point::BranchPoint;
use super::round::Round;
use super::test::Test;
use crate::orbit::OrbitError;

/// Distance of a point from the chord between its neighbours, as a share of the chord, within which it is taken for
/// a point between them.
const ASIDE: f64 = 0.2;

impl<F: Family> Follower<'_, F> {
    /// The point between two neighbours at which `test` changes its sign.
    ///
    /// # Errors
    /// [`OrbitError`] if a correction fails.
    pub fn locate(
        &self,
        from: &BranchPoint,
        to: &BranchPoint,
        test: impl Fn(&BranchPoint) -> f64,
    ) -> Result<BranchPoint, OrbitError> {
        self.clearly(from, to, |follower, ends| {
            follower.locate_between(ends, &test)
        })
    }

    /// The point between two neighbours at which a test of the monodromy matrix vanishes.
    ///
    /// # Errors
    /// [`OrbitError`] if a correction fails.
    pub fn critical_between(
        &self,
        from: &BranchPoint,
        to: &BranchPoint,
        test: Test,
    ) -> Result<BranchPoint, OrbitError> {
        self.clearly(from, to, |follower, ends| follower.zero_between(ends, test))
    }

    /// What is found between two neighbours, seen at a drive angle with no crossing near.
    fn clearly(
        &self,
        from: &BranchPoint,
        to: &BranchPoint,
        find: impl Fn(&Self, (&Node<Round>, &Node<Round>)) -> Result<BranchPoint, OrbitError>,
    ) -> Result<BranchPoint, OrbitError> {
        let ends = (self.node_at(from)?, self.node_at(to)?);
        match self.clear_of(&ends.0).or_else(|| self.clear_of(&ends.1)) {
            None => find(self, (&ends.0, &ends.1)),
            Some(clear) => find(&clear, (&clear.node_at(from)?, &clear.node_at(to)?)),
        }
    }

    fn zero_between(
        &self,
        ends: (&Node<Round>, &Node<Round>),
        test: Test,
    ) -> Result<BranchPoint, OrbitError> {
        let value = |round: &Round| test.value(&round.monodromy);
        let node = zero(&self.shooting, ends, WIDTH, value).or_else(|_| {
            let value = |node: &Node<Round>| value(&node.here.point);
            locate(&self.shooting, ends, WIDTH, value).map(|(node, _)| node)
        })?;
        self.point_at(&node)
    }

    fn locate_between(
        &self,
        ends: (&Node<Round>, &Node<Round>),
        test: impl Fn(&BranchPoint) -> f64,
    ) -> Result<BranchPoint, OrbitError> {
        let value = |node: &Node<Round>| self.point_at(node).map_or(f64::NAN, |point| test(&point));
        let (node, _) = locate(&self.shooting, ends, WIDTH, value)?;
        self.point_at(&node)
    }

    /// The point between two neighbours at a value of the parameter between theirs.
    ///
    /// # Errors
    /// [`OrbitError`] if a correction fails.
    pub fn between(
        &self,
        from: &BranchPoint,
        to: &BranchPoint,
        parameter: f64,
    ) -> Result<BranchPoint, OrbitError> {
        let ends = [from, to].map(|end| self.shooting.scaled(end.state(), [end.parameter]));
        let way = &ends[1] - &ends[0];
        let share = (parameter - from.parameter) / (to.parameter - from.parameter);
        let state = from.state().lerp(&to.state(), share);
        if let Ok(node) = self.start(parameter, state) {
            let along = way.dot(&(&node.at - &ends[0])) / way.norm_squared();
            let off = &node.at - &ends[0] - along * &way;
            let point = self.point_at(&node)?;
            let same_side = from.fold_test().signum() * point.fold_test().signum() > 0.0;
            if same_side && (0.0..=1.0).contains(&along) && off.norm() < ASIDE * way.norm() {
                return Ok(point);
            }
        }
        self.locate(from, to, |point| point.parameter - parameter)
    }
}
