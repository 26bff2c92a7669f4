//! Work along an arc: in closed form over long stretches, by a Gauss rule over short ones.

use nalgebra::Complex;

use super::arc_solution::{ArcSolution, Form};
use super::drive_angle::DriveAngle;
use super::gauss_quadrature::gauss_nodes;
use super::particular_solution::ParticularSolution;
use super::scan_nodes::ScanNode;
use super::series::{ZERO, integral_of_product, value};
use super::taylor_step::TaylorStep;

/// The energies that an arc takes up and loses, per unit of mass, in m^2/s^2: integrals of power over time.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct WorkIntegrals {
    /// Work of the forcing, without the law's own constant force.
    pub supplied: f64,
    /// Work lost in the phase's damper, the integral of 2 a v^2.
    pub lost: f64,
    /// Work that a power law takes by its own dissipation.
    pub pressed: f64,
}

impl ArcSolution {
    /// Work per mass from departure to a node; `law` is the part of the constant forcing that is the phase's own force.
    pub(crate) fn work_integrals(&self, to: &ScanNode, law: f64) -> WorkIntegrals {
        let elapsed = to.elapsed;
        match &self.form {
            Form::Held | Form::Chatter(_) => WorkIntegrals::default(),
            Form::TaylorStep(step) => step.work(elapsed, law),
            &Form::Particular {
                particular,
                deviation,
            } if elapsed > self.flow.reach => {
                let start = (deviation.x, deviation.y);
                self.work_in_closed_form(&particular, start, to, law)
            }
            _ => self.work_by_quadrature(elapsed, law),
        }
    }

    /// Work per mass by Gauss's rule in panels as wide as a Taylor polynomial reaches, wider by a quarter from one to
    /// the next while a fast mode dies out, up to a scan window.
    fn work_by_quadrature(&self, elapsed: f64, law: f64) -> WorkIntegrals {
        let (mut supplied, mut square) = (0.0, 0.0);
        let (mut start, mut width) = (0.0, self.flow.reach);
        while start < elapsed {
            let last = width >= elapsed - start;
            let nodes = gauss_nodes(if last { elapsed - start } else { width });
            let states = self.forcing_and_velocity(start, &nodes);
            for ((forcing, velocity), (_, weight)) in states.into_iter().zip(nodes) {
                supplied += weight * (forcing - law) * velocity;
                square += weight * velocity * velocity;
            }
            start = if last { elapsed } else { start + width };
            width = (1.25 * width).min(self.flow.window.max(self.flow.reach));
        }
        WorkIntegrals {
            supplied,
            lost: 2.0 * self.flow.modes.decay * square,
            pressed: 0.0,
        }
    }

    /// Forcing per mass and velocity at the nodes of a panel of the work quadrature that begins at `start`.
    fn forcing_and_velocity(&self, start: f64, nodes: &[(f64, f64); 8]) -> [(f64, f64); 8] {
        let node = if start == 0.0 {
            self.start_node()
        } else {
            self.node_at(start)
        };
        let widest = nodes[6].0.max(nodes[7].0);
        if widest <= self.flow.reach {
            return self
                .expand(&node)
                .forcing_and_velocity(nodes.map(|(s, _)| s));
        }
        nodes.map(|(s, _)| {
            let node = self.node_at(start + s);
            let (constant, ramp) = self.linear_forcing_at(0.0);
            let forcing = constant + ramp * node.elapsed + self.flow.amplitude * node.drive.cos;
            (forcing, node.velocity)
        })
    }

    /// Work in closed form. With v = y' + u, y the free deviation and u the rate of the particular solution, the
    /// integrals of y'^2 follow from the energy of y, those of y' e^(i angle) from its equation of motion, the rest is
    /// elementary.
    fn work_in_closed_form(
        &self,
        particular: &ParticularSolution,
        start: (f64, f64),
        to: &ScanNode,
        law: f64,
    ) -> WorkIntegrals {
        let (from, elapsed) = (self.start_node(), to.elapsed);
        let end = to.deviation;
        let cross = self.integral_of_free_velocity((start, from.drive), (end, to.drive));
        let waves = DriveIntegrals::between_nodes(self.flow.frequency, &from, to);
        let (a, b) = (self.flow.modes.decay, self.flow.modes.stiffness);
        let (w, slope) = (self.flow.frequency, particular.slope);
        let (cosine, sine) = (w * particular.sine, -w * particular.cosine);
        // u = slope + cosine cos + sine sin
        let drive_u = slope * waves.cos + cosine * waves.cos_cos + sine * waves.cos_sin;
        let steady = self.work_of_external_force(&from, to, law);
        let energy = |(y, rate): (f64, f64)| 0.5 * (rate * rate + b * y * y);
        let mixed = slope * (end.0 - start.0) + cosine * cross.re + sine * cross.im;
        let square_u = slope * (slope * elapsed + 2.0 * (cosine * waves.cos + sine * waves.sin))
            + cosine * cosine * waves.cos_cos
            + 2.0 * cosine * sine * waves.cos_sin
            + sine * sine * waves.sin_sin;
        WorkIntegrals {
            supplied: steady + self.flow.amplitude * (cross.re + drive_u),
            lost: energy(start) - energy(end) + 2.0 * a * (2.0 * mixed + square_u),
            pressed: 0.0,
        }
    }

    /// The work integral of y' e^(i angle) over time, y being the free deviation from the particular solution.
    ///
    /// y'' + 2 a y' + b y = 0 times e^(i angle), integrated by parts, gives (b - w^2 - 2 i a w) I = -[e y'] - (2 a - i
    /// w) [e y] for I, the integral of y e^(i angle), with e = e^(i angle) in the differences between the ends.
    fn integral_of_free_velocity(
        &self,
        (start, from): ((f64, f64), DriveAngle),
        (end, to): ((f64, f64), DriveAngle),
    ) -> Complex<f64> {
        let (a, b, w) = (
            self.flow.modes.decay,
            self.flow.modes.stiffness,
            self.flow.frequency,
        );
        let [from, to] = [from, to].map(|drive| Complex::new(drive.cos, drive.sin));
        let position = to * end.0 - from * start.0;
        let rate = to * end.1 - from * start.1;
        let denominator = Complex::new(b - w * w, -2.0 * a * w);
        let integral = -(rate + position * Complex::new(2.0 * a, -w)) / denominator;
        position - Complex::new(0.0, w) * integral
    }

    /// Work of the external force c + r t per mass: [(c + r t) x] - r times the integral of x, which follows from the
    /// integral of the equation of motion.
    fn work_of_external_force(&self, from: &ScanNode, to: &ScanNode, law: f64) -> f64 {
        let (constant, ramp) = self.linear_forcing_at(0.0);
        let elapsed = to.elapsed;
        let external = constant - law;
        let moved = external * (to.position - from.position);
        if ramp == 0.0 {
            return moved;
        }
        let waves = (to.drive.sin - from.drive.sin) / self.flow.frequency;
        let forcing = elapsed * (constant + 0.5 * ramp * elapsed) + self.flow.amplitude * waves;
        let change = to.velocity - from.velocity
            + 2.0 * self.flow.modes.decay * (to.position - from.position);
        let area = (forcing - change) / self.flow.modes.stiffness;
        moved + ramp * (elapsed * to.position - area)
    }
}

impl TaylorStep {
    /// Work per mass along this step up to `elapsed`; `law` is the part of the constant forcing that is the phase's own force.
    pub fn work(&self, elapsed: f64, law: f64) -> WorkIntegrals {
        let law = self.side() * law;
        if self.regularized.is_none() && !self.is_pressed {
            return self.work_in_time(elapsed, law);
        }
        let kappa = self.hertz.factor() * self.hertz.dissipation;
        let (velocities, rate) = (self.velocity_series(), self.time_rate_series());
        let power = if kappa > 0.0 { self.powers() } else { ZERO };
        let mut done = WorkIntegrals::default();
        for (sigma, weight) in gauss_nodes(self.sigma_after(elapsed)) {
            let velocity = value(&velocities, sigma);
            let travel = weight * value(&rate, sigma) * velocity;
            done.supplied += travel * (value(&self.forcing, sigma) - law);
            done.lost += travel * self.damping * velocity;
            if kappa > 0.0 {
                done.pressed += travel * kappa * value(&power, sigma) * velocity;
            }
        }
        done
    }

    /// Work per mass of a linear law along a step in time: the integrals of the polynomials themselves, whatever their degree.
    fn work_in_time(&self, elapsed: f64, law: f64) -> WorkIntegrals {
        let mut force = self.forcing;
        force[0] -= law;
        let velocity = self.velocity_series();
        let supplied = integral_of_product(&force, &velocity, elapsed);
        let lost = self.damping * integral_of_product(&velocity, &velocity, elapsed);
        WorkIntegrals {
            supplied,
            lost,
            pressed: 0.0,
        }
    }
}

/// Integrals over time of products of cosine and sine of the drive angle, as work in closed form is made of them.
struct DriveIntegrals {
    cos: f64,
    sin: f64,
    cos_cos: f64,
    cos_sin: f64,
    sin_sin: f64,
}

impl DriveIntegrals {
    fn between_nodes(w: f64, from: &ScanNode, to: &ScanNode) -> Self {
        let (DriveAngle { cos: c0, sin: s0 }, DriveAngle { cos: c1, sin: s1 }) =
            (from.drive, to.drive);
        let (half, slowness) = (0.5 * to.elapsed, 1.0 / w);
        let ripple = 0.5 * slowness * (s1 * c1 - s0 * c0);
        Self {
            cos: slowness * (s1 - s0),
            sin: slowness * (c0 - c1),
            cos_cos: half + ripple,
            cos_sin: 0.5 * slowness * (s1 * s1 - s0 * s0),
            sin_sin: half - ripple,
        }
    }
}
