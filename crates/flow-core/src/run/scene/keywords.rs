//! Keywords of JSON Schema for the values of scenes: what the types of Rust do not say.

use schemars::Schema;
use schemars::transform::Transform;
use serde_json::{Value, json};

use super::error::Bound;

/// The range of a number; a formula in quotes is not affected by it.
pub(super) struct Within(pub(super) Bound);

impl Transform for Within {
    fn transform(&mut self, schema: &mut Schema) {
        let keywords = match self.0 {
            Bound::Finite => vec![],
            Bound::Positive => vec![("exclusiveMinimum", 0.0)],
            Bound::PositiveUpTo(maximum) => vec![("exclusiveMinimum", 0.0), ("maximum", maximum)],
            Bound::AtLeast(minimum) => vec![("minimum", minimum)],
            Bound::Between(minimum, maximum) => vec![("minimum", minimum), ("maximum", maximum)],
            Bound::Exactly(only) => vec![("const", only)],
        };
        for (keyword, value) in keywords {
            schema.insert(keyword.to_owned(), number(value));
        }
    }
}

/// The range of the entries of a list.
pub(super) struct Each(pub(super) Bound);

impl Transform for Each {
    fn transform(&mut self, schema: &mut Schema) {
        let items = schema.get_mut("items").and_then(|items| items.try_into().ok());
        Within(self.0).transform(items.expect("a list has entries"));
    }
}

/// The number of entries of a list.
pub(super) struct Entries(pub(super) usize, pub(super) usize);

impl Transform for Entries {
    fn transform(&mut self, schema: &mut Schema) {
        if self.0 > 0 {
            schema.insert("minItems".to_owned(), self.0.into());
        }
        schema.insert("maxItems".to_owned(), self.1.into());
    }
}

/// Whole numbers without a decimal point, as they are written in scenes.
pub(super) fn number(value: f64) -> Value {
    if value.fract() == 0.0 { json!(value as i64) } else { json!(value) }
}

/// A type that is written as one of several JSON types and has no name of its own.
macro_rules! inline_schema {
    ($type:ident, $schema:expr) => {
        impl schemars::JsonSchema for $type {
            fn inline_schema() -> bool {
                true
            }

            fn schema_name() -> std::borrow::Cow<'static, str> {
                stringify!($type).into()
            }

            fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
                $schema
            }
        }
    };
}

pub(super) use inline_schema;
