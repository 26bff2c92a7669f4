//! The fixed-step schemes: their names, parameters and orders.

/// A one-step scheme for m x'' = f(t, x, x').
///
/// To add one, give it a name and an order here, a step in `step.rs` and its amplification matrix in
/// `stability.rs`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scheme {
    /// x+ = x + h v, v+ = v + h a (Euler 1768).
    ExplicitEuler,
    /// v+ = v + h a, x+ = x + h v+: symplectic without damping (de Vogelaere 1956).
    SemiImplicitEuler,
    /// The classical one of four stages (Kutta 1901).
    RungeKutta4,
    /// v+ = v + h a at the mean of both states: the Gauss method of one stage.
    ImplicitMidpoint,
    /// x+ = x + h v + h^2 ((1/2 - beta) a + beta a+), v+ = v + h ((1 - gamma) a + gamma a+) (Newmark 1959).
    Newmark {
        /// Share of the new acceleration in the position, 0 <= beta <= 1; 1/4 is the average acceleration.
        beta: f64,
        /// Share of the new acceleration in the velocity, 0 <= gamma <= 1; the order is 2 for 1/2 alone.
        gamma: f64,
    },
    /// The generalised-alpha method (Chung and Hulbert 1993).
    GeneralisedAlpha {
        /// Spectral radius at infinite frequency, in [0, 1]: 1 damps nothing, 0 removes what it does
        /// not resolve in one step.
        rho_inf: f64,
    },
}

/// x+ = x + h v + h^2 ((1/2 - beta) a + beta a+), v+ = v + h ((1 - gamma) a + gamma a+), with the equation of
/// motion at weighted means of both ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Alpha {
    /// Weight of the old acceleration in the equation of motion.
    pub inertia: f64,
    /// Weight of the old state in it.
    pub forces: f64,
    pub beta: f64,
    pub gamma: f64,
}

impl Scheme {
    /// Newmark's average acceleration, without numerical damping.
    pub const NEWMARK: Self = Self::Newmark {
        beta: 0.25,
        gamma: 0.5,
    };

    /// One of each kind, with the usual parameters.
    pub const ALL: [Self; 6] = [
        Self::ExplicitEuler,
        Self::SemiImplicitEuler,
        Self::RungeKutta4,
        Self::ImplicitMidpoint,
        Self::NEWMARK,
        Self::GeneralisedAlpha { rho_inf: 0.8 },
    ];

    /// Its name.
    pub fn name(&self) -> &'static str {
        match self {
            Self::ExplicitEuler => "explicit Euler",
            Self::SemiImplicitEuler => "semi-implicit Euler",
            Self::RungeKutta4 => "RK4",
            Self::ImplicitMidpoint => "implicit midpoint",
            Self::Newmark { .. } => "Newmark",
            Self::GeneralisedAlpha { .. } => "generalised-alpha",
        }
    }

    /// Its order on smooth motion: the error at the end goes as this power of the step.
    pub fn order(&self) -> u32 {
        match self {
            Self::ExplicitEuler | Self::SemiImplicitEuler => 1,
            Self::RungeKutta4 => 4,
            Self::Newmark { gamma, .. } if *gamma != 0.5 => 1,
            Self::ImplicitMidpoint | Self::Newmark { .. } | Self::GeneralisedAlpha { .. } => 2,
        }
    }

    /// Its parameters, if it is of the alpha family.
    pub(super) fn alpha(&self) -> Option<Alpha> {
        match *self {
            Self::Newmark { beta, gamma } => Some(Alpha {
                inertia: 0.0,
                forces: 0.0,
                beta,
                gamma,
            }),
            Self::GeneralisedAlpha { rho_inf } => Some(Alpha::chung_hulbert(rho_inf)),
            _ => None,
        }
    }

    /// The parameters that are not in [0, 1], by name.
    pub(super) fn out_of_range(&self) -> Option<(&'static str, f64)> {
        let parameters = match *self {
            Self::Newmark { beta, gamma } => vec![("beta", beta), ("gamma", gamma)],
            Self::GeneralisedAlpha { rho_inf } => vec![("rhoInf", rho_inf)],
            _ => Vec::new(),
        };
        let outside = |(_, value): &(_, f64)| !(0.0..=1.0).contains(value);
        parameters.into_iter().find(outside)
    }
}

impl Alpha {
    /// Of second order, with the least damping of low frequencies for a given one at infinite frequency
    /// (Chung and Hulbert 1993, eqs. 17, 18, 25).
    fn chung_hulbert(rho_inf: f64) -> Self {
        let inertia = (2.0 * rho_inf - 1.0) / (rho_inf + 1.0);
        let forces = rho_inf / (rho_inf + 1.0);
        let shift = forces - inertia;
        Self {
            inertia,
            forces,
            beta: 0.25 * (1.0 + shift) * (1.0 + shift),
            gamma: 0.5 + shift,
        }
    }
}
