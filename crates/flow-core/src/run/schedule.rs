//! When frames are saved.

use super::scene::{Frames, Output, Spacing};

/// Decades of time over which logarithmic frames are spread before the end.
const DECADES: f64 = 12.0;

/// Times of the frames between the start and the end, which are always saved, increasing.
#[must_use]
pub fn frame_times(output: &Output, end: f64) -> Vec<f64> {
    let mut times = match &output.frames {
        Frames::At { times } => times.clone(),
        Frames::Spaced { frames, spacing } => {
            let part = |k: usize| k as f64 / *frames as f64;
            (1..*frames)
                .map(|k| match spacing {
                    Spacing::Linear => end * part(k),
                    Spacing::Log => end * 10f64.powf(DECADES * (part(k) - 1.0)),
                })
                .collect()
        }
    };
    // Times near the smallest number can round to the start, to the end, or to each other.
    times.retain(|time| *time > 0.0 && *time < end);
    times.dedup();
    times
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_increase_and_stay_inside() {
        for spacing in [Spacing::Linear, Spacing::Log] {
            let output = Output { frames: Frames::Spaced { frames: 5, spacing }, fields: Vec::new() };
            let times = frame_times(&output, 10.0);
            assert_eq!(times.len(), 4);
            assert!(times.windows(2).all(|pair| pair[0] < pair[1]));
            assert!(times[0] > 0.0 && times[3] < 10.0);
        }
    }

    #[test]
    fn frames_that_cannot_be_told_apart_are_one() {
        for spacing in [Spacing::Linear, Spacing::Log] {
            let output = Output { frames: Frames::Spaced { frames: 5, spacing }, fields: Vec::new() };
            assert!(frame_times(&output, 5e-324).is_empty());
        }
    }
}
