//! Reads a result file back into a [`Record`], recognising files that are foreign, truncated or damaged.

use std::path::Path;

use hdf5_metno::types::VarLenUnicode;
use hdf5_metno::{Error, File, Group, H5Type, Result as Hdf5Result};

use super::bounds::{Bounds, check_links};
use super::layout::{
    CAUSES, CONVENTIONS, COUNTERS, FRAME_VALUES, NAMED_FIELDS, NAMED_VALUES, NODAL_FIELDS, STEP_VALUES,
};
use super::numbers;
use super::opening::{Opened, open};
use super::provenance::{OWN_TERMS, checksum, rejections_name};
use super::seconds;
use crate::output::StorageError;
use crate::run::{Counters, Frame, Provenance, Record, Rejections, Seconds, StepLog, StopReason};

/// Reads the result file `path`.
/// # Errors
/// [`StorageError::System`] if the file cannot be read at all, [`StorageError::NotUtf8`], otherwise [`StorageError::NotHdf5`],
/// [`StorageError::Foreign`] or [`StorageError::Damaged`].
pub fn read(path: &Path) -> Result<Record, StorageError> {
    let damaged = |item: &str, source: Error| StorageError::Damaged {
        path: path.to_path_buf(),
        item: item.to_owned(),
        source: Box::new(source),
    };
    let foreign = |found| StorageError::Foreign { path: path.to_path_buf(), found, expected: CONVENTIONS };
    let (file, bytes) = open(path, &damaged, &foreign)?;
    let bounds = Bounds::of(bytes);
    match conventions(&file.content).map_err(|source| damaged("its attributes", source))? {
        Some(found) if found == CONVENTIONS => {}
        found => return Err(foreign(found)),
    }
    Content { file, bounds }.record().map_err(|(item, source)| damaged(&item, source))
}

/// What could not be read, and why.
type Failure = (String, Error);

/// An open result file.
struct Content {
    file: Opened,
    bounds: Bounds,
}

impl Content {
    fn record(&self) -> Result<Record, Failure> {
        self.check_groups()?;
        let mut record = Record {
            title: self.text("title")?,
            scene: self.text("scene")?,
            resolved_scene: self.text("resolved_scene")?,
            energy_terms: self.names("energy_terms")?,
            own_terms: self.names(OWN_TERMS)?,
            densities: self.names("densities")?,
            fields: self.names("fields")?,
            diagnostics: self.names("diagnostics")?,
            frames: Vec::new(),
            steps: self.steps()?,
            counters: self.counters()?,
            seconds: Seconds::default(),
            stop_reason: self.stop_reason()?,
            provenance: self.provenance()?,
        };
        if self.number::<u64>("text_checksum")? != checksum(&record) {
            return Err(("the texts in its attributes".to_owned(), "the checksum differs".into()));
        }
        if !record.own_terms.iter().all(|name| record.energy_terms.contains(name)) {
            return Err((OWN_TERMS.to_owned(), "it names a term that the run does not have".into()));
        }
        record.seconds = seconds::read(&self.file.content, &record.energy_terms)?;
        record.frames = self.frames(&record)?;
        // Files from before this checksum do not have it.
        if self.has_attribute(numbers::NAME)?
            && self.number::<u32>(numbers::NAME)? != numbers::checksum(&record)
        {
            return Err(("its numbers".to_owned(), "the checksum differs".into()));
        }
        Ok(record)
    }

    /// Every group that is read holds what it names.
    fn check_groups(&self) -> Result<(), Failure> {
        let named = NAMED_VALUES.iter().map(|list| list.group);
        let named = named.chain(NAMED_FIELDS.iter().map(|list| list.group));
        let others = ["steps", "steps/rejections"].into_iter().chain(seconds::groups(&self.file.content));
        for name in ["/"].into_iter().chain(named).chain(others) {
            let checked = self.file.content.group(name).and_then(|group| check_links(&group));
            checked.map_err(|source| (format!("the group {name}"), source))?;
        }
        Ok(())
    }

    fn frames(&self, record: &Record) -> Result<Vec<Frame>, Failure> {
        let nodes = self.values::<f64>("parameter", None)?.len();
        let (count, of_frames) = self.columns(FRAME_VALUES.iter().map(|entry| entry.name.to_owned()))?;
        let mut frames = vec![Frame::default(); count]; // now that there is data for so many
        for (entry, values) in FRAME_VALUES.iter().zip(of_frames) {
            frames.iter_mut().zip(values).for_each(|(frame, value)| *(entry.slot)(frame) = value);
        }
        for list in NAMED_VALUES {
            for name in (list.names)(record) {
                let values = self.values(&format!("{}/{name}", list.group), Some(count))?;
                frames.iter_mut().zip(values).for_each(|(frame, value)| (list.slot)(frame).push(value));
            }
        }
        for entry in NODAL_FIELDS {
            let values = self.values(entry.name, Some(count * nodes))?;
            rows(&mut frames, &values, nodes, |frame, row| *(entry.slot)(frame) = row.to_vec());
        }
        let position = self.values("position", Some(count * nodes * 2))?;
        rows(&mut frames, &position, nodes * 2, |frame, row| frame.position = row.as_chunks().0.to_vec());
        for list in NAMED_FIELDS {
            for name in (list.names)(record) {
                let values = self.values(&format!("{}/{name}", list.group), Some(count * nodes))?;
                rows(&mut frames, &values, nodes, |frame, row| (list.slot)(frame).push(row.to_vec()));
            }
        }
        Ok(frames)
    }

    fn steps(&self) -> Result<StepLog, Failure> {
        let names = STEP_VALUES.iter().map(|entry| format!("steps/{}", entry.name));
        let (count, of_steps) = self.columns(names)?;
        let mut steps = StepLog { rejections: vec![Rejections::default(); count], ..StepLog::default() };
        for (entry, values) in STEP_VALUES.iter().zip(of_steps) {
            *(entry.slot)(&mut steps) = values;
        }
        steps.order = self.values("steps/order", Some(count))?;
        steps.nodes = self.values("steps/nodes", Some(count))?;
        for cause in CAUSES {
            let counts = self.values(&format!("steps/rejections/{}", cause.name), Some(count))?;
            let all = steps.rejections.iter_mut().zip(counts);
            all.for_each(|(rejections, count)| *(cause.slot)(rejections) = count);
        }
        Ok(steps)
    }

    fn counters(&self) -> Result<Counters, Failure> {
        let integration_seconds = self.number("integration_seconds")?;
        let mut counters = Counters { integration_seconds, ..Counters::default() };
        for counter in COUNTERS {
            *(counter.slot)(&mut counters) = self.number(counter.name)?;
        }
        for cause in CAUSES {
            *(cause.slot)(&mut counters.rejections) = self.number(&rejections_name(cause.name))?;
        }
        Ok(counters)
    }

    fn stop_reason(&self) -> Result<StopReason, Failure> {
        let name = self.text("stop_reason")?;
        let failed = StopReason::Failed(self.text("message")?);
        [StopReason::EndTime, StopReason::Equilibrium, StopReason::Contact, StopReason::Interrupted, failed]
            .into_iter()
            .find(|reason| reason.name() == name)
            .ok_or_else(|| ("stop_reason".to_owned(), format!("it is \"{name}\"").into()))
    }

    fn provenance(&self) -> Result<Provenance, Failure> {
        let commit = self.has_attribute("commit")?.then(|| self.text("commit"));
        Ok(Provenance {
            version: self.text("curveflow_version")?,
            commit: commit.transpose()?,
            machine: self.text("machine")?,
            citation: self.text("citation")?,
        })
    }

    fn has_attribute(&self, name: &str) -> Result<bool, Failure> {
        let names = self.file.content.attr_names();
        let names = names.map_err(|source| ("the names of its attributes".to_owned(), source))?;
        Ok(names.iter().any(|found| found == name))
    }

    /// All values of a dataset, `expected` of them unless that is not known yet.
    fn values<T: H5Type>(&self, name: &str, expected: Option<usize>) -> Result<Vec<T>, Failure> {
        let values = self.file.content.dataset(name).and_then(|dataset| self.bounds.read(&dataset));
        let values: Vec<T> = values.map_err(|source| (format!("/{name}"), source))?;
        match expected {
            Some(expected) if values.len() != expected => {
                let reason = format!("it holds {} values, expected {expected}", values.len());
                Err((format!("/{name}"), reason.into()))
            }
            _ => Ok(values),
        }
    }

    /// All values of the datasets `names`, as many in each as in the first, and how many. Each is read once: what is read counts
    /// against the size of the file.
    fn columns(&self, names: impl Iterator<Item = String>) -> Result<(usize, Vec<Vec<f64>>), Failure> {
        let (mut columns, mut expected) = (Vec::new(), None);
        for name in names {
            let values: Vec<f64> = self.values(&name, expected)?;
            expected = Some(values.len());
            columns.push(values);
        }
        Ok((expected.unwrap_or_default(), columns))
    }

    fn text(&self, name: &str) -> Result<String, Failure> {
        text(&self.file.content, name).map_err(|source| (name.to_owned(), source))
    }

    fn number<T: H5Type>(&self, name: &str) -> Result<T, Failure> {
        let number = self.file.content.attr(name).and_then(|attribute| attribute.read_scalar());
        number.map_err(|source| (name.to_owned(), source))
    }

    /// A list of names; an empty one is not in the file.
    fn names(&self, name: &str) -> Result<Vec<String>, Failure> {
        let read = || -> Hdf5Result<Vec<String>> {
            if !self.file.content.attr_names()?.iter().any(|found| found == name) {
                return Ok(Vec::new());
            }
            let names: Vec<VarLenUnicode> = self.file.content.attr(name)?.read_raw()?;
            if names.iter().any(|name| name.contains('/')) {
                return Err("a name holds a slash".into());
            }
            Ok(names.iter().map(|name| name.as_str().to_owned()).collect())
        };
        read().map_err(|source| (name.to_owned(), source))
    }
}

/// What the file says that it is, if it says so.
fn conventions(file: &File) -> Hdf5Result<Option<String>> {
    const NAME: &str = "Conventions";
    if file.attr_names()?.iter().any(|name| name == NAME) { text(file, NAME).map(Some) } else { Ok(None) }
}

fn text(group: &Group, name: &str) -> Hdf5Result<String> {
    Ok(group.attr(name)?.read_scalar::<VarLenUnicode>()?.as_str().to_owned())
}

fn rows(frames: &mut [Frame], values: &[f64], length: usize, set: impl Fn(&mut Frame, &[f64])) {
    if length > 0 {
        frames.iter_mut().zip(values.chunks_exact(length)).for_each(|(frame, row)| set(frame, row));
    }
}
