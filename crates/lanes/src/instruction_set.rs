//! Chooses the instruction set of this processor, tells its registers, and runs the engine with it.

use pulp::{Simd, WithSimd};

use super::batch_observer::{BatchObserver, ObserverHandle};
use super::engine::Engine;
use super::job::{Job, Outcome, Task};
use super::lanes::Lanes;
use super::lowered_machine::LoweredMachine;

/// Number of vector registers over which the lanes of one batch are spread: while one waits, the other goes on.
pub(super) const REGISTERS_PER_BATCH: usize = 2;

/// Which instruction set the lanes may use at most.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InstructionLimit {
    /// The widest that the processor has.
    Widest,
    /// At most 256-bit registers.
    Avx2,
    /// No vector instructions but those that every processor of its kind has.
    Portable,
}

/// The vector registers that hold the lanes: the name of their instruction set and how many motions go at once.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Registers {
    /// The instruction set's name.
    pub name: &'static str,
    /// Motions that go in lock-step.
    pub lanes: usize,
}

impl InstructionLimit {
    /// The registers that this processor uses within this limit.
    pub fn registers(self) -> Registers {
        dispatch(MeasureRegisters, self)
    }
}

struct MeasureRegisters;

impl WithSimd for MeasureRegisters {
    type Output = Registers;

    fn with_simd<S: Simd>(self, _: S) -> Registers {
        let name = match S::F64_LANES {
            8 => "AVX-512",
            4 => "AVX2",
            2 if cfg!(target_arch = "aarch64") => "NEON",
            2 => "128 bits",
            _ => "portable",
        };
        Registers {
            name,
            lanes: Lanes::<S, REGISTERS_PER_BATCH>::COUNT,
        }
    }
}

/// Runs a task by the instruction set asked for, or the widest below it that the processor has, with lanes in
/// [`REGISTERS_PER_BATCH`] registers.
pub(super) fn run_task(task: Task, instructions: InstructionLimit) -> Vec<Outcome> {
    dispatch(Batch::<REGISTERS_PER_BATCH>(task), instructions)
}

/// Runs a task with an instruction set, or the widest below it that the processor has. Each set is the whole engine once more, so
/// none is compiled twice.
fn dispatch<T: WithSimd>(task: T, instructions: InstructionLimit) -> T::Output {
    vectorize(task, instructions).unwrap_or_else(|task| Simd::vectorize(pulp::Scalar, task))
}

/// Runs a task with vector instructions, or gives it back where only the portable instructions are left.
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
fn vectorize<T: WithSimd>(task: T, instructions: InstructionLimit) -> Result<T::Output, T> {
    use pulp::x86::{V3, V4};

    let wide = match instructions {
        InstructionLimit::Widest => V4::try_new(),
        _ => None,
    };
    let narrow = match instructions {
        InstructionLimit::Portable => None,
        _ => V3::try_new(),
    };
    match (wide, narrow) {
        (Some(simd), _) => Ok(Simd::vectorize(simd, task)),
        (None, Some(simd)) => Ok(Simd::vectorize(simd, task)),
        (None, None) => Err(task),
    }
}

#[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
fn vectorize<T: WithSimd>(task: T, instructions: InstructionLimit) -> Result<T::Output, T> {
    match instructions {
        InstructionLimit::Widest => Ok(pulp::Arch::new().dispatch(task)),
        _ => Err(task),
    }
}

/// Follows jobs one after another, in a single register where registers are wide. It is generic so that the engine for one
/// register is compiled where it is called.
pub(super) fn run_one_by_one<W: BatchObserver>(
    machines: &[LoweredMachine],
    jobs: &[Job],
    watch: &mut W,
) -> Vec<Outcome> {
    let task = Task {
        machines,
        jobs,
        watch: ObserverHandle::new(watch, 0),
        at_once: 1,
    };
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    if let Some(simd) = pulp::x86::V3::try_new() {
        return Simd::vectorize(simd, Batch::<1>(task));
    }
    run_task(task, InstructionLimit::Portable)
}

/// A task to run with lanes in N registers.
struct Batch<'a, const N: usize>(Task<'a>);

impl<const N: usize> WithSimd for Batch<'_, N> {
    type Output = Vec<Outcome>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        Engine::<S, N>::new(simd, self.0).run_jobs()
    }
}
