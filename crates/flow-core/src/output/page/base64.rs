//! Base64 (RFC 4648, section 4) of numbers in little-endian order: its alphabet needs no escape in HTML.

const ALPHABET: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// The `values` in single precision, for pictures.
pub(super) fn singles(values: impl IntoIterator<Item = f64>) -> String {
    encode(values.into_iter().flat_map(|value| (value as f32).to_le_bytes()))
}

/// The `values` as they are.
pub(super) fn doubles(values: impl IntoIterator<Item = f64>) -> String {
    encode(values.into_iter().flat_map(f64::to_le_bytes))
}

fn encode(bytes: impl IntoIterator<Item = u8>) -> String {
    let mut bytes = bytes.into_iter();
    let mut text = String::new();
    while let Some(first) = bytes.next() {
        let (second, third) = (bytes.next(), bytes.next());
        let group = u32::from_be_bytes([0, first, second.unwrap_or(0), third.unwrap_or(0)]);
        let digit = |k: u32| char::from(ALPHABET[(group >> (18 - 6 * k)) as usize & 63]);
        text.extend([digit(0), digit(1)]);
        text.push(if second.is_some() { digit(2) } else { '=' });
        text.push(if third.is_some() { digit(3) } else { '=' });
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The test vectors of RFC 4648, section 10.
    #[test]
    fn bytes_are_encoded_as_the_standard_says() {
        let cases = [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foob", "Zm9vYg==")];
        for (bytes, expected) in cases {
            assert_eq!(encode(bytes.bytes()), expected);
        }
        assert_eq!(encode([0xff, 0xfb, 0xf0]), "//vw");
    }

    #[test]
    fn numbers_are_little_endian() {
        assert_eq!(singles([1.0]), "AACAPw==");
        assert_eq!(doubles([1.0]), "AAAAAAAA8D8=");
    }
}
