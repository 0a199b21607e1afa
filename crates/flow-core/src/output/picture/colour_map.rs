//! Colours: the map for values on a curve, and the few that lines have.

/// Red, green and blue, 0 to 255.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Colour(pub u8, pub u8, pub u8);

/// Axes and text.
pub(super) const INK: Colour = Colour(0x22, 0x22, 0x22);
/// The initial state.
pub(super) const FAINT: Colour = Colour(0x80, 0x80, 0x80);
/// Grid lines.
pub(super) const GRID: Colour = Colour(0xE4, 0xE4, 0xE4);
// Okabe and Ito's set, safe for colour-blind readers.
pub(super) const BLUE: Colour = Colour(0x00, 0x72, 0xB2);
pub(super) const VERMILION: Colour = Colour(0xD5, 0x5E, 0x00);
pub(super) const GREEN: Colour = Colour(0x00, 0x9E, 0x73);
pub(super) const PURPLE: Colour = Colour(0xA8, 0x50, 0x88);

/// Viridis (S. van der Walt, N. Smith, E. Firing, CC0) at 0, 1/16, …, 1.
const VIRIDIS: [[u8; 3]; 17] = [
    [68, 1, 84],
    [72, 24, 106],
    [71, 45, 123],
    [66, 64, 134],
    [59, 82, 139],
    [51, 99, 141],
    [44, 114, 142],
    [38, 130, 142],
    [33, 145, 140],
    [31, 160, 136],
    [40, 174, 128],
    [63, 188, 115],
    [94, 201, 98],
    [132, 212, 75],
    [173, 220, 48],
    [216, 226, 25],
    [253, 231, 37],
];

/// Colour of `value` in [0, 1].
pub(super) fn viridis(value: f64) -> Colour {
    let position = value.clamp(0.0, 1.0) * 16.0;
    let left = (position as usize).min(15);
    let weight = position - left as f64;
    let [r, g, b] = std::array::from_fn(|k| {
        let (from, to) = (f64::from(VIRIDIS[left][k]), f64::from(VIRIDIS[left + 1][k]));
        (from + weight * (to - from)).round() as u8
    });
    Colour(r, g, b)
}
