//! The size of a picture, as options have it.

/// A size as `--size` has it: `1920x1080`.
pub(super) fn size(text: &str) -> Result<(u32, u32), String> {
    let wrong = || format!("{text:?} is no size; write width x height in pixels, for example 1920x1080");
    let (width, height) = text.split_once('x').ok_or_else(wrong)?;
    Ok((width.parse().map_err(|_| wrong())?, height.parse().map_err(|_| wrong())?))
}
