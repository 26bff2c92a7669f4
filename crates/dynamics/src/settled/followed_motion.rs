//! A motion that is followed until it settles.

use super::settled_motion::SettledMotion;
use crate::member::{HasMember, Member};
use softstop::{Scene, Start};

/// A motion that is followed until it settles, and what it was seen to have come to last.
pub(super) struct FollowedMotion<'a> {
    pub scene: &'a Scene,
    pub member: Member,
    pub seen: Option<SettledMotion>,
}

impl HasMember for FollowedMotion<'_> {
    fn member_mut(&mut self) -> &mut Member {
        &mut self.member
    }
}

impl<'a> FollowedMotion<'a> {
    /// A motion of a scene, which is the machine with this number, from a start.
    pub fn new(scene: &'a Scene, machine: usize, start: Start) -> Self {
        Self {
            scene,
            member: Member::new(machine, start),
            seen: None,
        }
    }
}
