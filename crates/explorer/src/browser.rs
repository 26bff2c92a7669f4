//! The functions that a browser calls: `question` makes room for a question of so many bytes, `answer` answers the one
//! that has been written there; text and numbers of the answer stay in place until the next one.
#![expect(unsafe_code, reason = "functions are exported by their names")]

use std::cell::RefCell;

use crate::{Answer, answer as answer_of};

thread_local! {
    static QUESTION: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static ANSWER: RefCell<Answer> = const { RefCell::new(Answer { text: String::new(), numbers: Vec::new() }) };
}

#[unsafe(no_mangle)]
extern "C" fn question(length: usize) -> *mut u8 {
    QUESTION.with_borrow_mut(|question| {
        question.resize(length, 0);
        question.as_mut_ptr()
    })
}

#[unsafe(no_mangle)]
extern "C" fn answer() {
    let question = QUESTION.take();
    ANSWER.set(answer_of(&String::from_utf8_lossy(&question)));
}

#[unsafe(no_mangle)]
extern "C" fn text() -> *const u8 {
    ANSWER.with_borrow(|answer| answer.text.as_ptr())
}

#[unsafe(no_mangle)]
extern "C" fn text_length() -> usize {
    ANSWER.with_borrow(|answer| answer.text.len())
}

#[unsafe(no_mangle)]
extern "C" fn numbers() -> *const f64 {
    ANSWER.with_borrow(|answer| answer.numbers.as_ptr())
}

#[unsafe(no_mangle)]
extern "C" fn numbers_length() -> usize {
    ANSWER.with_borrow(|answer| answer.numbers.len())
}
