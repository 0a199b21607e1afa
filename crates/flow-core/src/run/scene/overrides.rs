//! Changes to a scene from outside: `--set accuracy.tolerance=1e-6`, `--set density.protein.initial=0.5`; `--set output.frames=`
//! takes the key out.

use std::borrow::Cow;

use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

use super::error::Fault;
use super::report::Report;

/// Scenes are shallower than this.
const MAX_DEPTH: usize = 8;

/// One `--set key=value`.
pub(super) struct Override<'a> {
    /// The key as given.
    pub(super) key: &'a str,
    /// The value as given.
    pub(super) value: &'a str,
    /// The value as TOML writes it.
    toml: Cow<'a, str>,
    /// The key with densities by index, as in the paths of problems.
    pub(super) path: String,
}

/// Resolves the keys against a document.
pub(super) fn resolve<'a>(document: &DeTable<'_>, overrides: &'a [(String, String)]) -> Vec<Override<'a>> {
    let resolved = |(key, value): &'a (String, String)| Override {
        key,
        value,
        toml: notation(value),
        path: path(document, key),
    };
    overrides.iter().map(resolved).collect()
}

fn path(document: &DeTable<'_>, key: &str) -> String {
    let mut segments: Vec<&str> = key.split('.').collect();
    let by_name = match (segments.as_slice(), document.get("density").map(Spanned::get_ref)) {
        (["density", name, ..], Some(DeValue::Array(densities))) => position(densities, name),
        _ => None,
    };
    let index = by_name.map(|index| index.to_string());
    if let Some(index) = &index {
        segments[1] = index;
    }
    segments.join(".")
}

fn position(densities: &DeArray<'_>, name: &str) -> Option<usize> {
    densities.iter().position(|density| {
        density.get_ref().as_table().and_then(|table| table.get("name")).and_then(|v| v.get_ref().as_str())
            == Some(name)
    })
}

/// Writes the values into the document; keys that lead nowhere are reported.
pub(super) fn apply<'i>(document: &mut DeTable<'i>, overrides: &'i [Override<'i>], report: &Report<'_>) {
    for change in overrides {
        let value = if is_of_text(&change.path) { text(change.value) } else { value(&change.toml) };
        if let Err((reason, remedy)) = set(document, &change.path, value) {
            report.add(&change.path, &(0..0), Fault::NoSuchPlace { reason, remedy });
        }
    }
}

/// A TOML value, or else the text itself; none for an empty text.
fn value(text: &str) -> Option<DeValue<'_>> {
    let parsed =
        || DeValue::parse(text).map_or_else(|_| DeValue::String(Cow::Borrowed(text)), Spanned::into_inner);
    (!text.is_empty()).then(parsed)
}

/// Whether the key at `path` holds nothing but text, also where that looks like a number: `nan` may be the name of a density.
fn is_of_text(path: &str) -> bool {
    let segments: Vec<&str> = path.split('.').collect();
    matches!(segments[..], ["title"] | ["density", _, "name"] | ["energy", _, "density"] | ["curve", "file"])
}

/// The text, without quotes if it has some; a number or a date is the text that it was written as.
fn text(text: &str) -> Option<DeValue<'_>> {
    let is_kept = |value: &DeValue<'_>| value.is_str() || value.is_array() || value.is_table();
    value(text).map(|value| if is_kept(&value) { value } else { DeValue::String(Cow::Borrowed(text)) })
}

/// `text`, but as TOML writes it if it is a number in a notation that TOML lacks and calculators print: `.001`, `1.e-3`, `01e-3`.
fn notation(text: &str) -> Cow<'_, str> {
    let written = text.bytes().all(|byte| byte.is_ascii_digit() || b".eE+-".contains(&byte));
    match text.parse() {
        Ok(value) if written && f64::is_finite(value) && DeValue::parse(text).is_err() => {
            format!("{value:?}").into()
        }
        _ => text.into(),
    }
}

fn set<'i>(
    document: &mut DeTable<'i>,
    path: &'i str,
    value: Option<DeValue<'i>>,
) -> Result<(), (String, &'static str)> {
    let segments: Vec<&str> = path.split('.').collect();
    check(&segments)?;
    let mut table = document;
    let mut rest = segments.as_slice();
    while let [segment, tail @ ..] = rest {
        rest = tail;
        if tail.is_empty() {
            let Some(value) = value else {
                let taken = table.remove(*segment).map(drop);
                return taken
                    .ok_or_else(|| ("it is not there to be taken out".to_owned(), "give it a value"));
            };
            // An empty span marks what is not in the file.
            let (key, value) = (Spanned::new(0..0, Cow::Borrowed(*segment)), Spanned::new(0..0, value));
            table.insert(key, value);
            return Ok(());
        }
        let key = Spanned::new(0..0, Cow::Borrowed(*segment));
        let inner = table.entry(key).or_insert_with(|| Spanned::new(0..0, DeValue::Table(DeTable::new())));
        table = match inner.get_mut() {
            DeValue::Table(inner) => inner,
            DeValue::Array(array) => {
                rest = &tail[1..];
                let element = element(array, segment, tail[0])?;
                if rest.is_empty() {
                    let absent =
                        || ("entries of a list cannot be taken out".to_owned(), "set the whole list");
                    *element = value.ok_or_else(absent)?;
                    return Ok(());
                }
                let DeValue::Table(inner) = element else {
                    return Err((format!("`{segment}.{}` is not a table", tail[0]), "shorten the key"));
                };
                inner
            }
            _ => return Err((format!("`{segment}` is a value, not a table"), "shorten the key")),
        };
    }
    Ok(())
}

/// What every key is: names, each before a dot or the end.
fn check(segments: &[&str]) -> Result<(), (String, &'static str)> {
    let has = |is: fn(char) -> bool| segments.iter().any(|segment| segment.contains(is));
    let reason = if has(char::is_whitespace) {
        "the key has a blank in it"
    } else if segments.len() > MAX_DEPTH || has(char::is_control) || segments.contains(&"") {
        "the key is not a dotted path"
    } else {
        return Ok(());
    };
    Err((reason.to_owned(), "write it like accuracy.tolerance=1e-6"))
}

fn element<'t, 'i>(
    array: &'t mut DeArray<'i>,
    list: &str,
    index: &str,
) -> Result<&'t mut DeValue<'i>, (String, &'static str)> {
    let found = index.parse().ok().and_then(|index: usize| array.get_mut(index));
    let missing = || {
        let reason = format!("`{list}` has no entry `{index}`");
        (reason, "count from 0, or give the name of a density of the scene")
    };
    found.map(Spanned::get_mut).ok_or_else(missing)
}

#[cfg(test)]
mod tests {
    use serde_json::Value;

    use super::*;
    use crate::run::Scene;

    /// Paths of the keys of `schema`, and whether each is a text and neither a formula nor one of some names.
    fn keys(schema: &Value, path: &str, out: &mut Vec<(String, bool)>) {
        let inner = |key: &str| if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") };
        for (key, value) in schema["properties"].as_object().into_iter().flatten() {
            let is_free = value.get("enum").or(value.get("const")).is_none();
            let of_text = |kind: &Value| *kind == "string" || *kind == serde_json::json!(["string", "null"]);
            out.push((inner(key), is_free && of_text(&value["type"])));
            keys(value, &inner(key), out);
        }
        for alternative in schema["anyOf"].as_array().into_iter().flatten() {
            keys(alternative, path, out);
        }
        if schema["items"].is_object() {
            keys(&schema["items"], &inner("0"), out);
        }
    }

    #[test]
    fn the_keys_of_text_are_those_of_the_schema() {
        let mut found = Vec::new();
        keys(&Scene::schema(), "", &mut found);
        assert!(found.iter().filter(|(_, is_text)| *is_text).count() >= 6, "{found:?}");
        for (path, is_text) in found {
            assert_eq!(is_of_text(&path), is_text, "{path}");
        }
    }
}
