//! `blysk mesh`: a mesh for scenes.

use std::io::Write;
use std::path::PathBuf;

use anyhow::bail;
use clap::Args as ClapArgs;

use super::out::{Out, Outcome};
use super::output;
use scenes::scene::{Knot, Normals, triangles};

/// Make a mesh for scenes, as a Wavefront OBJ file.
///
/// A tube along a torus knot bends in every direction, so that its highlights meet every angle. The same command
/// writes the same bytes. Without --out the mesh goes to standard output.
#[derive(ClapArgs)]
#[command(after_help = "Example: blysk mesh --along 64 --sides 12 --out knot.obj")]
pub(super) struct Args {
    /// Turns of the knot round the axis of its torus, 1 to 16.
    #[arg(long, value_name = "COUNT", default_value_t = 2)]
    around: u32,
    /// Turns of the knot through the hole of its torus, 1 to 16.
    #[arg(long, value_name = "COUNT", default_value_t = 3)]
    through: u32,
    /// Corners along the knot, 3 to 100000.
    #[arg(long, value_name = "COUNT", default_value_t = 288)]
    along: u32,
    /// Corners round the tube, 3 to 10000.
    #[arg(long, value_name = "COUNT", default_value_t = 24)]
    sides: u32,
    /// Radius of the tube, 0.01 to 0.5, where the torus has radius 1.
    #[arg(long, value_name = "RADIUS", default_value_t = 0.22)]
    tube: f64,
    /// Write to this file; - is standard output.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

/// Triangles of the largest mesh: a file of some 100 MB.
const MOST_TRIANGLES: u64 = 4_000_000;

pub(super) fn run(args: &Args, out: &mut Out) -> anyhow::Result<Outcome> {
    let Args { around, through, along, sides, tube, .. } = *args;
    let knot = Knot::new(around, through, along, sides, tube)?;
    if knot.triangle_count() > MOST_TRIANGLES {
        bail!(
            "--along {along} and --sides {sides} make {} triangles; use at most {MOST_TRIANGLES}",
            knot.triangle_count()
        );
    }
    let origin = format!(
        "blysk mesh --around {around} --through {through} --along {along} \
         --sides {sides} --tube {tube}"
    );
    let file = output::file(args.out.as_ref(), &[])?;
    let text = knot.to_obj(&origin);
    let Some(path) = &args.out else {
        out.write_all(text.as_bytes())?;
        return Ok(Outcome::Good);
    };
    // With six decimals a very fine mesh has corners that coincide: what is written can be read.
    let found = triangles(&text, Normals::Smooth)
        .map_err(|error| anyhow::anyhow!("{}{error}; use fewer corners", path.display()))?;
    if output::fill(file, text)? {
        return Ok(Outcome::Good);
    }
    writeln!(out, "{} triangles, written to {}", found.len(), path.display())?;
    Ok(Outcome::Good)
}
