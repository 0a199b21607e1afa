//! Fills a cyclic banded matrix in: each entry has its place in the band of a segment, or beside it where the segment is left.

use super::super::band_factors::{LANES, Lane};
use super::{CyclicBanded, Holds};

impl<const B: usize> CyclicBanded<B> {
    /// Sets every entry to zero, ready to be filled again.
    pub fn clear(&mut self) {
        self.holds = Holds::Entries;
        self.factors.clear();
        for lane in 0..LANES {
            let unit_rows = if lane < self.segments { self.padding(lane) } else { self.places() };
            (0..unit_rows).for_each(|row| self.factors.from(row, 0)[0][lane] = 1.0);
        }
    }

    /// Sets the entry in `row` and column `row + offset` (cyclic), |`offset`| ≤ `B`.
    ///
    /// # Panics
    /// If there is no such row, the offset is larger, or the matrix was factorised and not cleared since.
    pub fn set(&mut self, row: usize, offset: isize, value: f64) {
        self.check_open();
        let inside = row < self.rows && offset.unsigned_abs() <= B;
        assert!(inside, "offset {offset} in row {row} of {} with {B} bands on each side", self.rows);
        let column = (row as isize + offset).rem_euclid(self.rows as isize) as usize;
        let ((segment, r), (column_segment, c)) = (self.locate(row), self.locate(column));
        let factors = &mut self.factors;
        if segment == column_segment && c as isize - r as isize == offset {
            factors.from(r, offset)[0][segment] = value;
        } else if offset < 0 {
            factors.right[r][c - factors.interior][segment] = value;
        } else {
            factors.bottom[c][r - factors.interior][column_segment] = value;
        }
    }

    /// Sets consecutive entries of `row`, the first in column `row + first` (cyclic), none beyond the band.
    ///
    /// # Panics
    /// If there is no such row, there are values beyond the band, or the matrix was factorised and not cleared since.
    pub fn set_row(&mut self, row: usize, first: isize, values: &[f64]) {
        self.check_open();
        self.check_inside(row < self.rows, first, values.len());
        let (segment, r) = self.locate(row);
        let start = r as isize + first;
        if start < self.padding(segment) as isize || start as usize + values.len() > self.places() {
            for (k, value) in values.iter().enumerate() {
                self.set(row, first + k as isize, *value);
            }
            return;
        }
        for (entry, value) in self.factors.from(r, first).iter_mut().zip(values) {
            entry[segment] = *value;
        }
    }

    /// Sets consecutive entries of the rows at `place` in all segments, the first in the column `first` after the row, none beyond
    /// the band.
    ///
    /// # Panics
    /// As [`CyclicBanded::set_row`] does, of places.
    pub fn set_rows(&mut self, place: usize, first: isize, values: &[Lane]) {
        self.check_open();
        self.check_inside(place < self.places(), first, values.len());
        let (start, longest, interior) = (place as isize + first, self.places(), self.factors.interior);
        if self.segments == LANES && start >= self.block as isize && start as usize + values.len() <= longest
        {
            return self.factors.from(place, first)[..values.len()].copy_from_slice(values);
        }
        for lane in 0..self.segments {
            let next = (lane + 1) % self.segments;
            let [padding, next_padding] = [lane, next].map(|lane| self.padding(lane));
            if place < padding {
                continue;
            }
            for (k, value) in values.iter().enumerate() {
                let column = start + k as isize;
                let entry = if column < padding as isize {
                    &mut self.factors.right[place][(column + B as isize) as usize - padding][lane]
                } else if column as usize >= longest {
                    &mut self.factors.bottom[column as usize - longest + next_padding][place - interior][next]
                } else {
                    &mut self.factors.from(place, first + k as isize)[0][lane]
                };
                *entry = value[lane];
            }
        }
    }

    /// Panics if the entries are gone, into their factors.
    pub(super) fn check_open(&self) {
        assert!(
            self.holds == Holds::Entries,
            "the matrix was factorised: clear it before it is filled in again"
        );
    }

    /// Panics unless the row exists, and `count` entries from the column `first` after the diagonal on are those of a band.
    fn check_inside(&self, exists: bool, first: isize, count: usize) {
        let inside = exists && -first <= B as isize && first + count as isize <= B as isize + 1;
        assert!(
            inside,
            "{count} entries from offset {first} in a row of {} with {B} bands on each side",
            self.rows
        );
    }
}
