//! Numbers as the page takes them, little-endian.
//!
//! ```text
//! time                   f64[rows]
//! events                 f64[3·count]: time, index of the kind, index of the body or −1
//! surface/K/points       f32[3·points]: relative to the centre of mass, in the reference placement [m]
//! surface/K/triangles    u32[3·triangles]: indices of points, outward
//! ARRAY                  f32[rows·stride], any growing array of the recording
//! ```
//!
//! Single precision is more than a screen shows; the recording itself has all digits.

use gyration_record::Event;

/// Doubles.
pub fn doubles(values: impl IntoIterator<Item = f64>) -> Vec<u8> {
    values.into_iter().flat_map(f64::to_le_bytes).collect()
}

/// Doubles in single precision.
pub fn singles<'a>(values: impl IntoIterator<Item = &'a f64>) -> Vec<u8> {
    values.into_iter().flat_map(|value| (*value as f32).to_le_bytes()).collect()
}

/// Whole numbers that a recording keeps as doubles.
pub fn indices<'a>(values: impl IntoIterator<Item = &'a f64>) -> Vec<u8> {
    values.into_iter().flat_map(|value| (*value as u32).to_le_bytes()).collect()
}

/// Events: time, kind, body.
pub fn events<'a>(events: impl IntoIterator<Item = &'a Event>) -> Vec<u8> {
    let numbers = |event: &Event| [event.time, event.kind as f64, event.body.map_or(-1.0, |body| body as f64)];
    doubles(events.into_iter().flat_map(numbers))
}
