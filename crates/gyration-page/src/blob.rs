//! Numbers as the page takes them, little-endian.
//!
//! ```text
//! time                   f64[rows]
//! events                 f64[3·count]: time, index of the kind, index of the body or −1
//! surface/K/points       f32[3·points]: relative to the centre of mass, in the reference placement [m]
//! surface/K/triangles    u32[3·triangles]: indices of points, outward
//! ARRAY                  f32[rows·stride], any growing array of the recording
//! network                f32, for each row the number of its contacts, then six numbers a contact: index of the first
//!                        body, of the second or −1, force along the normal [N], where it acts [m] or 0 0 0 between
//!                        two bodies
//! ```
//!
//! Single precision is more than a screen shows; the recording itself has all digits.

use gyration_record::Event;
use gyration_sim::Push;

/// Doubles.
pub fn doubles(values: impl IntoIterator<Item = f64>) -> Vec<u8> {
    values.into_iter().flat_map(f64::to_le_bytes).collect()
}

/// Doubles in single precision.
pub fn singles<'a>(values: impl IntoIterator<Item = &'a f64>) -> Vec<u8> {
    values.into_iter().flat_map(|value| (*value as f32).to_le_bytes()).collect()
}

/// Bits of a force that no one sees: what is left, 2^−12 of it, packs well.
const UNSEEN: u32 = 0x7ff;

/// A row of the network of forces.
pub fn network(pushes: &[Push]) -> Vec<f32> {
    let numbers = |push: &Push| {
        let force = f32::from_bits((push.force as f32).to_bits() & !UNSEEN);
        let (other, point) = match push.other {
            Some(other) => (other as f32, [0.0; 3]),
            None => (-1.0, <[f64; 3]>::from(push.point).map(|along| along as f32)),
        };
        [&[push.body as f32, other, force][..], &point].concat()
    };
    std::iter::once(pushes.len() as f32).chain(pushes.iter().flat_map(numbers)).collect()
}

/// Numbers in single precision.
pub fn floats(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
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
