//! `blysk specialise --check`: a certificate, and the files that were written with it.

use std::path::Path;

use hw_model::config::Config;
use vectors::configuration_file;
use vectors::text_file;
use vectors::whole_file::{ListError, check_list};

use super::bar::Bar;
use super::out::{Out, Outcome};
use super::table::write_folded;
use scenes::specialise::{self, Asked, Held};

/// Whose list the files are on.
pub(super) const COMMAND: &str = "specialise";
/// The smaller configuration, beside its certificate.
pub(super) const CONFIGURATION: &str = "configuration.json";
/// The directory of its hardware.
pub(super) const RTL: &str = "rtl";

/// How many files stand beside a certificate that were written with it, each as it was then; nothing where it stands
/// alone.
fn written_with(certificate: &Path) -> Result<Option<usize>, ListError> {
    let directory = certificate.parent().unwrap_or(Path::new(""));
    let beside = [CONFIGURATION, RTL].iter().any(|name| directory.join(name).exists());
    match check_list(directory, COMMAND) {
        Ok(names) => {
            let named = |name: &String| certificate.file_name() == Some(name.as_ref());
            Ok(names.iter().any(named).then(|| names.len() - 1))
        }
        Err(ListError::NoList { .. }) if !beside => Ok(None),
        Err(refused) => Err(refused),
    }
}

/// Checks a certificate, and the files beside it.
pub(super) fn check(asked: Asked<'_>, path: &Path, out: &mut Out) -> anyhow::Result<Outcome> {
    let shown = path.display();
    let text = text_file::read(path, text_file::CERTIFICATE)?;
    let bar = Bar::new(specialise::inputs(&text));
    let held = specialise::check(&text, asked, &bar);
    bar.finish();
    let said = held.map_err(anyhow::Error::from).and_then(|held| accepted(path, held));
    match said {
        Ok(sentences) => {
            for sentence in sentences {
                write_folded(out, &sentence)?;
            }
            Ok(Outcome::Good)
        }
        Err(refused) => {
            write_folded(out, &format!("{shown} does not hold: {refused:#}"))?;
            Ok(Outcome::Fails)
        }
    }
}

/// What to say of a certificate that holds: what it is about, the files beside it, and what was not checked.
fn accepted(path: &Path, held: Held) -> anyhow::Result<Vec<String>> {
    let Held { statement, not_checked, specialised } = held;
    let beside = match written_with(path)? {
        Some(count) => {
            check_beside(path, &specialised)?;
            format!("The {count} files beside it are those written with it.")
        }
        None => "It stands alone: files of hardware were not looked at.".to_owned(),
    };
    let first = [format!("{} holds: {statement}", path.display()), beside];
    Ok(first.into_iter().chain(not_checked).collect())
}

/// The configuration beside the certificate is the one that it is about.
fn check_beside(certificate: &Path, specialised: &Config) -> anyhow::Result<()> {
    let path = certificate.with_file_name(CONFIGURATION);
    let other = || format!("{} is not the certificate's configuration", path.display());
    anyhow::ensure!(configuration_file::read(&path)? == *specialised, other());
    Ok(())
}
