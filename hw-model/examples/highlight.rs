//! One highlight: what the hardware of a preset answers, beside x^n.
//!
//! `cargo run -p hw-model --example highlight`

use std::error::Error;

use hw_model::design::Design;
use hw_model::highlight::phong;

/// Prints one highlight.
///
/// # Errors
/// When there is no such preset, or its ROM has no word for n.
pub fn main() -> Result<(), Box<dyn Error>> {
    let design = Design::preset("paper")?;
    let (n, x) = (64.0, 0.99);
    let (intensity, reference) = (design.highlight(n, x)?, phong(n, x));
    println!("x = {x}, n = {n}: {intensity} from the hardware, x^n = {reference}");
    // The claim of the paper on the epicentre, where x^n is 1/2 or more.
    assert!(reference >= 0.5 && (intensity - reference).abs() <= 0.0067);
    Ok(())
}
