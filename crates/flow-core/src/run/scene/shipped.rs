//! The scenes that come with the program, from `scenes/` at the root of the repository.

use super::suggest::nearest;

/// Name and text of each, in the order in which they are listed.
pub(super) const SHIPPED: &[(&str, &str)] = &[
    ("three_fold", include_str!("../../../../../scenes/three_fold.toml")),
    ("three_fold_sharp", include_str!("../../../../../scenes/three_fold_sharp.toml")),
    ("length_penalty", include_str!("../../../../../scenes/length_penalty.toml")),
    ("incompressible", include_str!("../../../../../scenes/incompressible.toml")),
    ("membrane_penalty", include_str!("../../../../../scenes/membrane_penalty.toml")),
    ("adhesion", include_str!("../../../../../scenes/adhesion.toml")),
    ("figure_eight", include_str!("../../../../../scenes/figure_eight.toml")),
    ("blend", include_str!("../../../../../scenes/blend.toml")),
    ("circle", include_str!("../../../../../scenes/circle.toml")),
];

/// The name that a mistyped `name` may stand for.
pub(super) fn like(name: &str) -> Option<&'static str> {
    nearest(name, SHIPPED.iter().map(|(shipped, _)| *shipped))
}
