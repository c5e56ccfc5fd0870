//! Several files in one text, each after a line with its name.

/// What a line with a name begins with.
const MARK: &[u8] = b"=== ";

/// The files, in their order. What stands before the first name is left out.
pub fn unpack(bytes: &[u8]) -> Vec<(String, Vec<u8>)> {
    let mut files: Vec<(String, Vec<u8>)> = Vec::new();
    for line in bytes.split_inclusive(|&byte| byte == b'\n') {
        if let Some(name) = line.strip_prefix(MARK) {
            files.push((String::from_utf8_lossy(name).trim().to_owned(), Vec::new()));
        } else if let Some((_, contents)) = files.last_mut() {
            contents.extend_from_slice(line);
        }
    }
    files
}

/// The text of these files.
pub fn pack(files: &[(String, Vec<u8>)]) -> Vec<u8> {
    let mut bytes = Vec::new();
    for (name, contents) in files {
        bytes.extend_from_slice(MARK);
        bytes.extend_from_slice(name.as_bytes());
        bytes.push(b'\n');
        bytes.extend_from_slice(contents);
        if contents.last().is_some_and(|&last| last != b'\n') {
            bytes.push(b'\n');
        }
    }
    bytes
}
