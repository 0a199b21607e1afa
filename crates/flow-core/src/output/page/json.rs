//! JSON that may stand inside a `<script>` element.

use std::fmt::Write;

use super::text::visible;

/// A text; nothing in it can end the element that it stands in.
pub(super) fn text(text: &str) -> String {
    let mut json = String::from("\"");
    for character in visible(text).chars() {
        match character {
            '"' | '\\' => json.extend(['\\', character]),
            '\0'..='\x1f' | '<' | '>' | '&' => {
                let _ = write!(json, "\\u{:04x}", u32::from(character)); // a String never fails
            }
            _ => json.push(character),
        }
    }
    json.push('"');
    json
}

/// A number with all its digits; `null` for NaN and infinities, which JSON cannot hold.
pub(super) fn number(value: f64) -> String {
    if value.is_finite() { format!("{value:?}") } else { "null".to_owned() }
}

/// A list of JSON values.
pub(super) fn list(items: impl IntoIterator<Item = String>) -> String {
    format!("[{}]", items.into_iter().collect::<Vec<_>>().join(","))
}

/// An object of JSON values.
pub(super) fn object<'a>(entries: impl IntoIterator<Item = (&'a str, String)>) -> String {
    let entries: Vec<_> = entries.into_iter().map(|(key, value)| format!("{}:{value}", text(key))).collect();
    format!("{{{}}}", entries.join(","))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_cannot_end_their_element() {
        assert_eq!(text("</script><!--"), r#""\u003c/script\u003e\u003c!--""#);
        assert_eq!(text("a\"b\\c\n\0"), r#""a\"b\\c\u000a␀""#);
    }

    #[test]
    fn numbers_keep_their_digits() {
        let numbers = [0.1, -1e-300, 2.0, f64::NAN, f64::INFINITY].map(number);
        assert_eq!(list(numbers), "[0.1,-1e-300,2.0,null,null]");
    }

    #[test]
    fn objects_keep_their_order() {
        assert_eq!(object([("b", number(1.0)), ("a", text("x"))]), r#"{"b":1.0,"a":"x"}"#);
    }
}
