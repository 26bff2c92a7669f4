//! A mass without velocity: Filippov's rules for dry friction and for faces where the force jumps.

use super::number::{Real, is_negative, size};
use super::walk::Walk;

/// What a mass without velocity does.
pub enum Rest {
    /// It only turns.
    Free,
    /// It leaves at once, onwards or back, into a layer.
    Leaves(bool, usize),
    /// It is held until a time in s at which its forces are in balance, and then leaves so.
    Held(Real, bool, usize),
}

/// A layer into which a mass on a surface or under friction may go, and the push per mass that balances it there.
type Side = (usize, Real);

impl Walk {
    /// What the mass does from its place without velocity.
    pub fn rest(&self) -> Rest {
        let (ahead, (below, least), smooth) = self.sides();
        if smooth {
            return Rest::Free;
        }
        let push = self.machine.drive.at(&self.state.time);
        if let Some((layer, most)) = &ahead
            && push > *most
        {
            return Rest::Leaves(true, *layer);
        }
        if push < least {
            return Rest::Leaves(false, below);
        }
        self.hold(ahead, (below, least))
    }

    fn hold(&self, ahead: Option<Side>, behind: Side) -> Rest {
        let time = &self.state.time;
        let back = self.passes(&behind.1, false);
        let on = ahead.and_then(|(layer, most)| Some((layer, self.passes(&most, true)?)));
        match (on, back) {
            (Some((layer, on)), back) if back.as_ref().is_none_or(|back| on < *back) => {
                Rest::Held(time + on, true, layer)
            }
            (_, Some(back)) => Rest::Held(time + back, false, behind.0),
            _ => Rest::Held(self.end.clone(), true, self.layer),
        }
    }

    /// Time in s until the push rises above, or falls below, a level; none if it never does.
    fn passes(&self, level: &Real, rising: bool) -> Option<Real> {
        let drive = &self.machine.drive;
        if size(level) >= drive.amplitude {
            return None;
        }
        let opening = (level / &drive.amplitude).acos();
        let at = if rising { -opening } else { opening };
        let turn = self.digits.turn();
        let ahead = at - (&drive.frequency * &self.state.time + &drive.phase);
        let turns = (&ahead / &turn).floor();
        Some((ahead - turns * turn) / &drive.frequency)
    }

    /// Ahead and behind, and whether there is no jump of the force.
    fn sides(&self) -> (Option<Side>, Side, bool) {
        let layers = &self.machine.layers;
        let layer = &layers[self.layer];
        let at = |end: &Option<Real>| end.as_ref() == Some(&self.state.position);
        let upper = self.layer + usize::from(at(&layer.to));
        let lower = self.layer - usize::from(at(&layer.from));
        let ahead = (upper < layers.len()).then(|| (upper, self.balance(upper, true)));
        let behind = (lower, self.balance(lower, false));
        (ahead, behind, upper == lower && !layer.rubs())
    }

    /// The push per mass that holds the mass at rest in a layer.
    fn balance(&self, index: usize, forward: bool) -> Real {
        let layer = &self.machine.layers[index];
        let law = layer.law(forward);
        &law.stiffness * &self.state.position - &law.force
    }

    /// The least acceleration with which both sides press the mass onto its place; none if one does not.
    pub fn pressed(&self) -> Option<Real> {
        let (ahead, behind, _) = self.sides();
        let push = self.machine.drive.at(&self.state.time);
        let back = &push - behind.1;
        let on = ahead.map_or_else(|| back.clone(), |(_, most)| most - &push);
        let least = if on < back { on } else { back };
        (!is_negative(&least)).then_some(least)
    }

    /// A bounce shorter than twice this time, in s, is none: 2^-64 of a drive period.
    pub fn briefest(&self) -> Real {
        (self.digits.turn() / &self.machine.drive.frequency) >> 64isize
    }
}
