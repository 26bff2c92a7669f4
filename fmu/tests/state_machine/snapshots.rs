//! Calls on snapshots and their bytes.

use std::ffi::{c_char, c_void};
use std::ptr;

use softstop_fmi2::*;

use super::calls::{Call, Damage, Null};
use super::model::Expected;
use super::world::{Kept, World};
use crate::common::OK;

fn expected(conditions: &[bool]) -> Expected {
    if conditions.iter().all(|holds| *holds) {
        Expected::Ok
    } else {
        Expected::Refused
    }
}

/// The bytes of a snapshot; none if there is no snapshot.
fn bytes_of(component: *mut c_void, state: *mut c_void) -> Vec<u8> {
    let mut size = 0;
    if component.is_null() || state.is_null() {
        return Vec::new();
    }
    // SAFETY: both are alive, and the array is as long as was asked for.
    unsafe {
        assert_eq!(
            fmi2SerializedFMUstateSize(component, state, &raw mut size),
            OK
        );
        let mut bytes = vec![0xAA; size];
        let room = bytes.as_mut_ptr().cast::<c_char>();
        assert_eq!(fmi2SerializeFMUstate(component, state, room, size), OK);
        bytes
    }
}

fn damaged(mut bytes: Vec<u8>, damage: Damage) -> Vec<u8> {
    match damage {
        Damage::ZerosBehind => bytes.extend([0; 13]),
        Damage::Behind => bytes.extend([0, 0, 3]),
        Damage::Cut(at) => bytes.truncate(at % bytes.len().max(1)),
        Damage::Bit(at) if !bytes.is_empty() => {
            let length = bytes.len();
            bytes[at / 8 % length] ^= 1 << (at % 8);
        }
        Damage::Empty => bytes.clear(),
        _ => {}
    }
    bytes
}

impl World {
    fn state(&self, index: usize) -> *mut c_void {
        self.states[index]
            .as_ref()
            .map_or(ptr::null_mut(), |kept| kept.state)
    }

    pub fn run_on_state(&mut self, index: usize, call: &Call) {
        match call {
            Call::GetState(state, null) => self.get_state(index, call, *state, *null),
            Call::SetState(state) => self.set_state(index, call, *state),
            Call::FreeState(state, null) => self.free_state(index, call, *state, *null),
            Call::SerializedSize(state, null) => {
                let (state, mut size) = (self.state(*state), 0);
                let place = if *null == Null::First {
                    ptr::null_mut()
                } else {
                    &raw mut size
                };
                let wanted = expected(&[!state.is_null(), !place.is_null()]);
                self.judged(index, call, wanted, |component| unsafe {
                    fmi2SerializedFMUstateSize(component, state, place)
                });
            }
            Call::Serialize(state, more, null) => self.serialize(index, call, *state, *more, *null),
            Call::DeSerialize(state, damage) => self.deserialize(index, call, *state, *damage),
            other => unreachable!("{other:?} has no snapshot"),
        }
    }

    fn get_state(&mut self, index: usize, call: &Call, number: usize, null: Null) {
        let before = self.state(number);
        let mut state = before;
        let place = if null == Null::First {
            ptr::null_mut()
        } else {
            &raw mut state
        };
        let done = self.judged(
            index,
            call,
            expected(&[!place.is_null()]),
            |component| unsafe { fmi2GetFMUstate(component, place) },
        );
        if !done {
            return;
        }
        assert!(
            before.is_null() || before == state,
            "{call:?}: a snapshot was lost"
        );
        let slot = self.units[index].as_ref().expect("an instance");
        let mut shadow = self.states[number]
            .as_ref()
            .map_or(ptr::null_mut(), |kept| kept.shadow);
        // SAFETY: the shadow is alive; its snapshot is NULL or alive.
        assert_eq!(unsafe { fmi2GetFMUstate(slot.shadow, &raw mut shadow) }, OK);
        self.states[number] = Some(Kept {
            state,
            shadow,
            model: slot.model.clone(),
            unsettled: slot.unsettled,
        });
    }

    fn set_state(&mut self, index: usize, call: &Call, number: usize) {
        let state = self.state(number);
        let done = self.judged(
            index,
            call,
            expected(&[!state.is_null()]),
            |component| unsafe { fmi2SetFMUstate(component, state) },
        );
        if !done {
            return;
        }
        let slot = self.units[index].as_mut().expect("an instance");
        let kept = self.states[number].as_ref().expect("a snapshot");
        // SAFETY: both are alive.
        assert_eq!(unsafe { fmi2SetFMUstate(slot.shadow, kept.shadow) }, OK);
        slot.model = kept.model.clone();
        slot.unsettled = kept.unsettled;
    }

    fn free_state(&mut self, index: usize, call: &Call, number: usize, null: Null) {
        let mut state = self.state(number);
        let place = if null == Null::First {
            ptr::null_mut()
        } else {
            &raw mut state
        };
        let done = self.judged(index, call, Expected::Ok, |component| unsafe {
            fmi2FreeFMUstate(component, place)
        });
        if !done || place.is_null() {
            return;
        }
        assert!(state.is_null());
        let shadow = self.units[index].as_ref().expect("an instance").shadow;
        if let Some(mut kept) = self.states[number].take() {
            // SAFETY: the shadow's snapshot is freed once.
            assert_eq!(
                unsafe { fmi2FreeFMUstate(shadow, &raw mut kept.shadow) },
                OK
            );
        }
    }

    fn serialize(&mut self, index: usize, call: &Call, number: usize, more: isize, null: Null) {
        let state = self.state(number);
        let needed = bytes_of(self.component(index), state).len();
        let size = needed.saturating_add_signed(more);
        let mut bytes = vec![0xAAu8; size];
        let room = if null == Null::First {
            ptr::null_mut()
        } else {
            bytes.as_mut_ptr()
        };
        let wanted = expected(&[!state.is_null(), size >= needed, !room.is_null()]);
        let done = self.judged(index, call, wanted, |component| unsafe {
            fmi2SerializeFMUstate(component, state, room.cast(), size)
        });
        assert!(!done || bytes[needed..].iter().all(|byte| *byte == 0));
        let untouched = done || bytes.iter().all(|byte| *byte == 0xAA);
        assert!(untouched, "{call:?} was refused and wrote");
    }

    fn deserialize(&mut self, index: usize, call: &Call, number: usize, damage: Damage) {
        let old = self.state(number);
        let bytes = damaged(bytes_of(self.component(index), old), damage);
        let from = if matches!(damage, Damage::NullBytes) {
            ptr::null()
        } else {
            bytes.as_ptr()
        };
        let mut state = ptr::dangling_mut::<u64>().cast::<c_void>();
        let before = state;
        let place = if matches!(damage, Damage::NullState) {
            ptr::null_mut()
        } else {
            &raw mut state
        };
        let whole = matches!(damage, Damage::Nothing | Damage::ZerosBehind);
        let wanted = expected(&[!old.is_null(), whole]);
        let done = self.judged(index, call, wanted, |component| unsafe {
            fmi2DeSerializeFMUstate(component, from.cast(), bytes.len(), place)
        });
        if !done {
            assert_eq!(state, before, "{call:?} was refused and wrote");
            return;
        }
        let component = self.component(index);
        assert!(
            bytes.starts_with(&bytes_of(component, state)),
            "other bytes on the way back"
        );
        let kept = self.states[number].as_mut().expect("a snapshot");
        // SAFETY: the old snapshot is freed once, the new one takes its place.
        assert_eq!(
            unsafe { fmi2FreeFMUstate(component, &raw mut kept.state) },
            OK
        );
        kept.state = state;
    }
}
