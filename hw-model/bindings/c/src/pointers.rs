//! What C points at, as Rust may use it: the only module with `unsafe` blocks.
//!
//! # The argument
//!
//! A value of these types comes from C, as an argument of an exported function, and from nowhere else: their fields are
//! private and they have no constructor. So the header's promises hold of them, which no callee can check: a pointer
//! that is not null points at as many values as the function's text says, of that type, aligned, and for input
//! written; nobody else writes them during the call; a text ends with a zero byte. What can be checked is: null, and
//! lengths that do not fit an address space. Nothing that is borrowed outlives the call.
//!
//! A pointer to one value needs none of this: `Option<&T>`, `Option<&mut MaybeUninit<T>>` and `Option<Box<T>>` are
//! pointers of C's ABI in which null is `None`, and so exported functions take them as they are. A handle that C gives
//! back in an `Option<Box<T>>` was made by [`Out::put_handle`], which the header demands.

use std::ffi::{CStr, c_char};
use std::mem::MaybeUninit;

use crate::error::Failure;

/// An array of `count` values that C has written, or null.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub struct In<T>(*const T);

impl<T: Copy> In<T> {
    /// The values.
    pub(crate) fn get(&self, count: usize, what: &'static str) -> Result<&[T], Failure> {
        if count == 0 {
            return Ok(&[]);
        }
        check::<T>(self.0.is_null(), count, what)?;
        // SAFETY: not null, and by the header `count` values that stay as they are during the call.
        Ok(unsafe { std::slice::from_raw_parts(self.0, count) })
    }
}

/// Room for `count` values, which C may not have written yet, or null.
#[repr(transparent)]
pub struct Out<T>(*mut T);

impl<T: Copy> Out<T> {
    /// The room for one value.
    pub(crate) fn one(&mut self, what: &'static str) -> Result<&mut MaybeUninit<T>, Failure> {
        self.places(1, what)?.first_mut().ok_or(Failure::Null(what))
    }

    /// The room, filled with one value first so that it can be read and written.
    pub(crate) fn filled(&mut self, count: usize, value: T, what: &'static str) -> Result<&mut [T], Failure> {
        let room = self.places(count, what)?;
        room.fill(MaybeUninit::new(value));
        // SAFETY: every one of them was written just now, and `MaybeUninit<T>` is laid out as `T`.
        Ok(unsafe { &mut *(std::ptr::from_mut(room) as *mut [T]) })
    }

    /// The room as it is.
    pub(crate) fn places(&mut self, count: usize, what: &'static str) -> Result<&mut [MaybeUninit<T>], Failure> {
        if count == 0 {
            return Ok(&mut []);
        }
        check::<T>(self.0.is_null(), count, what)?;
        // SAFETY: not null, and by the header room for `count` values that nobody else touches during the call. They
        // need not be written: so they are `MaybeUninit`.
        Ok(unsafe { std::slice::from_raw_parts_mut(self.0.cast(), count) })
    }
}

impl<T> Out<*mut T> {
    /// Hands a value over to C, which gives it back to the function that frees it.
    pub(crate) fn put_handle(&mut self, value: T) -> Result<(), Failure> {
        self.one("the place for the handle")?.write(Box::into_raw(Box::new(value)));
        Ok(())
    }

    /// Leaves null there, so that a constructor that fails leaves nothing to be freed.
    pub(crate) fn put_null(&mut self) -> Result<(), Failure> {
        self.one("the place for the handle")?.write(std::ptr::null_mut());
        Ok(())
    }
}

/// A text that ends with a zero byte, or null.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub struct Text(*const c_char);

impl Text {
    /// The text, which must be UTF-8.
    pub(crate) fn get(&self, what: &'static str) -> Result<&str, Failure> {
        if self.0.is_null() {
            return Err(Failure::Null(what));
        }
        // SAFETY: not null, and by the header it ends with a zero byte and stays as it is during the call.
        let text = unsafe { CStr::from_ptr(self.0) };
        text.to_str().map_err(|_| Failure::Text(what))
    }
}

fn check<T>(is_null: bool, count: usize, what: &'static str) -> Result<(), Failure> {
    if is_null {
        return Err(Failure::Null(what));
    }
    // More bytes than a slice may have: a length that went wrong, such as −1.
    match count.checked_mul(size_of::<T>()) {
        Some(bytes) if isize::try_from(bytes).is_ok() => Ok(()),
        _ => Err(Failure::Count { what, count }),
    }
}
