//! The numbers of an accessor, read from its buffer with every bound checked.

use gltf::Accessor;
use gltf::accessor::{DataType, Dimensions};

use crate::import::error::ImportError;

/// The most numbers of an accessor: those of 2^24 positions.
const MOST_ITEMS: usize = 1 << 24;

fn refused<T>(accessor: &Accessor, problem: &str) -> Result<T, ImportError> {
    Err(ImportError::Gltf(format!("accessor {} {problem}", accessor.index())))
}

/// The bytes of each item of an accessor.
fn items<'a>(
    accessor: &Accessor,
    buffers: &'a [Vec<u8>],
) -> Result<impl Iterator<Item = &'a [u8]> + use<'a>, ImportError> {
    if accessor.sparse().is_some() {
        return refused(accessor, "is sparse, which is not read; export it whole");
    }
    let Some(view) = accessor.view() else {
        return refused(accessor, "has no buffer view: its numbers are compressed, or missing; export it plainly");
    };
    let (count, size) = (accessor.count(), accessor.size());
    let stride = view.stride().unwrap_or(size);
    if count > MOST_ITEMS || stride < size || size == 0 {
        return refused(accessor, "has too many items, or items that overlap");
    }
    let start = view.offset().checked_add(accessor.offset());
    let length = count.saturating_sub(1).checked_mul(stride).and_then(|length| length.checked_add(size));
    let end = start.zip(length).and_then(|(start, length)| start.checked_add(length));
    let whole = buffers.get(view.buffer().index());
    let Some(bytes) = start.zip(end).zip(whole).and_then(|((start, end), whole)| whole.get(start..end)) else {
        return refused(accessor, "goes beyond the end of its buffer");
    };
    Ok(bytes.chunks(stride).take(count).filter_map(move |item| item.get(..size)))
}

/// Triples of f32, as f64.
pub(super) fn triples(accessor: &Accessor, buffers: &[Vec<u8>]) -> Result<Vec<[f64; 3]>, ImportError> {
    if (accessor.data_type(), accessor.dimensions()) != (DataType::F32, Dimensions::Vec3) {
        return refused(accessor, "is not of triples of 32-bit floats, which positions and normals are");
    }
    let triple = |item: &[u8]| {
        let mut parts = item.as_chunks::<4>().0.iter().map(|&bytes| f64::from(f32::from_le_bytes(bytes)));
        std::array::from_fn(|_| parts.next().unwrap_or(f64::NAN))
    };
    Ok(items(accessor, buffers)?.map(triple).collect())
}

/// Indices of corners.
pub(super) fn indices(accessor: &Accessor, buffers: &[Vec<u8>]) -> Result<Vec<usize>, ImportError> {
    let whole = matches!(accessor.data_type(), DataType::U8 | DataType::U16 | DataType::U32);
    if !whole || accessor.dimensions() != Dimensions::Scalar {
        return refused(accessor, "is not of whole numbers, which indices are");
    }
    // Little-endian: the highest byte stands last.
    let index = |item: &[u8]| item.iter().rev().fold(0, |index, &byte| index << 8 | usize::from(byte));
    Ok(items(accessor, buffers)?.map(index).collect())
}
