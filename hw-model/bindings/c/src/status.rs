//! The flags of a result, as constants of C. The model's own are `model::Status`; a test holds them together.

/// A flag of the status: the address has no ROM word; the intensity is 0.
pub const STATUS_NO_WORD: u8 = 1;
/// A flag of the status: x was above 1 and was taken as 1.
pub const STATUS_ABOVE_ONE: u8 = 2;
/// A flag of the status: x was negative; the intensity is 0.
pub const STATUS_FACING_AWAY: u8 = 4;
/// A flag of the status: the polynomial left [0, 1] and was clamped.
pub const STATUS_CLAMPED: u8 = 8;
/// A flag of the status: x lies outside the domain that the configuration is built for; the intensity is 0.
pub const STATUS_OUT_OF_DOMAIN: u8 = 16;

#[cfg(test)]
mod tests {
    use model::Status;

    use super::*;

    #[test]
    fn the_flags_are_those_of_the_model() {
        let flags = [STATUS_NO_WORD, STATUS_ABOVE_ONE, STATUS_FACING_AWAY, STATUS_CLAMPED, STATUS_OUT_OF_DOMAIN];
        assert_eq!(Status::NAMES.map(|(flag, _)| flag.bits()), flags);
    }
}
