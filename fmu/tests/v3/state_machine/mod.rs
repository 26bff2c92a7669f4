//! Random sequences of calls, right and wrong, against the state machine of the standard (FMI 3.0, 2.3 and 4.2.1): which
//! status each must have.

mod call;
mod model;
mod world;

use call::{call, life};
use proptest::collection::vec;
use proptest::prelude::*;
use world::World;

proptest! {
    #![proptest_config(softstop_testing::cases(1000))]

    #[test]
    fn all_calls_have_the_status_of_the_standard(
        lives in vec((0..5usize, life()), 1..4),
        rest in vec((0..5usize, call()), 0..60),
    ) {
        let mut world = World::new();
        for (index, calls) in lives {
            for call in calls {
                world.run(index, call);
            }
        }
        for (index, call) in rest {
            world.run(index, call);
        }
    }
}
