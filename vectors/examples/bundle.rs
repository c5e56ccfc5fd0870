//! One bundle of vectors for a testbench, written and read back.
//!
//! `cargo run -p vectors --example bundle`

use std::error::Error;

use hw_model::design::Design;
use vectors::{Bundle, Strategy, verify};

/// Writes a bundle to a directory that is removed again, and lists its files.
///
/// # Errors
/// When it cannot be written, or is not what was written.
pub fn main() -> Result<(), Box<dyn Error>> {
    let place = tempfile::tempdir()?;
    let directory = place.path().join("vectors");
    let design = Design::preset("compact")?;
    // The seed and the name of the program stand in the manifest: the same again gives the same bytes.
    let bundle = Bundle::new(&design, Strategy::Mixed, 1000, 1, "the example `bundle`")?;
    bundle.write_to(&directory)?;
    let read = verify(&directory)?;
    for entry in std::fs::read_dir(&directory)? {
        let entry = entry?;
        println!("{:9} bytes  {}", entry.metadata()?.len(), entry.file_name().display());
    }
    let case = &read.vectors[0];
    println!("of {} vectors the first is {case:?}", read.vectors.len());
    assert_eq!(read.vectors.len(), 1000);
    Ok(())
}
