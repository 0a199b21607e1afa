//! A curve γ(φ) with its exact first and second derivatives.

use super::jet::{Jet, speed};
use super::points::Interpolated;
use crate::expression::{Expression, ExpressionError, Program};

/// A curve that can be evaluated anywhere. `slope` computes what |γ′| needs, `jet` what a [`Jet`] needs.
#[derive(Debug)]
pub(super) enum Curve {
    /// `slope`: x′, y′; `jet`: x, y, x′, y′, x″, y″.
    Cartesian { slope: Program, jet: Program },
    /// `slope`: r, r′; `jet`: r, r′, r″.
    Polar { slope: Program, jet: Program },
    /// Through points.
    Interpolated(Interpolated),
}

impl Curve {
    /// The curve (x(φ), y(φ)); φ is the variable 0.
    pub(super) fn cartesian(x: &Expression, y: &Expression) -> Result<Self, ExpressionError> {
        let (x_phi, y_phi) = (x.derivative(0)?, y.derivative(0)?);
        let slope = Program::compile(&[&x_phi, &y_phi]);
        let jet = Program::compile(&[x, y, &x_phi, &y_phi, &x_phi.derivative(0)?, &y_phi.derivative(0)?]);
        Ok(Self::Cartesian { slope, jet })
    }

    /// The curve r(φ)(cos φ, sin φ); φ is the variable 0.
    pub(super) fn polar(r: &Expression) -> Result<Self, ExpressionError> {
        let r_phi = r.derivative(0)?;
        let slope = Program::compile(&[r, &r_phi]);
        let jet = Program::compile(&[r, &r_phi, &r_phi.derivative(0)?]);
        Ok(Self::Polar { slope, jet })
    }

    /// Cells of φ to start integrating with.
    pub(super) fn fewest_cells(&self) -> usize {
        const FEWEST: usize = 64;
        match self {
            Self::Interpolated(curve) => (curve.points() / 4).next_power_of_two().max(FEWEST),
            _ => FEWEST,
        }
    }

    /// The speed |γ′| at each `phi`.
    pub(super) fn speeds(&self, phi: &[f64]) -> Vec<f64> {
        match self {
            // |γ′|² = r² + r′² in polar coordinates.
            Self::Cartesian { slope, .. } | Self::Polar { slope, .. } => {
                let [a, b] = columns(slope, phi);
                a.iter().zip(&b).map(|(a, b)| a.hypot(*b)).collect()
            }
            Self::Interpolated(curve) => phi.iter().map(|&phi| speed(&curve.jet(phi))).collect(),
        }
    }

    /// The curve and its derivatives at each `phi`.
    pub(super) fn jets(&self, phi: &[f64]) -> Vec<Jet> {
        match self {
            Self::Cartesian { jet, .. } => {
                let [x, y, x_phi, y_phi, x_phi_phi, y_phi_phi] = columns(jet, phi);
                let jet = |i| [[x[i], y[i]], [x_phi[i], y_phi[i]], [x_phi_phi[i], y_phi_phi[i]]];
                (0..phi.len()).map(jet).collect()
            }
            Self::Polar { jet, .. } => {
                let [r, r_phi, r_phi_phi] = columns(jet, phi);
                (0..phi.len()).map(|i| polar_jet(phi[i], r[i], r_phi[i], r_phi_phi[i])).collect()
            }
            Self::Interpolated(curve) => phi.iter().map(|&phi| curve.jet(phi)).collect(),
        }
    }
}

fn polar_jet(phi: f64, r: f64, r_phi: f64, r_phi_phi: f64) -> Jet {
    let (sine, cosine) = phi.sin_cos();
    // Components along (cos φ, sin φ) and (−sin φ, cos φ).
    let cartesian =
        |radial: f64, angular: f64| [radial * cosine - angular * sine, radial * sine + angular * cosine];
    [cartesian(r, 0.0), cartesian(r_phi, r), cartesian(r_phi_phi - r, 2.0 * r_phi)]
}

/// Every output of a program of one variable.
fn columns<const OUTPUTS: usize>(program: &Program, phi: &[f64]) -> [Vec<f64>; OUTPUTS] {
    let mut columns = std::array::from_fn(|_| vec![0.0; phi.len()]);
    let mut scratch = vec![0.0; program.scratch_len()];
    program.evaluate(&[phi], &mut columns.each_mut().map(Vec::as_mut_slice), &mut scratch);
    columns
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polar_and_cartesian_agree() {
        let parse = |text| Expression::parse(text, &["phi"]).unwrap();
        let polar = Curve::polar(&parse("2 + sin(3*phi)")).unwrap();
        let (x, y) = (parse("(2 + sin(3*phi))*cos(phi)"), parse("(2 + sin(3*phi))*sin(phi)"));
        let cartesian = Curve::cartesian(&x, &y).unwrap();
        let phi = [0.0, 0.7, 3.1, 5.0];
        for (a, b) in
            polar.jets(&phi).iter().flatten().flatten().zip(cartesian.jets(&phi).iter().flatten().flatten())
        {
            assert!((a - b).abs() < 1e-13, "{a} ≠ {b}");
        }
        for (speed_at, jet) in polar.speeds(&phi).iter().zip(cartesian.jets(&phi)) {
            assert!((speed_at - speed(&jet)).abs() < 1e-14);
        }
    }
}
