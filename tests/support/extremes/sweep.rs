//! Scenes drawn at random from the ends of all ranges at once, within what the reader accepts.

use std::fmt::Write as _;

use flow_core::run::Scene;
use flow_core::run::scene::Nodes;

use super::outcome::{Outcome, measure};

/// A small generator of random numbers (Steele, Lea & Flood, OOPSLA 2014, `SplitMix`).
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// The sequence of `seed`.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn one_of<'a>(&mut self, choices: &[&'a str]) -> &'a str {
        choices[(self.next() % choices.len() as u64) as usize]
    }

    /// 10ˣ with x uniform in `decades`.
    fn magnitude(&mut self, decades: [f64; 2]) -> f64 {
        let part = (self.next() >> 11) as f64 / (1_u64 << 53) as f64;
        10f64.powf(decades[0] + part * (decades[1] - decades[0]))
    }
}

/// Most steps of a run.
pub const MOST_STEPS: u64 = 1500;
/// Most steps of a run that chooses its nodes: up to 65,536 of them.
pub const MOST_STEPS_ON_AUTOMATIC_NODES: u64 = 300;

/// The text of a random scene; not all of them are scenes.
pub fn text(random: &mut Random) -> String {
    let curve = random.one_of(&[
        "shape = 'circle', radius = 1.0",
        "shape = 'ellipse', semi_axes = [1.0, 0.1]",
        "shape = 'trillium'",
        "shape = 'figure-eight', size = 1.0, turning_number = 0",
        "shape = 'polar', r = '1 + 0.35*cos(3*phi)'",
    ]);
    let mobility = random.one_of(&["diffusion", "exchange", "none"]);
    let initial = random.one_of(&[
        "0.0",
        "'0.5 + 0.1*cos(2*pi*s)'",
        "1.0",
        "'1 + 2*sin(6*pi*s)'",
        "'0.9 + 0.05*cos(6*pi*s)'",
    ]);
    let mut energy = String::new();
    for _ in 0..=random.next() % 3 {
        let (small, wide) = (random.magnitude([-4.0, 1.0]), random.magnitude([-6.0, 8.0]));
        let term = match random.next() % 7 {
            0 => format!("bending.rigidity = {small:e}"),
            1 => format!(
                "length = {{ penalty = {wide:e}, target_ratio = {} }}",
                random.one_of(&["0.5", "1.0", "1.8"])
            ),
            2 => format!("length.tension = {wide:e}"),
            3 => {
                format!("membrane = {{ density = 'protein', epsilon = {:e} }}", random.magnitude([-6.0, 0.0]))
            }
            4 => format!("area.pressure = {}", random.one_of(&["-3.0", "0.1", "30.0"])),
            5 => format!(
                "agents = {{ density = 'protein', epsilon = {:e}, delta = {small:e}, preferred_curvature = '1.8 - 2.6*rho', \
                 low_density = '0.1 + 0.1*exp(-kappa^2)', high_density = '0.8 + 0.1*exp(-kappa^2)' }}",
                random.magnitude([-3.0, 0.0])
            ),
            _ => format!("regularization.delta = {small:e}"),
        };
        let table = term.split(['.', ' ']).next().unwrap_or_default().to_owned();
        if !energy.contains(&format!("energy.{table}")) {
            let _ = writeln!(energy, "energy.{term}"); // into a string it cannot fail
        }
    }
    format!(
        "curve = {{ {curve} }}\ndensity = [{{ name = 'protein', initial = {initial}, mobility = '{mobility}' }}]\n{energy}\
         flow = {{ normal_mobility = '{}', gauge = '{}' }}\n\
         time = {{ end = {:e}, stop_at_equilibrium = {}, max_steps = {MOST_STEPS} }}\n\
         accuracy = {{ tolerance = {:e}, nodes = {}, derivative = '{}', linear_solver = '{}' }}\noutput.frames = 5",
        random.one_of(&[
            "identity",
            "identity",
            "incompressible",
            "area-preserving",
            "incompressible-area-preserving",
            "surface-diffusion"
        ]),
        random.one_of(&["scaled-arc-length", "scaled-arc-length", "co-moving"]),
        random.magnitude([-12.0, 12.0]),
        random.one_of(&["true", "false"]),
        random.magnitude([-11.0, -1.0]),
        random.one_of(&["8", "17", "32", "64", "100", "256", "'auto'"]),
        random.one_of(&["fourier", "fourier", "central-2", "central-4", "central-8"]),
        random.one_of(&["auto", "auto", "fourier", "banded"]),
    )
}

/// A random scene that the reader accepts, with its outcome.
pub fn draw(random: &mut Random) -> (String, Outcome) {
    loop {
        let text = text(random);
        if let Ok(mut scene) = Scene::parse(&text, "random.toml") {
            if scene.accuracy.nodes == Nodes::Auto {
                scene.time.max_steps = Some(MOST_STEPS_ON_AUTOMATIC_NODES);
            }
            return (text, measure(&scene));
        }
    }
}
