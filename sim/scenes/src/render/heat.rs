//! Where pipeline and reference differ, and by how many display codes.
//!
//! Blue where the pipeline is darker, orange where it is brighter: with light grey between them, a pair that every
//! common colour vision deficiency tells apart. One code of difference is already a colour, so that nothing hides in
//! the grey.

use rayon::prelude::*;

use super::shading::Picture;
use super::sheet::{Sheet, SheetError};
use plot::canvas::{Anchor, Canvas};

/// Equal codes.
const EQUAL: [u8; 3] = [0xec, 0xec, 0xec];
/// The least and the greatest difference, darker and brighter.
const DARKER: [[u8; 3]; 2] = [[0x92, 0xc5, 0xde], [0x05, 0x30, 0x61]];
const BRIGHTER: [[u8; 3]; 2] = [[0xfd, 0xc0, 0x86], [0x8c, 0x2d, 0x04]];

/// Of the scale, in pixels.
const SCALE_WIDTH: f64 = 340.0;
const SCALE_HEIGHT: f64 = 46.0;
/// The most fields of the scale on either side of 0.
const MOST_FIELDS: i32 = 8;

/// ScenePipeline minus reference of each pixel: of its three colours the one that differs most.
fn signed(pipeline: &Picture, reference: &Picture) -> Vec<i32> {
    let difference = |(one, other): (&[u16; 3], &[u16; 3])| {
        let of = |colour: usize| i32::from(one[colour]) - i32::from(other[colour]);
        [of(1), of(2)].into_iter().fold(of(0), |most, d| if d.abs() > most.abs() { d } else { most })
    };
    pipeline.codes.par_iter().zip(&reference.codes).map(difference).collect()
}

/// The colour of a difference, where `greatest` (at least 1) is the end of the scale.
fn colour(difference: i32, greatest: i32) -> [u8; 3] {
    let [least, most] = match difference.signum() {
        0 => return EQUAL,
        -1 => DARKER,
        _ => BRIGHTER,
    };
    let span = (greatest - 1).max(1);
    let part = if greatest == 1 { span } else { (difference.abs() - 1).min(span) };
    std::array::from_fn(|index| {
        let (least, most) = (i32::from(least[index]), i32::from(most[index]));
        (least + (most - least) * part / span) as u8
    })
}

/// The difference of each pixel as its colour, where `greatest` (at least 1) is the end of the scale.
pub(super) fn heat(pipeline: &Picture, reference: &Picture, greatest: u16) -> Vec<[u8; 3]> {
    let greatest = i32::from(greatest.max(1));
    signed(pipeline, reference).into_iter().map(|difference| colour(difference, greatest)).collect()
}

/// The differences as a PNG, with their scale below. Its ends are the greatest difference there is.
///
/// # Errors
/// When the words of the scale cannot be drawn, or the file not be encoded.
pub fn heat_map(pipeline: &Picture, reference: &Picture) -> Result<Vec<u8>, SheetError> {
    let differences = signed(pipeline, reference);
    let greatest = differences.par_iter().map(|difference| difference.abs()).max().unwrap_or(0);
    let colours: Vec<[u8; 3]> = differences.par_iter().map(|&difference| colour(difference, greatest.max(1))).collect();
    let scale = Sheet::drawn(&scale(greatest, pipeline.bits))?;
    let (width, height) = (pipeline.width as usize, pipeline.height as usize);
    let (scale_width, scale_height) = scale.size();
    let mut sheet = Sheet::new(width.max(scale_width), height + scale_height);
    let left = (sheet.size().0 - width) / 2;
    sheet.put((left, 0), width, &colours);
    sheet.put_sheet(((sheet.size().0 - scale_width) / 2, height), &scale);
    sheet.to_png()
}

fn scale(greatest: i32, bits: u32) -> String {
    let ends = greatest.max(1);
    let side = ends.min(MOST_FIELDS);
    let width = SCALE_WIDTH / f64::from(2 * side + 1);
    let mut canvas = Canvas::new();
    for field in -side..=side {
        let difference = field * ends / side;
        let [red, green, blue] = colour(difference, ends);
        let left = f64::from(field + side) * width;
        canvas.block((left, 18.0), (width + 0.5, 12.0), &format!("#{red:02x}{green:02x}{blue:02x}"));
        if [-side, 0, side].contains(&field) {
            let sign = if difference < 0 { "−" } else { "+" };
            let text = match difference {
                0 => "0".to_owned(),
                _ => format!("{sign}{}", difference.abs()),
            };
            canvas.text((left + width / 2.0, SCALE_HEIGHT - 2.0), &text, Anchor::Middle, 12.0);
        }
    }
    let words = format!("pipeline − reference, in display codes of {bits} bits");
    canvas.text((SCALE_WIDTH / 2.0, 11.0), &words, Anchor::Middle, 12.0);
    canvas.finish((SCALE_WIDTH, SCALE_HEIGHT), "scale", &words)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_code_differs_from_none_and_signs_from_each_other() {
        for greatest in [1, 2, 7, 200, 4095] {
            let of = |difference| colour(difference, greatest);
            assert_eq!(of(0), EQUAL);
            assert_eq!((of(greatest), of(-greatest)), (BRIGHTER[1], DARKER[1]));
            for difference in 1..=greatest {
                assert_ne!(of(difference), EQUAL);
                assert_ne!(of(difference), of(-difference));
            }
        }
    }
}
