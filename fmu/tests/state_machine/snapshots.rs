//! Calls on snapshots and their bytes.

use std::ffi::c_void;
use std::ptr;

use softstop_fmi2::*;

use super::calls::{Call, Damage, Null};
use super::world::{Kept, World};
use crate::common::{OK, call, if_all};

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
    fn state(&self, number: usize) -> *mut c_void {
        let kept = self.states[number].as_ref();
        kept.map_or(ptr::null_mut(), |kept| kept.state)
    }

    /// The bytes of a snapshot; none if there is no snapshot, or no instance to ask.
    fn bytes_of(&mut self, index: usize, state: *mut c_void) -> Vec<u8> {
        let slot = self.slot(index).filter(|_| !state.is_null());
        slot.map_or_else(Vec::new, |slot| slot.unit.bytes_of(state))
    }

    pub fn run_on_state(&mut self, index: usize, call: &Call) {
        match *call {
            Call::GetState(number, null) => self.get_state(index, call, number, null),
            Call::SetState(number) => self.set_state(index, call, number),
            Call::FreeState(number, null) => self.free_state(index, call, number, null),
            Call::SerializedSize(number, null) => {
                let (state, mut size) = (self.state(number), 0);
                let place = null.first(&raw mut size).cast_mut();
                let expected = if_all(&[!state.is_null(), !place.is_null()]);
                self.judged(index, call, expected, |component| unsafe {
                    call!(fmi2SerializedFMUstateSize(component, state, place))
                });
            }
            Call::Serialize(number, more, null) => self.serialize(index, call, number, more, null),
            Call::DeSerialize(number, damage) => self.deserialize(index, call, number, damage),
            _ => unreachable!("{call:?} has no snapshot"),
        }
    }

    fn get_state(&mut self, index: usize, call: &Call, number: usize, null: Null) {
        let before = self.state(number);
        let mut state = before;
        let place = null.first(&raw mut state).cast_mut();
        let expected = if_all(&[!place.is_null()]);
        let done = self.judged(index, call, expected, |component| unsafe {
            call!(fmi2GetFMUstate(component, place))
        });
        if !done {
            return;
        }
        let is_lost = !before.is_null() && before != state;
        assert!(!is_lost, "{call:?}: a snapshot was lost");
        let kept = self.states[number].as_ref();
        let mut shadow = kept.map_or(ptr::null_mut(), |kept| kept.shadow);
        let slot = self.slot(index).expect("an instance");
        // SAFETY: the shadow is alive; its snapshot is NULL or alive.
        let status = unsafe { fmi2GetFMUstate(slot.shadow.component, &raw mut shadow) };
        assert_eq!(status, OK);
        self.states[number] = Some(Kept {
            state,
            shadow,
            model: slot.model.clone(),
            unsettled: slot.unsettled,
        });
    }

    fn set_state(&mut self, index: usize, call: &Call, number: usize) {
        let state = self.state(number);
        let expected = if_all(&[!state.is_null()]);
        let done = self.judged(index, call, expected, |component| unsafe {
            call!(fmi2SetFMUstate(component, state))
        });
        if let (true, Some(kept)) = (done, &self.states[number]) {
            let slot = self.units[index].as_mut().expect("an instance");
            // SAFETY: both are alive.
            let status = unsafe { fmi2SetFMUstate(slot.shadow.component, kept.shadow) };
            assert_eq!(status, OK);
            (slot.model, slot.unsettled) = (kept.model.clone(), kept.unsettled);
        }
    }

    fn free_state(&mut self, index: usize, call: &Call, number: usize, null: Null) {
        let mut state = self.state(number);
        let place = null.first(&raw mut state).cast_mut();
        let done = self.judged(index, call, &[OK], |component| unsafe {
            call!(fmi2FreeFMUstate(component, place))
        });
        if done && !place.is_null() {
            assert!(state.is_null());
            if let Some(kept) = self.states[number].take() {
                self.slot(index)
                    .expect("an instance")
                    .shadow
                    .free(kept.shadow);
            }
        }
    }

    fn serialize(&mut self, index: usize, call: &Call, number: usize, more: isize, null: Null) {
        let state = self.state(number);
        let needed = self.bytes_of(index, state).len();
        let size = needed.saturating_add_signed(more);
        let mut bytes = vec![0xAAu8; size];
        let room = null.first(bytes.as_mut_ptr()).cast_mut();
        let expected = if_all(&[!state.is_null(), size >= needed, !room.is_null()]);
        let done = self.judged(index, call, expected, |component| unsafe {
            call!(fmi2SerializeFMUstate(component, state, room.cast(), size))
        });
        assert!(!done || bytes[needed..].iter().all(|byte| *byte == 0));
        let is_untouched = done || bytes.iter().all(|byte| *byte == 0xAA);
        assert!(is_untouched, "{call:?} was refused and wrote");
    }

    fn deserialize(&mut self, index: usize, call: &Call, number: usize, damage: Damage) {
        let old = self.state(number);
        let (bytes, mut from) = (damaged(self.bytes_of(index, old), damage), ptr::null());
        if !matches!(damage, Damage::NullBytes) {
            from = bytes.as_ptr();
        }
        let before = ptr::dangling_mut::<u64>().cast::<c_void>();
        let (mut state, mut place) = (before, ptr::null_mut());
        if !matches!(damage, Damage::NullState) {
            place = &raw mut state;
        }
        let is_whole = matches!(damage, Damage::Nothing | Damage::ZerosBehind);
        let expected = if_all(&[!old.is_null(), is_whole]);
        let done = self.judged(index, call, expected, |component| unsafe {
            call!(fmi2DeSerializeFMUstate(
                component,
                from.cast(),
                bytes.len(),
                place
            ))
        });
        if !done {
            assert_eq!(state, before, "{call:?} was refused and wrote");
            return;
        }
        let is_same = bytes.starts_with(&self.bytes_of(index, state));
        assert!(is_same, "other bytes on the way back");
        self.slot(index).expect("an instance").unit.free(old);
        self.states[number].as_mut().expect("a snapshot").state = state;
    }
}
