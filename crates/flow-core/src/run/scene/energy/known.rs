//! The density that a term acts on.

use crate::run::scene::entry::Entry;
use crate::run::scene::error::Fault;
use crate::run::scene::suggest::nearest;

/// The name of a density that the scene has.
pub(super) fn known_density(entry: &Entry<'_>, densities: &[String]) -> Option<String> {
    let value = entry.text()?.to_owned();
    if densities.contains(&value) {
        return Some(value);
    }
    let only = (densities.len() == 1).then(|| densities[0].clone());
    let suggestion = nearest(&value, densities.iter().map(String::as_str)).map(str::to_owned).or(only);
    entry.fault(Fault::UnknownDensity { value, suggestion, densities: densities.to_vec() });
    None
}
