//! A curve with its first and second derivatives at one point, and what follows from them.

/// γ, γ′ and γ″ at one φ.
pub(super) type Jet = [[f64; 2]; 3];

/// The speed |γ′|.
pub(super) fn speed(&[_, [x_phi, y_phi], _]: &Jet) -> f64 {
    x_phi.hypot(y_phi)
}

/// The rate of turning θ′ = (x′y″ − y′x″)/v² at the speed v = |γ′|, scaled so that no product overflows.
pub(super) fn turning(&[_, [x_phi, y_phi], [x_phi_phi, y_phi_phi]]: &Jet, v: f64) -> f64 {
    (x_phi / v * y_phi_phi - y_phi / v * x_phi_phi) / v
}

/// The acceleration along the curve, |γ′|′ = γ′·γ″/|γ′|.
pub(super) fn acceleration(jet: &Jet) -> f64 {
    let (&[_, [x_phi, y_phi], [x_phi_phi, y_phi_phi]], v) = (jet, speed(jet));
    x_phi / v * x_phi_phi + y_phi / v * y_phi_phi
}
