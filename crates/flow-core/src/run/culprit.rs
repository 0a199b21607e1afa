//! What is not finite, in the words of the scene.

use std::fmt::{self, Display, Formatter};

use crate::flow::{NotFinite, TermPart, TermPlace};

/// A value of a term that is not finite, or too large, with the names of the variables.
#[derive(Clone, Debug, PartialEq)]
pub struct Culprit {
    /// The value.
    pub found: NotFinite,
    /// Names of the densities.
    pub densities: Vec<String>,
}

impl Culprit {
    fn variable(&self, index: usize) -> String {
        let fields = self.densities.len() + 1;
        let slope = if index < fields { "" } else { "_sigma" };
        let name = match index % fields {
            0 => "kappa",
            density => &self.densities[density - 1],
        };
        format!("{name}{slope}")
    }

    fn part(&self) -> String {
        match self.found.part {
            TermPart::Value => "value".to_owned(),
            TermPart::First(a) => format!("first derivative by `{}`", self.variable(a)),
            TermPart::Second(a, b) if a == b => format!("second derivative by `{}`", self.variable(a)),
            TermPart::Second(a, b) => {
                format!("second derivative by `{}` and `{}`", self.variable(b), self.variable(a))
            }
            TermPart::OfLength(0) => "function of the length".to_owned(),
            TermPart::OfLength(1) => "first derivative by the length".to_owned(),
            TermPart::OfLength(_) => "second derivative by the length".to_owned(),
            TermPart::Force => "force".to_owned(),
        }
    }
}

/// "its first derivative by `a` is inf at node 3, where kappa = 1.000000, a = 0".
impl Display for Culprit {
    fn fmt(&self, out: &mut Formatter<'_>) -> fmt::Result {
        write!(out, "its {} is {}", self.part(), number(self.found.value))?;
        if self.found.value.is_finite() {
            write!(out, ", too large to be squared,")?;
        }
        match self.found.place {
            TermPlace::Node(node) => write!(out, " at node {node}")?,
            TermPlace::After(node) => write!(out, " between node {node} and the next one")?,
            TermPlace::Curve => {}
        }
        for (index, value) in self.found.variables.iter().enumerate() {
            let separator = if index == 0 { ", where " } else { ", " };
            write!(out, "{separator}{} = {}", self.variable(index), number(*value))?;
        }
        Ok(())
    }
}

/// Six digits, with an exponent where zeros would hide them.
fn number(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        1e-3..1e5 => format!("{value:.6}"),
        _ if value.is_finite() => format!("{value:.6e}"),
        _ => value.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use crate::run::{Failure, Quiet, Scene, Simulation};

    /// A circle with a density `a` that starts as `initial`, the energy `local` and those of `more`.
    fn scene(initial: &str, local: &str, more: &str) -> Scene {
        let text = format!(
            "title = 't'\n[curve]\nshape = 'circle'\nradius = 1.0\n[[density]]\nname = 'a'\ninitial = '{initial}'\n\
             mobility = 'diffusion'\n[energy.bending]\nrigidity = 1.0\n{more}[energy.local]\nexpression = '{local}'\n\
             [accuracy]\nnodes = 32\n[time]\nend = 0.1\n"
        );
        Scene::parse(&text, "t").unwrap()
    }

    fn refusal(initial: &str, local: &str, more: &str) -> String {
        Simulation::new(&scene(initial, local, more)).unwrap_err().to_string()
    }

    #[test]
    fn messages_name_what_is_not_finite_and_where() {
        let wave = "0.5+0.3*cos(2*pi*s)";
        for gauge in ["", "[flow]\ngauge = 'co-moving'\n"] {
            for (initial, local, expected) in [
                (wave, "ln(0.6-a)", "its value is NaN at node 0, where kappa = 1.000000, a = 0.800000"),
                ("0.5", "abs(a-0.5)^0.5", "first derivative by `a` is NaN at node 0"),
                (
                    wave,
                    "exp(exp(a*8))",
                    "first derivative by `a` is 1.149618e265, too large to be squared, at node 0",
                ),
                (
                    "0",
                    "0.5*a^1.5",
                    "its second derivative by `a` is inf at node 0, where kappa = 1.000000, a = 0;",
                ),
                ("0", "a^1.5*(kappa-1)^2", "its second derivative by `a` is NaN at node 0"),
                (
                    wave,
                    "ln(a_sigma)",
                    "its value is NaN between node 0 and the next one, where kappa = 1.000000, a = 0.7",
                ),
            ] {
                let text = refusal(initial, local, gauge);
                assert!(
                    text.contains("the energy term `local` is not") && text.contains(expected),
                    "{local}: {text}"
                );
            }
        }
        let preferred = "preferred_curvature = '1 + rho^1.5'\ndensity = 'a'\n";
        let text = refusal("0", "a", preferred);
        assert!(text.contains("`bending`") && text.contains("second derivative by `a` is NaN"), "{text}");
    }

    #[test]
    fn a_density_that_leaves_0_at_once_may_start_there() {
        let mut simulation =
            Simulation::new(&scene("0.5+0.5*cos(2*pi*s)", "0.5*a^1.5+0.1*a_sigma^2", "")).unwrap();
        while simulation.step(&mut Quiet) {}
        assert!(simulation.failure().is_none());
    }

    #[test]
    fn a_run_that_leaves_the_range_of_an_expression_names_it() {
        for local in ["0.5*a^1.5+a*cos(kappa)", "0.1*sqrt(kappa-0.9)+0.05*a_sigma^2+a^2"] {
            let mut simulation = Simulation::new(&scene("sin(pi*s)^4", local, "")).unwrap();
            while simulation.step(&mut Quiet) {}
            let failure = simulation.failure().unwrap();
            assert!(matches!(failure, Failure::NotFinite { .. }), "{local}: {failure}");
            assert!(failure.to_string().contains("energy term `local` is not finite"), "{failure}");
        }
    }
}
