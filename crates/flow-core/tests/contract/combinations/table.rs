//! Every energy × normal mobility × density mobility × gauge, as scenes.

/// An energy with the tables that a scene says it with; the densities are `lipid` and `protein`.
pub const ENERGIES: [(&str, &str); 16] = [
    ("bending", "bending = { rigidity = 0.7 }"),
    ("bending around a constant", "bending = { rigidity = 0.7, preferred_curvature = 0.4 }"),
    (
        "bending around a function of a density",
        r#"bending = { rigidity = 0.9, preferred_curvature = "1.3 - 2*rho + 0.4*rho^3", density = "protein" }"#,
    ),
    ("F(kappa)", r#"local = { expression = "0.2*kappa^4 + exp(0.1*kappa)" }"#),
    ("regularisation", "regularization = { delta = 0.2 }"),
    ("tension", "length = { tension = 0.6 }"),
    ("length penalty", "length = { penalty = 3.0, target_ratio = 1.2 }"),
    ("pressure", "area = { pressure = 0.8 }"),
    ("area penalty", "area = { penalty = 2.0, target = 2.5 }"),
    ("membrane", r#"membrane = { density = "lipid", epsilon = 0.3 }"#),
    ("packing", "packing = { matrix = [[1.4, 0.3], [0.3, 0.9]], epsilon = 0.2 }"),
    ("agents", AGENTS),
    ("adhesion", r#"adhesion = { kernel = "0.5*(1 - q/0.25)*exp(-q/0.25)" }"#),
    ("local without slopes", r#"local = { expression = "0.3*kappa^2*protein*lipid + 0.1*protein^4" }"#),
    (
        "local with slopes",
        r#"local = { expression = "0.3*kappa^2*lipid + 0.1*kappa_sigma^2*(1 + lipid^2) + 0.2*protein_sigma*lipid_sigma + protein^2" }"#,
    ),
    ("all of them", ALL),
];

/// The agents of `scenes/three_fold.toml`.
const AGENTS: &str = r#"agents.density = "protein"
agents.epsilon = 0.05
agents.delta = 0.2
agents.preferred_curvature = "1.3 - 2.0/0.76*(rho - 0.19)"
agents.low_density = "0.05 + 0.16*exp(-(kappa - 1.0)^2*ln(0.16/0.14)/0.09)"
agents.high_density = "0.80 + 0.18*exp(-(kappa + 0.3)^2*ln(0.18/0.15)/0.16)""#;

const ALL: &str = r#"bending = { rigidity = 0.9, preferred_curvature = "1.3 - 2*rho + 0.4*rho^3", density = "protein" }
regularization = { delta = 0.2 }
length = { penalty = 3.0, target_ratio = 1.2 }
area = { penalty = 2.0, target = 2.5 }
membrane = { density = "lipid", epsilon = 0.3 }
packing = { matrix = [[1.4, 0.3], [0.3, 0.9]], epsilon = 0.2 }
adhesion = { kernel = "0.5*(1 - q/0.25)*exp(-q/0.25)" }
local = { expression = "0.3*kappa^2*lipid + 0.1*kappa_sigma^2*(1 + lipid^2) + 0.2*protein_sigma*lipid_sigma" }
agents.density = "protein"
agents.epsilon = 0.05
agents.delta = 0.2
agents.preferred_curvature = "1.3 - 2.0/0.76*(rho - 0.19)"
agents.low_density = "0.05 + 0.16*exp(-(kappa - 1.0)^2*ln(0.16/0.14)/0.09)"
agents.high_density = "0.80 + 0.18*exp(-(kappa + 0.3)^2*ln(0.18/0.15)/0.16)""#;

pub const NORMAL_MOBILITIES: [&str; 5] =
    ["identity", "incompressible", "area-preserving", "incompressible-area-preserving", "surface-diffusion"];

/// The weighted diffusion is told by its name in prose: a scene says `diffusion` with a weight.
pub const DENSITY_MOBILITIES: [&str; 4] = ["diffusion", WEIGHTED, "exchange", "none"];
pub const WEIGHTED: &str = "weighted diffusion";

pub const GAUGES: [&str; 3] = ["scaled-arc-length", "graded", "co-moving"];

/// One row of the table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Combination {
    pub energy: (&'static str, &'static str),
    pub normal_mobility: &'static str,
    pub density_mobility: &'static str,
    pub gauge: &'static str,
}

/// All rows, those that the scenes refuse included.
pub fn all() -> impl Iterator<Item = Combination> {
    ENERGIES.into_iter().flat_map(|energy| {
        NORMAL_MOBILITIES.into_iter().flat_map(move |normal_mobility| {
            DENSITY_MOBILITIES.into_iter().flat_map(move |density_mobility| {
                GAUGES.map(|gauge| Combination { energy, normal_mobility, density_mobility, gauge })
            })
        })
    })
}

impl Combination {
    /// Why a scene refuses the combination; none if it must not.
    pub fn refusal(self) -> Option<&'static str> {
        (self.density_mobility == WEIGHTED && self.gauge == "co-moving").then_some(
            "a weight is a function of the fraction of the arc length, which co-moving nodes do not keep",
        )
    }

    /// Whether the flow is the same from whichever node the parameter starts.
    pub fn forgets_the_first_node(self) -> bool {
        self.density_mobility != WEIGHTED && self.gauge != "graded"
    }

    /// The scene with the curve and the densities given.
    pub fn scene(self, curve: &str, densities: &[String; 2], nodes: usize) -> String {
        let mobility = match self.density_mobility {
            WEIGHTED => "mobility = \"diffusion\"\nweight = \"1 + 0.8*cos(2*pi*s)\"".to_owned(),
            name => format!("mobility = \"{name}\""),
        };
        let [lipid, protein] = densities;
        let grading = if self.gauge == "graded" { "grading = \"exp(0.5*cos(2*pi*s + 0.4))\"" } else { "" };
        format!(
            "[curve]\n{curve}\n\
             [[density]]\nname = \"lipid\"\ninitial = \"{lipid}\"\n{mobility}\n\
             [[density]]\nname = \"protein\"\ninitial = \"{protein}\"\n{mobility}\n\
             [energy]\n{}\n\
             [flow]\nnormal_mobility = \"{}\"\ngauge = \"{}\"\n{grading}\n\
             [time]\nend = 1.0\n[accuracy]\nnodes = {nodes}\n",
            self.energy.1, self.normal_mobility, self.gauge,
        )
    }
}
