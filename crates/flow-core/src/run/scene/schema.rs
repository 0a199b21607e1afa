//! JSON Schema of a scene, from the types that scenes are read into: for editors, and for programs that write scenes.

use schemars::Schema;
use schemars::generate::SchemaSettings;
use schemars::transform::RecursiveTransform;
use serde_json::{Map, Value, json};

use super::document::Scene;

const ALTERNATIVES: [&str; 2] = ["oneOf", "anyOf"];

impl Scene {
    /// JSON Schema (draft 7) of a scene: every key with its meaning, type, range and default. What needs more than one
    /// key to be judged (a density that the scene does not have, a grading without its gauge) only reading finds.
    #[must_use]
    pub fn schema() -> Value {
        let settings = SchemaSettings::draft07().with(|settings| settings.inline_subschemas = true);
        let settings = settings.with_transform(RecursiveTransform(tidy));
        let mut schema = settings.into_generator().into_root_schema_for::<Self>().to_value();
        close(&mut schema);
        schema
    }
}

/// TOML has no null, widths of integers mean nothing in a scene, and where a line of a comment ends neither.
fn tidy(schema: &mut Schema) {
    schema.remove("format");
    if let Some(Value::String(description)) = schema.get_mut("description") {
        *description = description.replace('\n', " ");
    }
    if let Some(Value::Array(types)) = schema.get_mut("type") {
        types.retain(|name| name != "null");
        if let [only] = types.as_slice() {
            let only = only.clone();
            schema.insert("type".to_owned(), only);
        }
    }
    if let Some(Value::Array(branches)) = schema.get_mut("anyOf") {
        branches.retain(|branch| branch.get("type") != Some(&json!("null")));
        if let [Value::Object(only)] = branches.as_mut_slice() {
            let only = std::mem::take(only);
            schema.remove("anyOf");
            let object = schema.ensure_object();
            for (key, value) in only {
                object.entry(key).or_insert(value);
            }
        }
    }
}

/// Readers deny unknown keys, so the schema does: every table lists all its keys. Keys beside alternatives move into
/// each of them, since a list that denies others must be complete.
fn close(schema: &mut Value) {
    match schema {
        Value::Array(entries) => entries.iter_mut().for_each(close),
        Value::Object(object) => {
            if is_table(object) {
                close_table(object);
            }
            object.iter_mut().filter(|(key, _)| *key != "default").for_each(|(_, value)| close(value));
        }
        _ => {}
    }
}

fn is_table(schema: &Map<String, Value>) -> bool {
    let of_tables = |branches: &Value| branches[0].as_object().is_some_and(is_table);
    schema.get("type") == Some(&json!("object"))
        || ALTERNATIVES.iter().any(|key| schema.get(*key).is_some_and(of_tables))
}

fn close_table(table: &mut Map<String, Value>) {
    let Some(key) = ALTERNATIVES.into_iter().find(|key| table.contains_key(*key)) else {
        table.insert("additionalProperties".to_owned(), json!(false));
        return;
    };
    let common = Map::from_iter(["properties", "required"].map(|k| (k.to_owned(), table.remove(k).into())));
    let Some(Value::Array(branches)) = table.remove(key) else { unreachable!("alternatives are a list") };
    let mut closed = Vec::new();
    for mut branch in branches {
        let Value::Object(branch_table) = &mut branch else { unreachable!("an alternative is a table") };
        merge(branch_table, &common);
        // Alternatives within alternatives become alternatives of the whole.
        close_table(branch_table);
        match branch_table.remove("anyOf") {
            Some(Value::Array(inner)) => closed.extend(inner),
            _ => closed.push(branch),
        }
    }
    table.insert("anyOf".to_owned(), closed.into());
}

/// Adds the keys of `common` to those of a table, and its requirements.
fn merge(table: &mut Map<String, Value>, common: &Map<String, Value>) {
    if let Some(Value::Object(keys)) = common.get("properties") {
        let own = table.entry("properties").or_insert_with(|| json!({}));
        let own = own.as_object_mut().expect("keys are a table");
        for (key, value) in keys {
            own.entry(key).or_insert_with(|| value.clone());
        }
    }
    if let Some(Value::Array(names)) = common.get("required") {
        let own = table.entry("required").or_insert_with(|| json!([]));
        own.as_array_mut().expect("requirements are a list").extend(names.iter().cloned());
    }
}
