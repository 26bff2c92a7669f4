//! Basins of attraction: on which motion each of many initial states settles.
//!
//! The cells of a [`Grid`] lie on a plane of position, velocity and drive angle, any two of them. Each cell's motion is
//! first brought to drive angle phi, then followed in the lanes of the batch engine, a few drive periods at a time. It
//! has arrived once its state lies in a ball about a point of a known stable orbit in which the map contracts: in a
//! norm in which the orbit's own Jacobian does, the Jacobian at all of many points of the ball stays below 1, with the
//! orbit's number of impacts. What is not caught by any ball is looked at one by one: a state that returns is polished
//! by Newton's method and is a new motion; what does not is followed on if its exponents are negative, for as long as ten
//! digits take; what never returns belongs to one set, chaos.
//!
//! The result depends on scene, grid and options alone, not on the number of threads.
//!
//! ```
//! use softstop::Ratios;
//! use softstop_dynamics::basin::{Axis, Grid, BasinOptions, find_basins};
//! use softstop_dynamics::monitor::unmonitored;
//!
//! let scene = Ratios::unloaded().scene()?;
//! let grid = Grid::of_states(Axis::position(-20.0, 10.0, 30), Axis::velocity(-25.0, 25.0, 30), 0.0);
//! let basins = find_basins(&scene, &grid, &BasinOptions::default(), &unmonitored, None)?;
//! // Point A: without impacts, and z = 1.
//! let names: Vec<String> = basins.classes.iter().map(|class| class.motion.to_string()).collect();
//! assert_eq!(names, ["z = 0", "z = 1"]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod basin_entropy;
mod basin_survey;
mod basin_test;
mod basins;
mod basins_of_survey;
mod bring_to_section;
mod certainty;
mod classify_cells;
mod contraction_ball;
mod erosion_profile;
mod establishment;
mod global_continuation;
mod grid;
mod largest_ball;
mod settle_cells;
mod start_balls;

pub use crate::wilson_interval::wilson_interval;
pub use basin_entropy::BasinEntropy;
pub use basin_survey::find_basins;
pub(crate) use basin_test::TestedMotion;
pub use basin_test::{BasinTest, SLOW_DECAY};
pub use basins::{BasinOptions, Basins};
pub(crate) use bring_to_section::bring_to_section;
pub use certainty::{CertaintyAtPlace, establishing_certainties};
pub use erosion_profile::{ErosionProfile, Integrity, zone_box};
pub use establishment::Establishment;
pub use global_continuation::{BasinsAt, follow_attractors};
pub use grid::{Axis, AxisQuantity, Grid};
pub use largest_ball::{BasinBall, find_largest_ball};
