//! The kernel of a self-interaction: a function of the squared distance, zero beyond a cut-off.

use std::f64::consts::PI;

use multiversion::multiversion;

use super::Order;
use super::differentiated::Differentiated;
use crate::expression::{Expression, ExpressionError, Program};

/// G(q) with its derivatives.
#[derive(Clone, Debug)]
pub(super) struct Kernel {
    function: Differentiated,
    at_zero: f64,
    largest_square: f64,
}

/// Distance beyond which the kernel is taken as zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CutOff {
    /// This distance.
    At(f64),
    /// Where G and G′ have fallen below the rounding of their largest values, if they do so near this length.
    Automatic {
        /// Length of the curve.
        length: f64,
    },
}

/// Part of its largest value below which a kernel is rounding.
const ROUNDING: f64 = 1e-16;
/// Squared distances tried, per octave, and octaves below and above the squared length of the curve.
const PER_OCTAVE: i32 = 16;
/// … and how many are looked at for each of them: a shell of the kernel that is narrower than half a percent would be missed.
const LOOKS: i32 = 8;
const OCTAVES_BELOW: i32 = 40;
const OCTAVES_ABOVE: i32 = 10;
/// Numbers of nodes tried for the distance that a kernel asks for.
const FEWEST_NODES: usize = 16;
const MOST_NODES: usize = 1 << 17;

impl Kernel {
    /// A kernel of the variable 0.
    pub(super) fn new(kernel: &Expression, cut_off: CutOff) -> Result<Self, ExpressionError> {
        let function = Differentiated::along(&[(kernel, 0)])?;
        let largest_square = match cut_off {
            CutOff::At(distance) => distance * distance,
            CutOff::Automatic { length } => end_of_support(kernel, &kernel.derivative(0)?, length * length),
        };
        Ok(Self { function, at_zero: kernel.evaluate(&[0.0]), largest_square })
    }

    /// Distance beyond which the kernel is zero.
    pub(super) fn cut_off(&self) -> f64 {
        self.largest_square.sqrt()
    }

    /// G(0).
    pub(super) fn at_zero(&self) -> f64 {
        self.at_zero
    }

    /// Largest distance of equidistant nodes on a circle of length `length` on which the sum of G over them, and that of qG′, moves by
    /// less than the part `error` of the sum of the moduli when the nodes move by half of that: the error of the trapezoidal rule.
    /// See `THEORY.md`, eq. (D14).
    pub(super) fn largest_spacing(&self, length: f64, error: f64) -> f64 {
        let (mut function, mut nodes) = (self.function.clone(), FEWEST_NODES);
        while nodes < MOST_NODES {
            // At the nodes, and halfway between them.
            let chord = |i: usize| length / PI * (0.5 * PI * i as f64 / nodes as f64).sin();
            let squares: Vec<f64> = (0..2 * nodes).map(|i| chord(i).powi(2)).collect();
            let (mut value, mut first) = (vec![0.0; 2 * nodes], vec![0.0; 2 * nodes]);
            function.evaluate(Order::Gradient, &[&squares], &mut [&mut value, &mut first]);
            first.iter_mut().zip(&squares).for_each(|(first, square)| *first *= square);
            let is_exact = |values: &[f64]| {
                let (mut moved, mut moduli) = (0.0, 0.0);
                for pair in values.chunks_exact(2) {
                    moved += pair[0] - pair[1];
                    moduli += pair[0].abs() + pair[1].abs();
                }
                // What is not finite is refused elsewhere.
                moved.abs() <= error * moduli || !moduli.is_finite()
            };
            if is_exact(&value) && is_exact(&first) {
                break;
            }
            nodes += nodes / 4;
        }
        length / nodes as f64
    }

    /// G, G′ and, for second derivatives, G″ at the squared distances `squares`.
    pub(super) fn evaluate(
        &mut self,
        squares: &[f64],
        order: Order,
        [value, first, second]: [&mut [f64]; 3],
    ) {
        self.function.evaluate(order, &[squares], &mut [&mut *value, &mut *first, &mut *second]);
        if order >= Order::Hessian {
            cut(squares, self.largest_square, second);
        }
        cut(squares, self.largest_square, value);
        cut(squares, self.largest_square, first);
    }
}

/// Zero beyond the cut-off, whatever stood there.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn cut(squares: &[f64], largest_square: f64, values: &mut [f64]) {
    for (value, square) in values.iter_mut().zip(squares) {
        *value = if *square > largest_square { 0.0 } else { *value };
    }
}

/// The squared distance beyond which a kernel and its derivative stay below rounding; infinite if there is none
/// near `square`.
fn end_of_support(kernel: &Expression, first: &Expression, square: f64) -> f64 {
    let tried = |per_octave: i32| {
        let range = -OCTAVES_BELOW * per_octave..=OCTAVES_ABOVE * per_octave;
        range.map(move |k| square * (f64::from(k) / f64::from(per_octave)).exp2())
    };
    let squares: Vec<f64> = std::iter::once(0.0).chain(tried(LOOKS * PER_OCTAVE)).collect();
    let last_above = |of: &Expression| {
        let (program, mut values) = (Program::compile(&[of]), vec![0.0; squares.len()]);
        let mut scratch = vec![0.0; program.scratch_len()];
        program.evaluate(&[&squares], &mut [&mut values], &mut scratch);
        let largest = values.iter().map(|value| value.abs()).filter(|value| value.is_finite());
        let bound = ROUNDING * largest.fold(0.0, f64::max);
        // What is no number is not small.
        values.iter().rposition(|value| value.is_nan() || value.abs() > bound).unwrap_or(0)
    };
    let last = squares[last_above(kernel).max(last_above(first))];
    tried(PER_OCTAVE).find(|tried| *tried > last).unwrap_or(f64::INFINITY)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn automatic(text: &str) -> f64 {
        let kernel = Expression::parse(text, &["q"]).unwrap();
        Kernel::new(&kernel, CutOff::Automatic { length: 8.0 }).unwrap().cut_off()
    }

    #[test]
    fn narrow_kernels_ask_for_near_nodes() {
        let spacing = |text: &str, error| {
            let kernel = Expression::parse(text, &["q"]).unwrap();
            Kernel::new(&kernel, CutOff::Automatic { length: 8.0 }).unwrap().largest_spacing(8.0, error)
        };
        // The sum of exp(−x²/a²) at the distance h is off by 2exp(−π²a²/h²), and by twice that halfway.
        for (width, text) in [(0.05, "10*exp(-q/0.0025)"), (0.02, "exp(-q/0.0004)")] {
            let h = spacing(text, 1e-6);
            assert!(2.0 * (-(PI * width / h).powi(2)).exp() < 1e-6, "{h}");
            let wider = 1.6 * h;
            assert!(2.0 * (-(PI * width / wider).powi(2)).exp() > 1e-6, "{h}");
        }
        assert!(spacing("exp(-q/0.0025)", 1e-10) < spacing("exp(-q/0.0025)", 1e-3));
        assert_eq!(spacing("q", 1e-10), 0.5);
    }

    #[test]
    fn the_automatic_cut_off_is_where_the_kernel_is_rounding() {
        // 4q e^{−4q} = 1e-16 at q = 10.2, and the derivative a little later.
        let distance = automatic("10*(1 - q/0.25)*exp(-q/0.25)");
        assert!((3.1..3.6).contains(&distance), "{distance}");
        assert!((0.37..0.42).contains(&automatic("exp(-q/0.004)")));
        assert_eq!(automatic("q"), f64::INFINITY);
        assert_eq!(automatic("1/(1 + q)"), f64::INFINITY);
        assert!(automatic("0").is_finite());
    }

    #[test]
    fn a_narrow_shell_beyond_the_core_is_found() {
        for centre in [3.9, 3.93, 3.975, 4.0, 4.02, 4.05] {
            let distance = automatic(&format!("exp(-400*q) - 5*exp(-((q - {centre})/0.01)^2)"));
            assert!(distance.powi(2) > centre, "{centre}: {distance}");
        }
    }
}
