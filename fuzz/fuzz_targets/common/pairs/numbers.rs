//! Numbers from bytes, each by itself; behind the last byte all are as if zeros followed.

/// Bytes that are still to be read.
pub struct Numbers<'a>(&'a [u8]);

impl<'a> Numbers<'a> {
    /// From the first byte on.
    pub fn of(bytes: &'a [u8]) -> Self {
        Self(bytes)
    }

    /// One of so many, at most 256.
    pub fn index(&mut self, count: usize) -> usize {
        usize::from(self.byte()) % count
    }

    /// True for so many of 16 bytes; false for a zero.
    pub fn chance(&mut self, sixteenths: usize) -> bool {
        self.index(16) > 15 - sixteenths
    }

    /// In [0, 1), in steps of 2⁻¹⁶.
    pub fn unit(&mut self) -> f64 {
        f64::from(u16::from_be_bytes([self.byte(), self.byte()])) / 65536.0
    }

    /// Between two numbers, evenly.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// A power of ten between two exponents; one in 256 is any number there is, though it be infinite or none.
    pub fn decade(&mut self, low: f64, high: f64) -> f64 {
        match self.byte() {
            255 => f64::from_bits((0..8).fold(0, |bits, _| (bits << 8) | u64::from(self.byte()))),
            first => {
                let part = f64::from(u16::from_be_bytes([first, self.byte()])) / 65536.0;
                10_f64.powf(low + (high - low) * part)
            }
        }
    }

    /// Three numbers in [−1, 1).
    pub fn vector(&mut self) -> [f64; 3] {
        [0; 3].map(|_| self.between(-1.0, 1.0))
    }

    fn byte(&mut self) -> u8 {
        let Some((first, rest)) = self.0.split_first() else { return 0 };
        self.0 = rest;
        *first
    }
}
