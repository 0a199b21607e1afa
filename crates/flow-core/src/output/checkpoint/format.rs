//! The bytes of a checkpoint: magic, version, sections with length and CRC-32, footer.

use std::error::Error;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::identity::Identity;
use crate::energies::EnergyTerm;
use crate::output::StorageError;
use crate::run::{Frame, Memory, ResumeError, Scene, Simulation, StepLog};

pub(super) const MAGIC: &[u8; 8] = b"\x89CFCKPT\n";
pub(super) const FOOTER: &[u8; 8] = b"CFCKEND\n";
/// Changes when what the sections hold changes.
pub(super) const VERSION: u32 = 13;
const SECTIONS: usize = 5;

/// A run that can go on.
#[derive(Clone, Debug, PartialEq)]
pub struct Checkpoint {
    /// The scene as given and as resolved.
    pub scene: SceneTexts,
    /// The state of the simulation.
    pub memory: Memory,
    /// Frames saved so far.
    pub frames: Vec<Frame>,
    /// Log of the steps so far.
    pub steps: StepLog,
    /// The result that the run may replace, if it was told so when it began.
    pub replaces: Option<Identity>,
}

/// The scene of a run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct SceneTexts {
    /// As given, verbatim.
    pub given: String,
    /// With every default and automatic choice filled in, and no reference to other files.
    pub resolved: String,
}

/// A scene that is not that of a checkpoint.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OtherScene {
    /// The first key that differs; none if the scene of the checkpoint cannot be read by this version.
    pub key: Option<String>,
}

/// The checkpoint that `bytes`, read from `path`, hold.
///
/// # Errors
/// [`StorageError::NotACheckpoint`] if they are something else, [`StorageError::DamagedCheckpoint`] if a checksum does not fit.
pub fn decode(bytes: &[u8], path: &Path) -> Result<Checkpoint, StorageError> {
    let head = MAGIC.len() + size_of::<u32>();
    let is_ours =
        bytes.len() >= head && bytes.starts_with(MAGIC) && bytes[MAGIC.len()..head] == VERSION.to_le_bytes();
    if !is_ours {
        return Err(StorageError::NotACheckpoint { path: path.to_path_buf() });
    }
    let mut rest = &bytes[head..];
    let mut sections: [&[u8]; SECTIONS] = [&[]; SECTIONS];
    for (section, name) in sections.iter_mut().zip(["scene", "memory", "frames", "steps", "replaces"]) {
        *section = take_section(&mut rest).ok_or_else(|| damaged(path, name, "the checksum does not fit"))?;
    }
    if rest != FOOTER {
        return Err(damaged(path, "the end", "there is something else"));
    }
    let [scene, memory, frames, steps, replaces] = sections;
    Ok(Checkpoint {
        scene: from_bytes(scene, path, "scene")?,
        memory: from_bytes(memory, path, "memory")?,
        frames: from_bytes(frames, path, "frames")?,
        steps: from_bytes(steps, path, "steps")?,
        replaces: from_bytes(replaces, path, "replaces")?,
    })
}

fn take_section<'a>(rest: &mut &'a [u8]) -> Option<&'a [u8]> {
    let (length, after) = rest.split_first_chunk::<8>()?;
    let (checksum, after) = after.split_first_chunk::<4>()?;
    let length = usize::try_from(u64::from_le_bytes(*length)).ok()?;
    let section = after.get(..length)?;
    *rest = &after[length..];
    (crc32fast::hash(section) == u32::from_le_bytes(*checksum)).then_some(section)
}

fn from_bytes<'a, T: Deserialize<'a>>(section: &'a [u8], path: &Path, name: &str) -> Result<T, StorageError> {
    postcard::from_bytes(section).map_err(|error| damaged(path, name, error))
}

fn damaged(path: &Path, item: &str, source: impl Into<Box<dyn Error + Send + Sync>>) -> StorageError {
    StorageError::DamagedCheckpoint { path: path.to_path_buf(), item: item.to_owned(), source: source.into() }
}

impl Checkpoint {
    /// Goes on as a run of `scene`, if that would have come here too: it holds the same as the scene of the checkpoint, but may allow
    /// another number of steps (`time.max_steps`), not below those so far.
    ///
    /// # Errors
    /// [`OtherScene`], with the first key that differs.
    pub fn take_scene(&mut self, scene: &Scene) -> Result<(), OtherScene> {
        let own = Scene::parse(&self.scene.resolved, "the scene of the checkpoint");
        let own = own.map_err(|_| OtherScene { key: None })?;
        let Some(key) = own.first_difference(scene) else { return Ok(()) };
        let allowed = scene.time.max_steps.is_none_or(|most| most >= self.memory.steps());
        if !allowed || !own.is_but_for_steps(scene) {
            return Err(OtherScene { key: Some(key) });
        }
        self.scene = SceneTexts { given: scene.text().to_owned(), resolved: scene.to_toml() };
        Ok(())
    }

    /// The simulation that was saved; `path` is for messages.
    ///
    /// # Errors
    /// [`StorageError::ForeignCheckpoint`] if the scene or the state cannot be used, or the run has terms from outside the scene.
    pub fn simulation(self, path: &Path) -> Result<Simulation, StorageError> {
        self.resumed(path, Simulation::resume)
    }

    /// The same of a run that was made by [`Simulation::with_terms`]: `terms` makes the same terms.
    ///
    /// # Errors
    /// [`StorageError::ForeignCheckpoint`] if the scene, the state or these terms cannot be used.
    pub fn simulation_with_terms(
        self,
        path: &Path,
        terms: impl Fn(usize) -> Vec<Box<dyn EnergyTerm>> + Send + Sync + 'static,
    ) -> Result<Simulation, StorageError> {
        self.resumed(path, |scene, memory, frames, steps| {
            Simulation::resume_with_terms(scene, terms, memory, frames, steps)
        })
    }

    fn resumed(
        self,
        path: &Path,
        resume: impl FnOnce(&Scene, Memory, Vec<Frame>, StepLog) -> Result<Simulation, ResumeError>,
    ) -> Result<Simulation, StorageError> {
        let foreign = |reason: String| StorageError::ForeignCheckpoint { path: path.to_path_buf(), reason };
        let scene = Scene::parse(&self.scene.resolved, "the scene of the checkpoint");
        let scene = scene.map_err(|error| foreign(error.to_string()))?.with_text(self.scene.given);
        resume(&scene, self.memory, self.frames, self.steps).map_err(|error| foreign(error.to_string()))
    }
}
