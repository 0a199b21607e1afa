//! How result files are cut into chunks, which tells their size.

/// Most values of a chunk, but for a single row: one read of 512 kB, yet a single frame is cheap.
const MOST_VALUES: usize = 1 << 16;

/// Rows in each chunk of `rows` rows of `row` values: chunks are of equal size, since the last one is padded to the size of the others.
pub(crate) fn chunk_rows(rows: usize, row: usize) -> usize {
    let count = rows.div_ceil((MOST_VALUES / row.max(1)).max(1));
    rows.div_ceil(count.max(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chunks_are_of_equal_size_and_none_is_too_large() {
        for (rows, row, chunk) in
            [(201, 8192, 8), (201, 64, 201), (3000, 64, 1000), (5, 100_000, 1), (0, 8, 0)]
        {
            assert_eq!(chunk_rows(rows, row), chunk, "{rows} rows of {row}");
        }
    }
}
