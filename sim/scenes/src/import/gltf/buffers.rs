//! The buffers of a document: in the file itself, in a `data:` address, or in files beside it.

use std::io;

use data_url::DataUrl;
use gltf::buffer::Source;
use percent_encoding::percent_decode_str;

use crate::import::error::ImportError;

/// The bytes of every buffer, in the order of the document.
///
/// # Errors
/// Where a buffer cannot be read, or is shorter than the document says.
pub(super) fn all(
    document: &gltf::Document,
    mut blob: Option<Vec<u8>>,
    read: &mut dyn FnMut(&str) -> io::Result<Vec<u8>>,
) -> Result<Vec<Vec<u8>>, ImportError> {
    let mut buffers = Vec::new();
    for buffer in document.buffers() {
        let refused = |problem: String| ImportError::Gltf(format!("buffer {}: {problem}", buffer.index()));
        let bytes = match buffer.source() {
            Source::Bin => blob.take().ok_or_else(|| refused("the file has no binary part".into()))?,
            Source::Uri(address) if address.starts_with("data:") => data(address).map_err(refused)?,
            Source::Uri(address) => {
                let name = percent_decode_str(address).decode_utf8().map_err(|error| refused(error.to_string()))?;
                read(&name).map_err(|error| refused(format!("{name:?} cannot be read: {error}")))?
            }
        };
        if bytes.len() < buffer.length() {
            let (there, wanted) = (bytes.len(), buffer.length());
            return Err(refused(format!("has {there} bytes, and the document says {wanted}")));
        }
        buffers.push(bytes);
    }
    Ok(buffers)
}

fn data(address: &str) -> Result<Vec<u8>, String> {
    let parsed = DataUrl::process(address).map_err(|error| format!("no data: address: {error:?}"))?;
    let (bytes, _fragment) = parsed.decode_to_vec().map_err(|error| format!("no base64: {error:?}"))?;
    Ok(bytes)
}
