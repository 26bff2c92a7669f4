//! The tests of what the programs share, as one program.

mod schema;
mod twins;
