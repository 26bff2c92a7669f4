//! Answers questions with the instructions of this processor: one on each line of standard input, with its numbers, as
//! JSON, on one line of standard output.

use std::io::stdin;

fn main() -> std::io::Result<()> {
    for question in stdin().lines() {
        let answer = softstop_explorer::answer(&question?);
        println!("[{}, {:?}]", answer.text, answer.numbers);
    }
    Ok(())
}
