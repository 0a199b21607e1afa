//! Coefficients of the one-step methods, as data; `tests/order_conditions.rs` checks them.

#![allow(clippy::excessive_precision)] // quoted digit by digit

/// A singly diagonally implicit Runge–Kutta pair with an explicit first stage.
#[derive(Debug)]
pub struct EsdirkTableau {
    /// Name in tables.
    pub name: &'static str,
    /// Order of the solution.
    pub order: usize,
    /// Order of the solution embedded for the error.
    pub embedded_order: usize,
    /// Rows of the stages, up to and with the diagonal.
    pub a: &'static [&'static [f64]],
    /// Weights of the solution.
    pub b: &'static [f64],
    /// Weights of the embedded solution.
    pub b_embedded: &'static [f64],
}

/// A Rosenbrock–W pair: its order does not need the exact Jacobian.
#[derive(Debug)]
pub struct RosenbrockTableau {
    /// Name in tables.
    pub name: &'static str,
    /// Order of the solution with any matrix in place of the Jacobian.
    pub order: usize,
    /// Order of the solution embedded for the error, likewise.
    pub embedded_order: usize,
    /// Diagonal γ of the implicit coefficients.
    pub gamma: f64,
    /// Explicit coefficients α below the diagonal.
    pub alpha: &'static [&'static [f64]],
    /// Implicit coefficients γ below the diagonal.
    pub implicit: &'static [&'static [f64]],
    /// Weights of the solution.
    pub b: &'static [f64],
    /// Weights of the embedded solution.
    pub b_embedded: &'static [f64],
}

/// The implicit half of ARK4(3)6L\[2\]SA, order 4(3), six stages, L-stable, stiffly accurate:
/// Kennedy & Carpenter, Appl. Numer. Math. 44 (2003) 139.
pub static ESDIRK43: EsdirkTableau = EsdirkTableau {
    name: "ESDIRK4(3)",
    order: 4,
    embedded_order: 3,
    a: &[
        &[0.0],
        &[0.25, 0.25],
        &[8611.0 / 62500.0, -1743.0 / 31250.0, 0.25],
        &[5012029.0 / 34652500.0, -654441.0 / 2922500.0, 174375.0 / 388108.0, 0.25],
        &[
            15267082809.0 / 155376265600.0,
            -71443401.0 / 120774400.0,
            730878875.0 / 902184768.0,
            2285395.0 / 8070912.0,
            0.25,
        ],
        &[82889.0 / 524892.0, 0.0, 15625.0 / 83664.0, 69875.0 / 102672.0, -2260.0 / 8211.0, 0.25],
    ],
    b: &[82889.0 / 524892.0, 0.0, 15625.0 / 83664.0, 69875.0 / 102672.0, -2260.0 / 8211.0, 0.25],
    b_embedded: &[
        4586570599.0 / 29645900160.0,
        0.0,
        178811875.0 / 945068544.0,
        814220225.0 / 1159782912.0,
        -3700637.0 / 11593932.0,
        61727.0 / 225920.0,
    ],
};

/// ROS34PW2, order 3(2), four stages, L-stable, stiffly accurate, a W-method:
/// Rang & Angermann, BIT 45 (2005) 761.
pub static ROS34PW2: RosenbrockTableau = RosenbrockTableau {
    name: "ROS34PW2",
    order: 3,
    embedded_order: 2,
    gamma: 0.43586652150845900,
    alpha: &[&[], &[0.87173304301691801], &[0.84457060015369423, -0.11299064236484185], &[0.0, 0.0, 1.0]],
    implicit: &[
        &[],
        &[-0.87173304301691801],
        &[-0.90338057013044082, 0.054180672388095326],
        &[0.24212380706095346, -1.2232505839045147, 0.54526025533510214],
    ],
    b: &[0.24212380706095346, -1.2232505839045147, 1.5452602553351020, 0.43586652150845900],
    b_embedded: &[0.37810903145819369, -0.096042292212423178, 0.5, 0.21793326075422950],
};
