//! Numbers and tables of other countries: `0,5` for 0.5, and `;` or tabs between fields.

/// What to say of a line of column names whose fields something else than a comma separates.
#[must_use]
pub fn foreign_separator(header: &str) -> Option<String> {
    let name = match header {
        text if text.trim_start().starts_with("sep=") => {
            return Some("`sep=` is no column; leave this line out".to_owned());
        }
        text if text.contains(',') => return None,
        text if text.contains(';') => "`;`",
        text if text.contains('\t') => "tabs",
        text if text.contains('|') => "`|`",
        _ => return None,
    };
    Some(format!("the fields are separated by {name}; separate them by `,`, and write numbers with a point"))
}

/// What may be the reason for another number of fields than there are columns.
pub(crate) fn why_other_count(fields: &[&str], columns: usize) -> String {
    if fields.len() < columns {
        let foreign = fields.iter().find_map(|field| foreign_separator(field));
        return foreign.map_or_else(String::new, |said| format!(": {said}"));
    }
    let pairs = fields.iter().zip(fields.iter().skip(1));
    let numbers: Vec<(&str, &str)> = pairs.filter_map(|(whole, fraction)| halves(whole, fraction)).collect();
    // x is most often between 0 and 1.
    let likely = numbers.iter().find(|(whole, _)| matches!(*whole, "0" | "-0"));
    likely.or(numbers.last()).map_or_else(String::new, |(whole, fraction)| {
        format!(": is `{whole},{fraction}` a decimal comma? write {whole}.{fraction}")
    })
}

/// Two fields that may be one number with a decimal comma.
fn halves<'a>(whole: &'a str, fraction: &'a str) -> Option<(&'a str, &'a str)> {
    let (whole, fraction) = (whole.trim_start_matches('"'), fraction.trim_end_matches('"'));
    let are_digits = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    let unsigned = whole.strip_prefix(['+', '-']).unwrap_or(whole);
    (are_digits(unsigned) && are_digits(fraction)).then_some((whole, fraction))
}

/// What to say of JSON that is refused at a decimal comma, to follow the error.
#[must_use]
pub fn decimal_comma(json: &str, error: &serde_json::Error) -> Option<String> {
    let line = json.lines().nth(error.line().checked_sub(1)?)?;
    // The error stands at the digit after the comma, or just beside it.
    let places = error.column().saturating_sub(3)..=error.column();
    let comma = places.rev().find(|&place| is_between_digits(line, place))?;
    let before = line.get(..comma)?;
    let after = line.get(comma + 1..)?;
    let of_number = |c: char| c.is_ascii_digit() || "+-".contains(c);
    let whole = before.trim_end_matches(of_number).len();
    let fraction = after.find(|c: char| !c.is_ascii_digit()).unwrap_or(after.len());
    let (whole, fraction) = (before.get(whole..)?, after.get(..fraction)?);
    Some(format!("; is `{whole},{fraction}` a decimal comma? write {whole}.{fraction}"))
}

fn is_between_digits(line: &str, place: usize) -> bool {
    let at = |place: Option<usize>| place.and_then(|place| line.as_bytes().get(place));
    let is_digit = |place| at(place).is_some_and(u8::is_ascii_digit);
    at(Some(place)) == Some(&b',') && is_digit(place.checked_sub(1)) && is_digit(place.checked_add(1))
}
