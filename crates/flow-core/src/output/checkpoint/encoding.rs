//! Writes a checkpoint piece by piece: it takes no memory beside that of the run, which may have left none.

use std::io::{self, BufWriter, Write};

use serde::Serialize;

use super::format::{FOOTER, MAGIC, SceneTexts, VERSION};
use super::identity::{Identity, Tally};
use crate::run::{Frame, Memory, Record, Simulation, StepLog};

/// Bytes that are written at once.
const BUFFER: usize = 1 << 20;

/// What a checkpoint holds.
pub(super) struct Content<'a> {
    scene: SceneTexts,
    memory: &'a Memory,
    frames: &'a [Frame],
    steps: &'a StepLog,
    replaces: Option<Identity>,
}

impl<'a> Content<'a> {
    /// That of `simulation`, which has left `memory` behind and may replace the result `replaces`.
    pub fn of(simulation: &'a Simulation, memory: &'a Memory, replaces: Option<Identity>) -> Self {
        let (given, resolved) = simulation.scene_texts();
        let scene = SceneTexts { given: given.to_owned(), resolved: resolved.to_owned() };
        Self { scene, memory, frames: simulation.frames(), steps: simulation.steps(), replaces }
    }

    /// That of a run that is over and has become `record`. Its frames are all on the largest number of nodes, as those of a record that
    /// is made from the checkpoint will be anyway.
    pub fn of_ended(record: &'a Record, memory: &'a Memory, replaces: Option<Identity>) -> Self {
        let scene = SceneTexts { given: record.scene.clone(), resolved: record.resolved_scene.clone() };
        Self { scene, memory, frames: &record.frames, steps: &record.steps, replaces }
    }

    /// Magic, version, sections, footer.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write_to(&self, out: &mut dyn Write) -> io::Result<()> {
        let out = &mut BufWriter::with_capacity(BUFFER, out);
        out.write_all(MAGIC)?;
        out.write_all(&VERSION.to_le_bytes())?;
        section(out, &self.scene)?;
        section(out, self.memory)?;
        section(out, &self.frames[..self.memory.frames()])?;
        section(out, self.steps)?;
        section(out, &self.replaces)?;
        out.write_all(FOOTER)?;
        out.flush()
    }
}

/// The bytes of the checkpoint of `simulation`.
///
/// # Panics
/// If they do not fit into memory.
#[must_use]
pub fn encode(simulation: &Simulation) -> Vec<u8> {
    let mut bytes = Vec::new();
    let written = Content::of(simulation, &simulation.memory(), None).write_to(&mut bytes);
    written.expect("writing to memory does not fail");
    bytes
}

/// Length, checksum, content. It is encoded twice, first for its length and checksum, which come before it.
fn section<T: Serialize + ?Sized>(out: &mut impl Write, value: &T) -> io::Result<()> {
    let mut tally = BufWriter::with_capacity(BUFFER, Tally::default());
    serialise(value, &mut tally)?;
    let Identity { bytes, checksum } = tally.into_inner()?.identity();
    out.write_all(&bytes.to_le_bytes())?;
    out.write_all(&checksum.to_le_bytes())?;
    serialise(value, out)
}

fn serialise<T: Serialize + ?Sized>(value: &T, out: &mut impl Write) -> io::Result<()> {
    let mut kept = Kept { out, reason: None };
    let written = postcard::to_io(value, &mut kept).map(drop);
    written.map_err(|error| kept.reason.unwrap_or_else(|| io::Error::other(error)))
}

/// Keeps the reason why `out` refused bytes, which the encoder forgets.
struct Kept<W> {
    out: W,
    reason: Option<io::Error>,
}

impl<W: Write> Write for Kept<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.out.write(bytes).map_err(|reason| {
            let kind = reason.kind();
            self.reason = Some(reason);
            kind.into()
        })
    }

    /// The encoder asks for it at the end of a value, which is not that of the file.
    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::Scene;

    /// A disk with room for so many bytes.
    struct Disk(usize);

    impl Write for Disk {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            self.0 = self.0.checked_sub(bytes.len()).ok_or(io::ErrorKind::StorageFull)?;
            Ok(bytes.len())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn wherever_the_disk_is_full_it_is_said() {
        let (name, text) = Scene::shipped().iter().find(|(name, _)| *name == "circle").unwrap();
        let simulation = Simulation::new(&Scene::parse(text, name).unwrap()).unwrap();
        let memory = simulation.memory();
        let content = Content::of(&simulation, &memory, None);
        let needed = encode(&simulation).len();
        content.write_to(&mut Disk(needed)).unwrap();
        for room in (0..needed).step_by(100).chain([needed - 1]) {
            let reason = content.write_to(&mut Disk(room)).unwrap_err();
            assert_eq!(reason.kind(), io::ErrorKind::StorageFull, "{room} of {needed} bytes");
        }
    }
}
