//! A mass without velocity: Filippov's rules for dry friction and for faces where the force jumps.

use super::machine::Law;
use super::number::{Real, is_negative, size};
use super::place::Place;

/// What a mass without velocity does.
pub enum Rest {
    /// It only turns.
    Free,
    /// It leaves at once.
    Leaves {
        /// Onwards.
        forward: bool,
        /// Into this layer.
        layer: usize,
    },
    /// It is held.
    Held {
        /// Until this time in s, at which its forces are in balance.
        until: Real,
        /// It then leaves onwards.
        forward: bool,
        /// Into this layer.
        layer: usize,
    },
}

/// Where a mass on a surface or under friction may go: the layers ahead and behind, each with the push per mass
/// that balances it there.
struct Sides {
    ahead: Option<(usize, Real)>,
    behind: (usize, Real),
    /// There is no jump of the force.
    smooth: bool,
}

impl Place {
    /// What the mass does from its place without velocity.
    pub(super) fn rest(&self) -> Rest {
        let Sides {
            ahead,
            behind: (below, least),
            smooth,
        } = self.sides();
        if smooth {
            return Rest::Free;
        }
        let push = self.machine.drive.at(&self.state.time);
        if let Some((layer, most)) = &ahead
            && push > *most
        {
            let (forward, layer) = (true, *layer);
            return Rest::Leaves { forward, layer };
        }
        if push < least {
            let (forward, layer) = (false, below);
            return Rest::Leaves { forward, layer };
        }
        self.hold(ahead, (below, least))
    }

    fn hold(&self, ahead: Option<(usize, Real)>, behind: (usize, Real)) -> Rest {
        let time = &self.state.time;
        let back = self.passes(&behind.1, false);
        let on = ahead.and_then(|(layer, most)| Some((layer, self.passes(&most, true)?)));
        let until = |wait: Real| time + wait;
        match (on, back) {
            (Some((layer, on)), back) if back.as_ref().is_none_or(|back| on < *back) => {
                Rest::Held {
                    until: until(on),
                    forward: true,
                    layer,
                }
            }
            (_, Some(back)) => Rest::Held {
                until: until(back),
                forward: false,
                layer: behind.0,
            },
            _ => Rest::Held {
                until: self.end.clone(),
                forward: true,
                layer: self.layer,
            },
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

    fn sides(&self) -> Sides {
        let layers = &self.machine.layers;
        let layer = &layers[self.layer];
        let at = |end: &Option<Real>| end.as_ref() == Some(&self.state.position);
        let upper = self.layer + usize::from(at(&layer.to));
        let lower = self.layer - usize::from(at(&layer.from));
        let ahead = (upper < layers.len()).then(|| (upper, self.balance(upper, true)));
        Sides {
            ahead,
            behind: (lower, self.balance(lower, false)),
            smooth: upper == lower && !layer.rubs(),
        }
    }

    /// The push per mass that holds the mass at rest in a layer.
    fn balance(&self, index: usize, forward: bool) -> Real {
        let layer = &self.machine.layers[index];
        let law: &Law = if forward {
            &layer.forward
        } else {
            &layer.backward
        };
        &law.stiffness * &self.state.position - &law.force
    }

    /// The least acceleration with which both sides press the mass onto its place; none if one does not.
    pub(super) fn pressed(&self) -> Option<Real> {
        let Sides { ahead, behind, .. } = self.sides();
        let push = self.machine.drive.at(&self.state.time);
        let back = &push - behind.1;
        let on = ahead.map_or_else(|| back.clone(), |(_, most)| most - &push);
        let least = if on < back { on } else { back };
        (!is_negative(&least)).then_some(least)
    }

    /// A bounce shorter than twice this time, in s, is none: 2^-64 of a drive period.
    pub(super) fn briefest(&self) -> Real {
        (self.digits.turn() / &self.machine.drive.frequency) >> 64isize
    }
}
