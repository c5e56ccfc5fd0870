//! Codes, the sentences to them, and the one place where panics end.

use std::cell::RefCell;
use std::ffi::{CStr, CString, c_char};
use std::panic::{AssertUnwindSafe, catch_unwind};

use crate::abi::ABI_VERSION;

/// How a call went. Each code keeps its number in every version.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Code {
    /// The work is done.
    Ok = 0,
    /// There is no preset of this name.
    NoPreset = 1,
    /// The text is no configuration, or the file cannot be read.
    Configuration = 2,
    /// The configuration gives no hardware.
    Design = 3,
    /// The ROM has no word for the exponent.
    Exponent = 4,
    /// x is not finite, or its bits do not fit the input format.
    X = 5,
    /// An address is out of range, or lengths do not go together.
    Argument = 6,
    /// A pointer is null that must not be.
    Null = 7,
    /// A text is not UTF-8.
    Text = 8,
    /// The caller was compiled with the header of another version.
    Abi = 9,
    /// A scoreboard: the DUT does not do what the model does.
    Differs = 10,
    /// A mistake inside the library. The handles of the call may only be freed.
    Internal = 11,
}

/// Why a call is refused.
pub(crate) enum Failure {
    /// The model refuses.
    Model(model::Error),
    /// A null pointer.
    Null(&'static str),
    /// A text that is not UTF-8.
    Text(&'static str),
    /// A number of values that no memory holds.
    Count { what: &'static str, count: usize },
    /// Room for fewer values than there are.
    Room { wanted: usize, got: usize },
    /// A number of addresses that is neither 1 nor that of the x.
    Addresses { wanted: usize, got: usize },
    /// A header of another version.
    Abi(u32),
    /// What a scoreboard says.
    Differs(String),
}

impl From<model::Error> for Failure {
    fn from(error: model::Error) -> Self {
        Self::Model(error)
    }
}

impl Failure {
    fn code(&self) -> Code {
        match self {
            Self::Model(error) => match error.code() {
                model::Code::NoPreset => Code::NoPreset,
                model::Code::Configuration => Code::Configuration,
                model::Code::Design => Code::Design,
                model::Code::Exponent => Code::Exponent,
                model::Code::X => Code::X,
                _ => Code::Argument,
            },
            Self::Null(_) => Code::Null,
            Self::Text(_) => Code::Text,
            Self::Count { .. } | Self::Room { .. } | Self::Addresses { .. } => Code::Argument,
            Self::Abi(_) => Code::Abi,
            Self::Differs(_) => Code::Differs,
        }
    }

    fn sentence(self) -> String {
        match self {
            Self::Model(error) => error.to_string(),
            Self::Null(what) => format!("{what} is a null pointer"),
            Self::Text(what) => format!("{what} is not UTF-8"),
            Self::Count { what, count } => format!("{what}: {count} values are more than memory can hold"),
            Self::Room { wanted, got } => format!("there is room for {got} registers, and {wanted} of them to write"),
            Self::Addresses { wanted, got } => format!("{got} addresses for {wanted} x; give one, or one for each x"),
            Self::Abi(caller) => format!(
                "the caller has the header of ABI {caller}, and this library is of ABI {}; compile it with the header \
                 that came with the library",
                ABI_VERSION
            ),
            Self::Differs(message) => message,
        }
    }
}

thread_local! {
    static LAST: RefCell<CString> = RefCell::default();
}

/// What a handle points at, or the failure that it is null.
pub(crate) fn given<T>(handle: Option<T>, what: &'static str) -> Result<T, Failure> {
    handle.ok_or(Failure::Null(what))
}

/// Does the work of an exported function: keeps the sentence of a failure for [`blysk_last_error`], and ends a panic,
/// which C has no way to go on with.
pub(crate) fn guard(work: impl FnOnce() -> Result<(), Failure>) -> Code {
    // What a panic left half done in a handle is seen by nobody: the header says that it may only be freed.
    match catch_unwind(AssertUnwindSafe(work)) {
        Ok(Ok(())) => Code::Ok,
        Ok(Err(failure)) => {
            let code = failure.code();
            remember(failure.sentence());
            code
        }
        Err(_) => {
            remember("a mistake inside the library; standard error says where. Please report it".to_owned());
            Code::Internal
        }
    }
}

fn remember(mut sentence: String) {
    // A zero byte would end the text for C.
    sentence.retain(|c| c != '\0');
    let sentence = CString::new(sentence).unwrap_or_default();
    // A thread that is ending has no place for it any more.
    let _ = LAST.try_with(|last| last.try_borrow_mut().map(|mut last| *last = sentence));
}

/// The sentence to the last code of this thread that was not `BLYSK_CODE_OK`, the same that the command `blysk` says;
/// an empty text where there was none. Its bytes stay until the next call of this thread that fails, or the thread
/// ends. Thread-safe: each thread has its own.
#[unsafe(no_mangle)]
pub extern "C" fn blysk_last_error() -> *const c_char {
    LAST.try_with(|last| last.try_borrow().map_or(c"".as_ptr(), |last| last.as_ptr())).unwrap_or(c"".as_ptr())
}

/// The version of the ABI that the library was built with: `BLYSK_ABI_VERSION` of its own header. Thread-safe.
#[unsafe(no_mangle)]
pub extern "C" fn blysk_abi_version() -> u32 {
    ABI_VERSION
}

const VERSION: &CStr = match CStr::from_bytes_with_nul(concat!(env!("CARGO_PKG_VERSION"), "\0").as_bytes()) {
    Ok(version) => version,
    Err(_) => c"",
};

/// The version of Blysk, such as `0.1.0`. Its bytes stay for good. Thread-safe.
#[unsafe(no_mangle)]
pub extern "C" fn blysk_version() -> *const c_char {
    VERSION.as_ptr()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn last() -> String {
        LAST.with(|last| last.borrow().to_string_lossy().into_owned())
    }

    #[test]
    fn a_panic_becomes_a_code() {
        assert_eq!(guard(|| panic!("on purpose")), Code::Internal);
        assert!(last().starts_with("a mistake inside the library"));
        // A call that succeeds leaves the sentence.
        assert_eq!(guard(|| Ok(())), Code::Ok);
        assert!(last().starts_with("a mistake inside the library"));
    }

    #[test]
    fn a_sentence_has_no_zero_byte() {
        assert_eq!(guard(|| Err(Failure::Differs("a\0b".to_owned()))), Code::Differs);
        assert_eq!(last(), "ab");
    }

    #[test]
    fn codes_of_the_model_keep_their_numbers() {
        let codes = [
            (model::Code::NoPreset, Code::NoPreset),
            (model::Code::Configuration, Code::Configuration),
            (model::Code::Design, Code::Design),
            (model::Code::Exponent, Code::Exponent),
            (model::Code::X, Code::X),
            (model::Code::Argument, Code::Argument),
        ];
        assert!(codes.iter().all(|&(model, here)| model as i32 == here as i32));
    }
}
