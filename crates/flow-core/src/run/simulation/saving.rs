//! Saves the frames of the schedule, as long as there is room for them.

use std::time::Instant;

use super::Simulation;
use crate::geometry::Layout;
use crate::integrator::Stepper;
use crate::run::limits::{MOST_FRAME_BYTES, check_frames};
use crate::run::setup_error::SetupError;

/// Room for frames.
#[derive(Debug)]
pub(super) struct FrameRoom {
    /// The most nodes of a frame so far, on which all frames end.
    nodes: usize,
    /// Bytes that the frames may take there.
    bytes: f64,
}

impl FrameRoom {
    /// That of a run which has frames on `nodes` nodes at most so far.
    pub fn new(nodes: usize) -> Self {
        Self { nodes, bytes: MOST_FRAME_BYTES }
    }
}

impl Simulation {
    /// Saves the frames before `now`, which lie in the last step, and says if there is no room for the next one.
    ///
    /// # Errors
    /// [`SetupError::TooMuchOutput`]; the frame is not saved then.
    pub(super) fn save_frames(&mut self, now: f64) -> Result<(), SetupError> {
        while let Some(time) = self.next_frame().filter(|time| *time < now) {
            let clock = Instant::now();
            self.check_room(1, self.layout())?;
            let integrals = self.integration.stepper().interpolate(time, &mut self.on.scratch);
            let frame = self.on.frame(time, integrals, &self.start, None);
            self.record.frames.push(frame);
            self.scheduled_frames += 1;
            self.frame_room.nodes = self.frame_room.nodes.max(self.layout().nodes());
            self.clocks.frames += clock.elapsed().as_secs_f64();
        }
        Ok(())
    }

    /// Time of the next frame of the schedule.
    fn next_frame(&self) -> Option<f64> {
        self.frame_times.get(self.scheduled_frames - 1).copied()
    }

    /// Checks the room for the frames so far and `more`, on the nodes of `layout`, or the most nodes of a frame if these are more.
    ///
    /// # Errors
    /// [`SetupError::TooMuchOutput`].
    pub(super) fn check_room(&self, more: usize, layout: Layout) -> Result<(), SetupError> {
        let nodes = layout.nodes().max(self.frame_room.nodes);
        let (frames, layout) = (self.record.frames.len() + more, Layout::new(nodes, layout.densities()));
        check_frames(frames, layout, self.record.fields.len(), self.frame_room.bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::limits::frame_bytes;
    use crate::run::scene::{Frames, Spacing};
    use crate::run::{Failure, Quiet, Scene};

    fn scene(name: &str, frames: usize) -> Scene {
        let (_, text) = Scene::shipped().iter().find(|(shipped, _)| *shipped == name).unwrap();
        let mut scene = Scene::parse_with(text, name, &[("accuracy.nodes".into(), "'auto'".into())]).unwrap();
        scene.output.frames = Frames::Spaced { frames, spacing: Spacing::Linear };
        scene
    }

    fn failure(simulation: &Simulation) -> (usize, usize) {
        let Some(Failure::Limit { error: SetupError::TooMuchOutput { frames, nodes, bytes, limit }, .. }) =
            simulation.failure()
        else {
            panic!("{:?}", simulation.failure())
        };
        assert!(bytes > limit);
        (*frames, *nodes)
    }

    #[test]
    fn a_run_stops_before_the_frame_that_has_no_room_and_keeps_the_others() {
        let mut simulation = Simulation::new(&scene("three_fold", 10_000)).unwrap();
        let layout = simulation.layout();
        simulation.frame_room.bytes = frame_bytes(40, Layout::new(2 * layout.nodes(), 1), 0);
        while simulation.step(&mut Quiet) {}
        let (frames, nodes) = failure(&simulation);
        assert_eq!(nodes, simulation.frame_room.nodes.max(simulation.layout().nodes()));
        // The state at which it stops is a frame of its own.
        assert_eq!(simulation.frames().len(), frames);
        let record = simulation.into_record();
        assert!(record.frames.len() > 20 && record.stop_reason.message().contains("GB"), "{record:?}");
    }

    #[test]
    fn a_run_stops_where_more_nodes_leave_no_room_for_its_frames() {
        let mut simulation = Simulation::new(&scene("three_fold_sharp", 1)).unwrap();
        let first = simulation.layout();
        simulation.frame_room.bytes = frame_bytes(2, first, 0);
        while simulation.step(&mut Quiet) {}
        let (frames, nodes) = failure(&simulation);
        assert!(frames == 2 && nodes > first.nodes(), "{frames} frames on {nodes} nodes");
        assert_eq!(simulation.layout().nodes(), first.nodes(), "the nodes were not taken");
    }
}
