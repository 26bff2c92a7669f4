//! The power law of contact, F = k d^n max(0, 1 + lambda v) (Hertz 1882; Hunt and Crossley 1975).

/// Contact force k d^n max(0, 1 + lambda d') from a face on, the position where contact begins; d is the deflection beyond it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PowerLaw {
    /// Stiffness k in N/m^n.
    pub stiffness: f64,
    /// Exponent n >= 1.
    pub exponent: f64,
    /// Dissipation lambda in s/m.
    pub dissipation: f64,
    /// Position of the face in m.
    pub origin: f64,
    /// 1 if it presses downwards, as a stop above does, -1 if upwards.
    pub side: f64,
    /// The mass that it acts upon, in kg.
    pub mass: f64,
}

/// No power law at all.
impl Default for PowerLaw {
    fn default() -> Self {
        Self {
            stiffness: 0.0,
            exponent: 1.0,
            dissipation: 0.0,
            origin: 0.0,
            side: 1.0,
            mass: 1.0,
        }
    }
}

impl PowerLaw {
    /// Deflection in m of the power law, negative before the face.
    pub fn deflection(&self, position: f64) -> f64 {
        self.side * (position - self.origin)
    }

    /// This power law seen on a side: 1 as it is, -1 with positions counted the other way.
    pub(crate) fn on_side(self, side: f64) -> Self {
        Self {
            origin: side * self.origin,
            side: side * self.side,
            ..self
        }
    }

    /// The factor 1 + lambda d' of the power law's contact force, not below zero, at a velocity.
    pub(crate) fn dissipation_factor(&self, velocity: f64) -> f64 {
        (1.0 + self.dissipation * (self.side * velocity)).max(0.0)
    }

    /// Contact force in N of the power law against the direction of the position.
    pub fn force(&self, position: f64, velocity: f64) -> f64 {
        let depth = self.deflection(position).max(0.0);
        let force = self.stiffness * depth.powf(self.exponent) * self.dissipation_factor(velocity);
        self.side * force
    }

    /// Elastic energy in J of the power law's contact, k d^(n+1) / (n+1).
    pub fn energy(&self, position: f64) -> f64 {
        let depth = self.deflection(position).max(0.0);
        let raised = self.exponent + 1.0;
        self.stiffness * depth.powf(raised) / raised
    }

    /// d(force)/d(position) in N/m and d(force)/d(velocity) in N s/m of the power law while it presses.
    pub fn force_derivatives(&self, position: f64, velocity: f64) -> (f64, f64) {
        let depth = self.deflection(position).max(0.0);
        let grip = self.dissipation_factor(velocity);
        let steepness = self.stiffness * self.exponent * depth.powf(self.exponent - 1.0);
        let damping = self.stiffness * depth.powf(self.exponent) * self.dissipation;
        (steepness * grip, damping)
    }

    /// d2(force)/d(position)2 in N/m^2 and d2(force)/d(position)d(velocity) in N s/m^2 while it presses;
    /// zero at the face, where they may not exist.
    pub fn curvatures(&self, position: f64, velocity: f64) -> (f64, f64) {
        let (depth, n) = (self.deflection(position), self.exponent);
        let grip = self.dissipation_factor(velocity);
        if depth <= 0.0 || grip <= 0.0 {
            return (0.0, 0.0);
        }
        let stiffness = self.stiffness * n * (n - 1.0) * depth.powf(n - 2.0) * grip;
        let coupling = self.stiffness * n * depth.powf(n - 1.0) * self.dissipation;
        (self.side * stiffness, self.side * coupling)
    }

    /// The least m >= 2 for which the power law, written in the m-th root of the deflection, has whole powers: it is
    /// then regular at the face in regularised time.
    pub(super) fn root_index(&self) -> Option<f64> {
        let is_whole = |m: &f64| (m * self.exponent).fract() == 0.0;
        [2.0, 3.0, 4.0, 5.0].into_iter().find(is_whole)
    }

    /// The factor kappa of d^n (1 + lambda v) in the power law's contact force per mass.
    pub(super) fn factor(&self) -> f64 {
        self.stiffness / self.mass
    }
}
