//! How much work an advance may cost.

/// Work left before a motion stops on its way, counted in scan windows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Effort(u64);

/// Windows that are scanned between two looks at the effort left.
pub(super) const CHUNK: u32 = 1 << 20;
/// What a crossing costs, in windows.
pub(super) const CROSSING: u64 = 16;
/// What a Taylor step costs, in windows.
pub(super) const TAYLOR_STEP: u64 = 128;

impl Effort {
    /// As much as it takes.
    pub const ENDLESS: Self = Self(u64::MAX);

    /// About as much as scanning this many windows of time costs. A window is the reciprocal of the
    /// fastest of drive and free motion; a crossing costs as much as 16 of them, a Taylor step as
    /// much as 128.
    pub const fn windows(windows: u64) -> Self {
        Self(windows)
    }

    pub(super) fn spend(&mut self, windows: u64) {
        self.0 = self.0.saturating_sub(windows);
    }

    pub(super) fn is_spent(self) -> bool {
        self.0 == 0
    }
}
