//! Binary messages to a page: a JSON head, then numbers, aligned so that the page need not copy them.
//!
//! ```text
//! u32 length L of the head, little-endian │ head, padded with spaces to 4 + L ≡ 0 mod 8 │ payload
//! ```

use serde_json::Value;

/// A message of a head and its payload.
pub fn encode(head: &Value, payload: &[u8]) -> Vec<u8> {
    let mut text = head.to_string();
    while !(4 + text.len()).is_multiple_of(8) {
        text.push(' ');
    }
    // A head is a few words long.
    let length = text.len() as u32;
    let mut bytes = Vec::with_capacity(4 + text.len() + payload.len());
    bytes.extend(length.to_le_bytes());
    bytes.extend(text.as_bytes());
    bytes.extend(payload);
    bytes
}

#[cfg(test)]
mod tests {
    use super::encode;
    use serde_json::json;

    #[test]
    fn payloads_are_aligned_whatever_the_head() {
        for name in ["", "a", "ab", "abc", "abcdefgh"] {
            let bytes = encode(&json!({ "name": name }), &[7; 16]);
            let length = u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]) as usize;
            assert_eq!((4 + length) % 8, 0);
            let head: serde_json::Value = serde_json::from_slice(&bytes[4..4 + length]).unwrap();
            assert_eq!((&head["name"], &bytes[4 + length..]), (&json!(name), &[7; 16][..]));
        }
    }
}
