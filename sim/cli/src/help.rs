//! `blysk --help`: what the command does, and its subcommands by what one comes for.

use clap::Command;

use super::table::folded;

/// What one comes for, and the subcommands for it.
const GROUPS: [(&str, &[&str]); 6] = [
    ("Look at presets, coefficients and answers", &["presets", "coefficients", "rom", "evaluate", "simulate", "serve"]),
    ("Check errors, vectors and a simulation of your own", &["report", "check", "stability", "shard"]),
    ("Prove bounds", &["certify", "claims"]),
    ("Choose hardware", &["design", "refine", "clock", "pareto", "specialise"]),
    ("Draw", &["render", "scene", "mesh"]),
    ("Build: RTL, vectors, documents, and this command's own", &["rtl", "vectors", "document", "completions", "man"]),
];

/// Columns of the names, with the space before and after them.
const NAMES: usize = 16;

/// The command with its help by groups.
pub(super) fn grouped(command: Command) -> Command {
    let groups: Vec<String> = GROUPS.iter().map(|&(heading, names)| group(&command, heading, names)).collect();
    let template = format!(
        "{{about-with-newline}}\n{{usage-heading}} {{usage}}\n\n{}\nOptions:\n{{options}}{{after-help}}",
        groups.join("\n")
    );
    command.help_template(template)
}

fn group(command: &Command, heading: &str, names: &[&str]) -> String {
    let found = names.iter().filter_map(|name| command.find_subcommand(name));
    let line = |below: &Command| {
        let about = below.get_about().map(ToString::to_string).unwrap_or_default();
        folded(&format!("  {:width$}{about}", below.get_name(), width = NAMES - 2), &" ".repeat(NAMES)) + "\n"
    };
    format!("{heading}:\n{}", found.map(line).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::GROUPS;
    use clap::CommandFactory;

    #[test]
    fn every_command_is_in_one_group() {
        let command = crate::Cli::command();
        let mut grouped: Vec<&str> = GROUPS.iter().flat_map(|(_, names)| names.iter().copied()).collect();
        let mut all: Vec<&str> = command.get_subcommands().map(clap::Command::get_name).collect();
        grouped.sort_unstable();
        all.sort_unstable();
        assert_eq!(grouped, all);
    }
}
