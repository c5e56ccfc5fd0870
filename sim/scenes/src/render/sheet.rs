//! A picture about pictures: words and scales as drawn by `plot`, and pixels put on it.

use thiserror::Error;

use super::png::{PngError, encode_bytes};
use plot::{PlotError, svg_to_pixels};

/// Why such a picture was not made.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SheetError {
    /// The words on it cannot be drawn.
    #[error(transparent)]
    Words(#[from] PlotError),
    /// The picture cannot be encoded.
    #[error("the PNG cannot be encoded: {0}")]
    Png(#[from] PngError),
}

/// White paper of this size in pixels.
pub(super) struct Sheet {
    width: usize,
    height: usize,
    pixels: Vec<[u8; 3]>,
}

impl Sheet {
    pub(super) fn new(width: usize, height: usize) -> Self {
        Self { width, height, pixels: vec![[255; 3]; width * height] }
    }

    /// A drawing, as large as it is.
    pub(super) fn drawn(svg: &str) -> Result<Self, SheetError> {
        let (width, height, pixels) = svg_to_pixels(svg)?;
        Ok(Self { width: width as usize, height: height as usize, pixels })
    }

    /// Puts rows of `width` pixels on it, the first at this place. What does not fit is cut off.
    pub(super) fn put(&mut self, (left, top): (usize, usize), width: usize, pixels: &[[u8; 3]]) {
        let shown = width.min(self.width.saturating_sub(left));
        for (row, pixels) in (top..self.height).zip(pixels.chunks(width)) {
            let start = row * self.width + left;
            self.pixels[start..start + shown].copy_from_slice(&pixels[..shown]);
        }
    }

    /// Puts another sheet on it.
    pub(super) fn put_sheet(&mut self, place: (usize, usize), other: &Self) {
        self.put(place, other.width, &other.pixels);
    }

    pub(super) const fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    pub(super) fn to_png(&self) -> Result<Vec<u8>, SheetError> {
        let bytes = self.pixels.as_flattened();
        Ok(encode_bytes(self.width as u32, self.height as u32, bytes)?)
    }
}
