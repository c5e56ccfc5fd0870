/// The version of this header. Another number means that functions, structures or codes are not those of this header;
/// constructors refuse it.
pub const ABI_VERSION: u32 = 1;
