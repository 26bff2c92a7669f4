//! How machines within the tolerances of a point of the search change with its coordinates.

use softstop::{Parameter, Scene};
use softstop_dynamics::slopes::Border;
use softstop_dynamics::spread::ToleranceBox;

use super::exact::Linearization;
use super::space::Space;

const COUNT: usize = Parameter::ALL.len();
type Values = [f64; COUNT];

/// Changes by which parameters within the tolerances are differenced: of a coordinate of the search and of the frequency,
/// relative, and of the share of a way. They are products of two of them at most.
const CHANGE: f64 = 1e-2;

/// How the parameters of one machine of the tolerances change, in SI units.
pub(super) struct Rows {
    /// With each coordinate of the search.
    by: Vec<Values>,
    /// On the way out from the nominal machine.
    outwards: Values,
    /// Those that change at all, but the frequency.
    parameters: Vec<Parameter>,
}

impl Rows {
    /// At some coordinates of the box of tolerances.
    pub(super) fn at(about: &Linearization<'_>, coordinates: &[f64]) -> Option<Self> {
        let Linearization { problem, at, .. } = about;
        let values = Space(&problem.axes).values(at.unit);
        let frequency = about.point.orbit.scene.excitation.frequency;
        let machine = |values: &[f64], frequency: f64, coordinates: &[f64]| {
            let mut machine = problem.machine_at(values);
            Parameter::Frequency.set(&mut machine.scene, frequency);
            Some(told(&problem.spread(&machine)?.scene(coordinates)))
        };
        let half = 1.0 / (2.0 * CHANGE);
        let aside = |axis: usize| {
            let rate = problem.axes[axis].rate(values[axis]);
            let aside = |by: f64| {
                let mut values = values.clone();
                values[axis] += by * rate;
                machine(&values, frequency, coordinates)
            };
            Some(difference(&aside(-CHANGE)?, &aside(CHANGE)?, half))
        };
        let [slower, faster] = [1.0 - CHANGE, 1.0 + CHANGE]
            .map(|factor| machine(&values, factor * frequency, coordinates));
        let by_frequency = difference(&slower?, &faster?, half / frequency);
        let [inner, outer] = [1.0 - CHANGE, 1.0 + CHANGE].map(|factor| {
            let scaled: Vec<f64> = coordinates.iter().map(|it| factor * it).collect();
            machine(&values, frequency, &scaled)
        });
        let free: Vec<usize> = (0..problem.axes.len())
            .filter(|axis| !problem.axes[*axis].range.is_held())
            .collect();
        let own = at.moved.iter().map(|index| aside(free[*index]));
        let place = at.place.map(|_| Some([0.0; COUNT]));
        let by = own.chain(place).zip(&about.frequency);
        let by: Option<Vec<Values>> = by
            .map(|(row, frequency)| {
                let row = row?;
                Some(std::array::from_fn(|index| {
                    row[index] + frequency * by_frequency[index]
                }))
            })
            .collect();
        let (by, outwards) = (by?, difference(&inner?, &outer?, half));
        let changes = |parameter: &Parameter| {
            let index = *parameter as usize;
            let is_moved = by.iter().any(|row| row[index] != 0.0) || outwards[index] != 0.0;
            is_moved && *parameter != Parameter::Frequency
        };
        let parameters = Parameter::ALL.into_iter().filter(changes).collect();
        Some(Self {
            by,
            outwards,
            parameters,
        })
    }

    /// What a border's normal has to be by.
    pub(super) fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// Derivatives by some of the parameters as derivatives by the coordinates of the search.
    pub(super) fn chain(&self, parameters: &[Parameter], by: &[f64]) -> Vec<f64> {
        let total = |row: &Values| {
            let pairs = parameters.iter().zip(by);
            pairs
                .map(|(parameter, by)| by * row[*parameter as usize])
                .sum()
        };
        self.by.iter().map(total).collect()
    }

    /// How the machine's distance in frequency from a border changes with each coordinate of the search, and on the way
    /// outwards, in rad/s.
    pub(super) fn across(&self, border: &Border) -> (Vec<f64>, f64) {
        let across = |row: &Values| {
            let pairs = border.parameters.iter().zip(&border.normal);
            let others = pairs.map(|(parameter, normal)| normal * row[*parameter as usize]);
            others.sum::<f64>() + row[Parameter::Frequency as usize]
        };
        (self.by.iter().map(across).collect(), across(&self.outwards))
    }
}

fn told(scene: &Scene) -> Values {
    Parameter::ALL.map(|parameter| parameter.get(scene).unwrap_or(0.0))
}

fn difference(before: &Values, after: &Values, factor: f64) -> Values {
    std::array::from_fn(|index| factor * (after[index] - before[index]))
}
