//! Terms of the energy that come from outside the library, beside those that a scene names.

use std::collections::BTreeSet;
use std::fmt::{self, Debug, Formatter};
use std::sync::Arc;

use super::setup_error::SetupError;
use crate::energies::EnergyTerm;

/// Makes own terms for states of so many nodes.
type Make = dyn Fn(usize) -> Vec<Box<dyn EnergyTerm>> + Send + Sync;

/// Own terms, made anew for each number of nodes that a run takes; none by default.
#[derive(Clone, Default)]
pub(super) struct OwnTerms(Option<Arc<Make>>);

impl OwnTerms {
    /// Those that `make` makes.
    pub fn made_by(make: impl Fn(usize) -> Vec<Box<dyn EnergyTerm>> + Send + Sync + 'static) -> Self {
        Self(Some(Arc::new(make)))
    }

    /// Whether there are any.
    pub fn exist(&self) -> bool {
        self.0.is_some()
    }

    /// Their names.
    pub fn names(&self, nodes: usize) -> Vec<String> {
        self.on(nodes).iter().map(|term| term.name().to_owned()).collect()
    }

    /// The terms for `nodes` nodes.
    pub fn on(&self, nodes: usize) -> Vec<Box<dyn EnergyTerm>> {
        self.0.as_ref().map_or_else(Vec::new, |make| make(nodes))
    }
}

impl Debug for OwnTerms {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "OwnTerms({})", if self.exist() { "some" } else { "none" })
    }
}

/// Checks that `names`, of all terms of a run, can be keys of a record and a file.
///
/// # Errors
/// [`SetupError::TermName`] for the first that cannot.
pub(super) fn check_names(names: impl Iterator<Item = &'static str>) -> Result<(), SetupError> {
    let mut known = BTreeSet::new();
    for name in names {
        let plain = |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'_';
        if name.is_empty() || !name.bytes().all(plain) || !known.insert(name) {
            return Err(SetupError::TermName { name });
        }
    }
    Ok(())
}
