//! Where two scenes differ, by what they hold and not by how they are written.

use toml::{Table, Value};

use super::document::Scene;

impl Scene {
    /// The first key, in the order of the alphabet, whose value is another one in `other`: `accuracy.tolerance`, `density.0.initial`.
    /// None if a run of either is a run of both. Defaults that are written out, comments, order and where points come from are no
    /// difference.
    ///
    /// ```
    /// use flow_core::run::Scene;
    ///
    /// let (_, text) = Scene::shipped().iter().find(|(name, _)| *name == "circle").unwrap();
    /// let scene = Scene::parse(text, "circle")?;
    /// assert_eq!(scene.first_difference(&Scene::parse(&format!("# the same\n{text}"), "circle")?), None);
    /// let longer = Scene::parse_with(text, "circle", &[("time.end".into(), "7".into())])?;
    /// assert_eq!(scene.first_difference(&longer).as_deref(), Some("time.end"));
    /// # Ok::<(), flow_core::run::SceneError>(())
    /// ```
    #[must_use]
    pub fn first_difference(&self, other: &Self) -> Option<String> {
        if self.has_values_of(other) { None } else { in_tables(&self.table(), &other.table()) }
    }

    /// Whether it is `other` but for how many steps a run may take (`time.max_steps`).
    pub(crate) fn is_but_for_steps(&self, other: &Self) -> bool {
        let mut levelled = self.clone();
        levelled.time.max_steps = other.time.max_steps;
        levelled.first_difference(other).is_none()
    }

    fn table(&self) -> Table {
        Table::try_from(self).unwrap_or_default() // every scene can be written as TOML
    }
}

/// The first key that has another value, or none, in one of the tables.
fn in_tables(one: &Table, other: &Table) -> Option<String> {
    let mut keys: Vec<&String> = one.keys().chain(other.keys()).collect();
    keys.sort();
    keys.into_iter().find_map(|key| match (one.get(key), other.get(key)) {
        (Some(a), Some(b)) => in_values(key, a, b),
        _ => Some(key.clone()),
    })
}

/// The path to what differs in the values of `key`, if anything does.
fn in_values(key: &str, one: &Value, other: &Value) -> Option<String> {
    match (one, other) {
        (Value::Table(a), Value::Table(b)) => in_tables(a, b).map(|inner| format!("{key}.{inner}")),
        // Lists of tables are told by their entries; of points or times, the list is enough.
        (Value::Array(a), Value::Array(b)) if a.len() == b.len() && a.iter().all(Value::is_table) => {
            let mut entries = a.iter().zip(b).enumerate();
            entries.find_map(|(index, (a, b))| in_values(&format!("{key}.{index}"), a, b))
        }
        (a, b) => (a != b).then(|| key.to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn three_fold(changes: &[(&str, &str)]) -> Scene {
        let (name, text) = Scene::shipped().iter().find(|(name, _)| *name == "three_fold").unwrap();
        let changes: Vec<_> = changes.iter().map(|(key, value)| ((*key).into(), (*value).into())).collect();
        Scene::parse_with(text, name, &changes).unwrap()
    }

    #[test]
    fn the_first_key_that_differs_is_named() {
        let scene = three_fold(&[]);
        let written_out = Scene::parse(&scene.to_toml(), "again").unwrap();
        assert_eq!(scene.first_difference(&written_out), None);
        for (change, named) in [
            (("time.max_steps", "7"), "time.max_steps"),
            (("density.0.initial", "'0.4'"), "density.0.initial"),
            (("curve", "{ shape = 'circle', radius = 1 }"), "curve.radius"),
            (("output.fields", "['normal-force']"), "output.fields"),
            (("title", "'another'"), "title"),
        ] {
            let other = three_fold(&[change]);
            assert_eq!(scene.first_difference(&other).as_deref(), Some(named));
            assert_eq!(other.first_difference(&scene).as_deref(), Some(named));
        }
    }
}
