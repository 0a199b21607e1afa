//! Theorem 5 of the paper: a membrane that resists stretching becomes incompressible as ε → 0.

use flow_core::operators::{DerivativeFamily, Helmholtz};
use flow_core::run::{Frame, Record};

use super::alignment::Aligned;
use super::fit::{Slope, line, power};
use crate::{largest_rise, last, mean, run, scene};

/// Initial densities: at rest, which is ε from the manifold; stretched everywhere; off the manifold either way; and
/// compressed everywhere, where the curvature equation without bending is ill-posed.
pub const STARTS: [(&str, &str); 4] = [
    ("ρ = 1", "1"),
    ("ρ = 0.9", "0.9"),
    ("ρ = 1 + 0.2 cos 6πs", "1 + 0.2*cos(6*pi*s)"),
    ("ρ = 1.2 + 0.1 cos 6πs", "1.2 + 0.1*cos(6*pi*s)"),
];

/// The ladder of compressibilities.
pub const EPSILONS: [f64; 7] = [1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4];

/// Time of the comparison, by which e^{−νt/ε} is gone but at the largest ε.
pub const TIME: f64 = 0.4;
/// Largest ε for which the fast decay is over at [`TIME`]; the fits start there.
pub const LARGEST_FITTED: f64 = 1e-2;
/// Frames per ε of time while the decay is recorded, and how many ε of it.
const FRAMES_PER_EPSILON: usize = 2;
const DECAY: usize = 12;
/// The slowest rate is fitted from here on, in ε: the faster ones are gone.
const SLOW: f64 = 4.0;
/// A decay is exponential if its rate has a smaller relative error than this.
const EXPONENTIAL: f64 = 0.02;
/// Frames nearer to the manifold than this multiple of the last one are left out.
const ABOVE_THE_FLOOR: f64 = 50.0;

/// One ε.
#[derive(Clone, Debug)]
pub struct Point {
    /// Compressibility.
    pub epsilon: f64,
    /// ‖ρ − 1 − ερ̄‖ at the start and at [`TIME`].
    pub distance: [f64; 2],
    /// Rate ν of the decay e^{−νt/ε} between t = 4ε and 12ε, if that is before [`TIME`] and the decay is exponential.
    pub rate: Option<Slope>,
    /// Lowest eigenvalue of H = −`Δ_s` + κ² at the first and at the last of these times.
    pub eigenvalues: Option<[f64; 2]>,
    /// Largest |κ| of all frames over that of the start: above 1 if the curve buckles.
    pub buckling: f64,
    /// ‖V − 𝓘V̂‖/‖V‖ at [`TIME`].
    pub velocity_residual: f64,
    /// 1 − |Γ|/M at [`TIME`], M the mass of the membrane, which is the length of the incompressible curve.
    pub length_deficit: f64,
    /// Largest distance between the curve and that of the incompressible flow from the same ellipse.
    pub gap: f64,
    /// Largest relative rise of the energy in a step.
    pub rise: f64,
}

/// The ladder for one initial density.
#[derive(Clone, Debug)]
pub struct Limit {
    /// One per entry of [`EPSILONS`].
    pub points: Vec<Point>,
    /// Exponents of ε, for ε ≤ [`LARGEST_FITTED`]: of the distance, the velocity residual, the length deficit, the gap.
    pub exponents: [Slope; 4],
}

/// The scene of an ellipse under bending that carries the membrane.
#[must_use]
pub fn text(initial: &str, epsilon: f64, tolerance: f64, end: f64) -> String {
    format!(
        "
        curve = {{ shape = 'ellipse', semi_axes = [1.6, 0.8] }}
        density = [{{ name = 'membrane', initial = '{initial}', mobility = 'diffusion' }}]
        energy.bending.rigidity = 1.0
        energy.membrane = {{ density = 'membrane', epsilon = {epsilon:?} }}
        time = {{ end = {end:?}, stop_at_equilibrium = false }}
        accuracy = {{ tolerance = {tolerance:?}, nodes = 128 }}
        "
    )
}

/// Runs the ladder from the initial density `initial`.
#[must_use]
pub fn measure(initial: &str) -> Limit {
    let limit = incompressible();
    let points: Vec<Point> = EPSILONS.iter().map(|epsilon| point(initial, *epsilon, &limit)).collect();
    let fitted = || points.iter().filter(|point| point.epsilon <= LARGEST_FITTED);
    let exponent = |of: &dyn Fn(&Point) -> f64| {
        power(&fitted().map(|point| [point.epsilon, of(point)]).collect::<Vec<_>>())
    };
    let exponents = [
        exponent(&|point| point.distance[1]),
        exponent(&|point| point.velocity_residual),
        exponent(&|point| point.length_deficit.abs()),
        exponent(&|point| point.gap),
    ];
    Limit { points, exponents }
}

fn point(initial: &str, epsilon: f64, limit: &Record) -> Point {
    let early = (1..=DECAY * FRAMES_PER_EPSILON).map(|k| k as f64 * epsilon / FRAMES_PER_EPSILON as f64);
    let times: Vec<String> = early.filter(|time| *time < TIME).map(|time| format!("{time:?}")).collect();
    let output = format!("output.times = [{}]\n", times.join(", "));
    let record = run(&scene(&(text(initial, epsilon, 1e-8, TIME) + &output)));
    let distance = |frame: &Frame| frame.diagnostics[0];
    let (first, end) = (&record.frames[0], last(&record));
    let slow: Vec<&Frame> = record.frames[..record.frames.len() - 1]
        .iter()
        .filter(|frame| frame.time >= 0.999 * SLOW * epsilon)
        .filter(|frame| distance(frame) > ABOVE_THE_FLOOR * distance(end))
        .collect();
    let decay: Vec<[f64; 2]> =
        slow.iter().map(|frame| [-frame.time / epsilon, distance(frame).ln()]).collect();
    let rate = (decay.len() > 4).then(|| line(&decay));
    let bent = |frame: &Frame| frame.curvature.iter().fold(0.0, |most: f64, kappa| kappa.abs().max(most));
    Point {
        epsilon,
        distance: [distance(first), distance(end)],
        rate: rate.filter(|rate| rate.error < EXPONENTIAL * rate.value),
        eigenvalues: rate.map(|_| [slow[0], slow[slow.len() - 1]].map(lowest_eigenvalue)),
        buckling: record.frames.iter().map(bent).fold(0.0, f64::max) / bent(first),
        velocity_residual: end.diagnostics[1] / speed(end),
        length_deficit: 1.0 - end.length / end.mass[0],
        gap: Aligned::new(&last(limit).position, &end.position, 360).largest_gap(),
        rise: largest_rise(&record),
    }
}

/// Lowest eigenvalue of H = −`Δ_s` + κ², by inverse iteration.
fn lowest_eigenvalue(frame: &Frame) -> f64 {
    let nodes = frame.curvature.len();
    let mut helmholtz = Helmholtz::new(DerivativeFamily::Fourier, nodes);
    helmholtz.set(&frame.curvature, frame.length).expect("a closed curve");
    let (mut u, mut next) = (vec![1.0; nodes], vec![0.0; nodes]);
    let mut eigenvalue = 0.0;
    for _ in 0..40 {
        helmholtz.solve(&u, &mut next);
        eigenvalue = mean(&u) / mean(&next);
        u = next.iter().map(|value| value * eigenvalue).collect();
    }
    eigenvalue
}

/// ‖V‖ in L²(dσ).
fn speed(frame: &Frame) -> f64 {
    (frame.length * mean(&frame.normal_velocity.iter().map(|v| v * v).collect::<Vec<_>>())).sqrt()
}

/// The incompressible flow of the same ellipse.
fn incompressible() -> Record {
    run(&scene(&format!(
        "
        curve = {{ shape = 'ellipse', semi_axes = [1.6, 0.8] }}
        energy.bending.rigidity = 1.0
        flow.normal_mobility = 'incompressible'
        time = {{ end = {TIME:?}, stop_at_equilibrium = false }}
        accuracy = {{ tolerance = 1e-8, nodes = 128 }}
        output.frames = 1
        "
    )))
}
