//! Pictures as PNG: the only file that knows the crate that writes it.

pub use png::EncodingError as PngError;
use png::{BitDepth, ColorType, Encoder, ScaledFloat, SrgbRenderingIntent};

use super::shading::Picture;
use crate::scene::Transfer;

/// A picture as PNG. Codes of 8 bits stand as they are; those of 10 or 12 bits are scaled to 16, rounded to the
/// nearest, from which they come back exactly. The transfer curve stands in the file, so that viewers show both alike.
///
/// # Errors
/// Never for a picture that has a pixel; the type says what the crate says.
pub fn encode(picture: &Picture, transfer: Transfer) -> Result<Vec<u8>, PngError> {
    let codes = picture.codes.iter().flatten().copied();
    let (depth, bytes) = match picture.bits {
        8 => (BitDepth::Eight, codes.map(|code| code as u8).collect()),
        bits => {
            let wide = codes.flat_map(|code| scaled(code, bits).to_be_bytes());
            (BitDepth::Sixteen, wide.collect::<Vec<u8>>())
        }
    };
    written(picture.width, picture.height, depth, transfer, &bytes)
}

/// Red, green and blue of 8 bits in the curve of sRGB as PNG: pictures about pictures.
///
/// # Errors
/// As [`encode`].
pub(super) fn encode_bytes(width: u32, height: u32, rgb: &[u8]) -> Result<Vec<u8>, PngError> {
    written(width, height, BitDepth::Eight, Transfer::Srgb, rgb)
}

fn written(width: u32, height: u32, depth: BitDepth, transfer: Transfer, bytes: &[u8]) -> Result<Vec<u8>, PngError> {
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, width, height);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(depth);
    match transfer {
        Transfer::Srgb => encoder.set_source_srgb(SrgbRenderingIntent::Perceptual),
        Transfer::Linear => encoder.set_source_gamma(ScaledFloat::new(1.0)),
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(bytes)?;
    writer.finish()?;
    Ok(file)
}

/// A code of `bits` bits on the scale of 16 bits.
fn scaled(code: u16, bits: u32) -> u16 {
    let greatest = (1_u32 << bits) - 1;
    ((u32::from(code) * 65_535 + greatest / 2) / greatest) as u16
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_come_back_from_their_scaled_values() {
        for bits in [10, 12] {
            let greatest = (1_u32 << bits) - 1;
            for code in 0..=greatest {
                let scaled = u32::from(scaled(code as u16, bits));
                assert_eq!((scaled * greatest + 32_767) / 65_535, code);
            }
            assert_eq!((scaled(0, bits), scaled(greatest as u16, bits)), (0, 65_535));
        }
    }
}
