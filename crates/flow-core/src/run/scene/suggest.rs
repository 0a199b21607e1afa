//! "Did you mean": the nearest allowed name to a mistyped one.

/// Longer names than this are no typing mistakes of any name here.
const MAX_LENGTH: usize = 64;

/// The candidate nearest to `typed`, if it is near enough to be what was meant.
pub(super) fn nearest<'a>(typed: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    if typed.len() > MAX_LENGTH {
        return None;
    }
    let typed = normalised(typed);
    let scored = candidates.into_iter().filter_map(|name| Some((score(&typed, &normalised(name))?, name)));
    scored.min_by_key(|(score, _)| *score).map(|(_, name)| name)
}

/// Case, and the choice between `-`, `_` and a space, are not what a name is about.
fn normalised(name: &str) -> Vec<char> {
    name.chars().map(|c| if c == '-' || c == ' ' { '_' } else { c.to_ascii_lowercase() }).collect()
}

/// Number of typing mistakes between two names, if there are few for names of this length.
fn score(typed: &[char], name: &[char]) -> Option<usize> {
    let allowed = match typed.len().min(name.len()) {
        0..=2 => 0,
        3..=5 => 1,
        _ => 2,
    };
    let abbreviated =
        typed.len() >= 3 && (name.starts_with(typed) || typed.starts_with(name) && name.len() >= 3);
    match edit_distance(typed, name) {
        distance if distance <= allowed => Some(distance),
        _ => abbreviated.then_some(3),
    }
}

/// Edit distance with insertions, deletions, substitutions and swaps of neighbours.
fn edit_distance(a: &[char], b: &[char]) -> usize {
    let mut before_last: Vec<usize> = vec![0; b.len() + 1];
    let mut last: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut row = vec![i; b.len() + 1];
        for j in 1..=b.len() {
            let substitution = last[j - 1] + usize::from(a[i - 1] != b[j - 1]);
            row[j] = substitution.min(last[j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                row[j] = row[j].min(before_last[j - 2] + 1);
            }
        }
        before_last = std::mem::replace(&mut last, row);
    }
    last[b.len()]
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn typing_mistakes_are_recognised() {
        let keys = ["radius", "rigidity", "tolerance", "r", "x"];
        assert_eq!(nearest("raduis", keys), Some("radius"));
        assert_eq!(nearest("rigidty", keys), Some("rigidity"));
        assert_eq!(nearest("Tolerance", keys), Some("tolerance"));
        assert_eq!(nearest("tol", keys), Some("tolerance"));
        assert_eq!(nearest("y", keys), None);
        assert_eq!(nearest("colour", keys), None);
        assert_eq!(nearest(&"r".repeat(1 << 20), keys), None);
    }
}
