//! Counts in a scene that is written out. The integers of TOML end at 2^63 − 1: a larger count, which only a program can
//! give, is written as that, so that it is refused like any other that is too large.

use serde::Serializer;

/// Writes a count.
pub(super) fn serialize_count<C, S>(count: &C, serializer: S) -> Result<S::Ok, S::Error>
where
    C: Copy + TryInto<i64>,
    S: Serializer,
{
    serializer.serialize_i64((*count).try_into().unwrap_or(i64::MAX))
}

/// Writes a count that may be left out.
pub(super) fn serialize_given_count<C, S>(count: &C, serializer: S) -> Result<S::Ok, S::Error>
where
    C: Copy + Into<Option<u64>>,
    S: Serializer,
{
    match (*count).into() {
        Some(count) => serialize_count(&count, serializer),
        None => serializer.serialize_none(),
    }
}
