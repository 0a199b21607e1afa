//! Texts that come from a file, made safe to read: nothing in them can act, or hide.

use std::fmt::Write;

/// `text` with every character that a reader cannot see, but that changes what is shown, made visible: control
/// characters as their pictures, marks of writing direction and line separators by their number.
pub(super) fn visible(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '\n' | '\t' => shown.push(character),
            '\r' => {}
            '\0'..='\x1f' => shown.extend(char::from_u32(0x2400 + u32::from(character))),
            '\x7f' => shown.push('\u{2421}'),
            '\u{80}'..='\u{9f}'
            | '\u{61c}'
            | '\u{200b}'..='\u{200f}'
            | '\u{2028}'..='\u{202e}'
            | '\u{2060}'..='\u{206f}'
            | '\u{feff}'
            | '\u{fff9}'..='\u{fffb}'
            | '\u{e0000}'..='\u{e007f}' => {
                let _ = write!(shown, "⟨U+{:04X}⟩", u32::from(character)); // a String never fails
            }
            _ => shown.push(character),
        }
    }
    shown
}

/// `text` as the content of an HTML element.
pub(super) fn escaped(text: &str) -> String {
    visible(text).replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cannot_be_seen_is_named() {
        assert_eq!(visible("a\0b\x1b\x7f"), "a␀b␛␡");
        assert_eq!(visible("\u{202e}gnp.exe"), "⟨U+202E⟩gnp.exe");
        assert_eq!(visible("a\u{2028}\u{e0041}"), "a⟨U+2028⟩⟨U+E0041⟩");
    }

    #[test]
    fn what_can_be_read_stays() {
        let text = "κ₀(ρ) = \"1.3\" < 2\n\tعربي 曲線";
        assert_eq!(visible(text), text);
        assert_eq!(visible("a\r\nb"), "a\nb");
    }

    #[test]
    fn no_tag_survives() {
        assert_eq!(escaped("</title><b a=\"&\">"), "&lt;/title&gt;&lt;b a=&quot;&amp;&quot;&gt;");
    }
}
