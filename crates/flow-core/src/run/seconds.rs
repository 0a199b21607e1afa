//! Where the wall time of a run went.

/// Seconds of wall time by what they were spent on, since the run was started or, if it was, resumed. They add up to the
/// time spent in the run; those of the integration are clocked in some steps and scaled to the time of all.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Seconds {
    /// From the scene to the first frame.
    pub start: f64,
    /// Right-hand sides at the iterates of Newton's method.
    pub right_hand_sides: f64,
    /// Second derivatives of the energy, with the right-hand side, at the predictors.
    pub linearisations: f64,
    /// Products of the implicit operator with a vector.
    pub jacobian_products: f64,
    /// Factorisations of the preconditioner.
    pub factorisations: f64,
    /// Solves with it.
    pub solves: f64,
    /// The rest of the linear solves: weights and orthogonalisation.
    pub krylov: f64,
    /// Closure, invariants, energy and dissipation of the candidates of the steps.
    pub checks: f64,
    /// Predictor, error, step size and order.
    pub step_control: f64,
    /// Changes of the nodes or of the gauge.
    pub remaps: f64,
    /// Frames with all that they hold.
    pub frames: f64,
    /// Those who watch: progress and callbacks, contact, equilibrium, the log of steps.
    pub observers: f64,
    /// Checkpoints and the result file.
    pub output: f64,
    /// Parts of the evaluations of the flow.
    pub evaluations: EvaluationSeconds,
}

/// Seconds by part of the right-hand sides, linearisations, products and checks, which they add up to. The time of a part in
/// each of them is measured in a short replay on the final state, and multiplied by their numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EvaluationSeconds {
    /// Of each term of the energy, with the machinery that it alone needs, in the order of the names of the record.
    pub terms: Vec<f64>,
    /// The normal mobility.
    pub normal_mobility: f64,
    /// The mobilities of the densities.
    pub density_mobilities: f64,
    /// What every flow needs: gauge, flow map, transforms, closure.
    pub flow_map: f64,
}

impl Seconds {
    /// What they were spent on by name, in the order of the course of a run.
    #[must_use]
    pub fn by_activity(&self) -> [(&'static str, f64); 13] {
        [
            ("start", self.start),
            ("right_hand_sides", self.right_hand_sides),
            ("linearisations", self.linearisations),
            ("jacobian_products", self.jacobian_products),
            ("factorisations", self.factorisations),
            ("solves", self.solves),
            ("krylov", self.krylov),
            ("checks", self.checks),
            ("step_control", self.step_control),
            ("remaps", self.remaps),
            ("frames", self.frames),
            ("observers", self.observers),
            ("output", self.output),
        ]
    }

    /// Seconds of the whole run.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.by_activity().iter().map(|(_, seconds)| seconds).sum()
    }

    /// Seconds of all evaluations of the flow.
    #[must_use]
    pub fn in_evaluations(&self) -> f64 {
        self.right_hand_sides + self.linearisations + self.jacobian_products + self.checks
    }
}
