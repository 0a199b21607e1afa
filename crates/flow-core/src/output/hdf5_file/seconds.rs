//! The group `/seconds`: where the wall time of the run went, as attributes.

use hdf5_metno::{Error, File, Group, Result as Hdf5Result};

use super::dataset::building;
use super::layout::EVALUATIONS;
use super::provenance::write_number;
use crate::output::StorageError;
use crate::run::{EvaluationSeconds, Seconds, Spending};

const GROUP: &str = "seconds";
const PARTS: &str = "evaluations";

/// Writes `seconds`, with those of each of `terms`.
pub(super) fn write(file: &File, seconds: &Seconds, terms: &[String]) -> Result<(), StorageError> {
    let group = file.create_group(GROUP).map_err(building(GROUP))?;
    for (name, value) in seconds.by_activity() {
        write_number(&group, name, &value)?;
    }
    let parts = group.create_group(PARTS).map_err(building(PARTS))?;
    for entry in EVALUATIONS {
        write_number(&parts, entry.name, (entry.get)(&seconds.evaluations))?;
    }
    for (name, value) in terms.iter().zip(&seconds.evaluations.terms) {
        write_number(&parts, name, value)?;
    }
    Ok(())
}

/// Paths of the groups that `file` has for them.
pub(super) fn groups(file: &File) -> Vec<&'static str> {
    if file.link_exists(GROUP) { vec![GROUP, "seconds/evaluations"] } else { Vec::new() }
}

/// Reads them back; all are zero in a file that does not have them, because nothing was measured.
pub(super) fn read(file: &File, terms: &[String]) -> Result<Seconds, (String, Error)> {
    if !file.link_exists(GROUP) {
        return Ok(Seconds::default());
    }
    let read = || -> Hdf5Result<Seconds> {
        let group = file.group(GROUP)?;
        let parts = group.group(PARTS)?;
        let mut seconds = Seconds::new(|_| 0.0, of_evaluations(&parts, terms)?);
        for spending in Spending::ALL {
            seconds[spending] = number(&group, spending.name())?;
        }
        Ok(seconds)
    };
    read().map_err(|source| (format!("/{GROUP}"), source))
}

fn of_evaluations(group: &Group, terms: &[String]) -> Hdf5Result<EvaluationSeconds> {
    let terms = terms.iter().map(|name| number(group, name)).collect::<Hdf5Result<_>>()?;
    let mut seconds = EvaluationSeconds { terms, ..EvaluationSeconds::default() };
    for entry in EVALUATIONS {
        *(entry.slot)(&mut seconds) = number(group, entry.name)?;
    }
    Ok(seconds)
}

fn number(group: &Group, name: &str) -> Hdf5Result<f64> {
    group.attr(name)?.read_scalar()
}
