//! Basins.
