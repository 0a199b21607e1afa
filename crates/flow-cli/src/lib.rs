//! The `curveflow` command, for the program of that name and for the one that comes with the Python package.

mod commands;
mod error;
mod print;
mod progress;
mod signals;

use std::ffi::OsString;
use std::panic;

use clap::{Parser, Subcommand};

use commands::{check, info, plot, resume, scenes, schema, tradeoff, view};
use error::CliError;
use flow_core::output::with_causes;

/// Gradient flows of energies of closed planar curves that carry embedded densities.
#[derive(Debug, Parser)]
#[command(name = "curveflow", version, about, arg_required_else_help = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Run(commands::run::Args),
    Resume(resume::Args),
    Check(check::Args),
    Info(info::Args),
    Plot(plot::Args),
    Tradeoff(tradeoff::Args),
    View(view::Args),
    Scenes(scenes::Args),
    Schema(schema::Args),
}

impl Command {
    fn execute(&self) -> Result<(), CliError> {
        match self {
            Self::Run(args) => commands::run::execute(args),
            Self::Resume(args) => resume::execute(args),
            Self::Check(args) => check::execute(args),
            Self::Info(args) => info::execute(args),
            Self::Plot(args) => plot::execute(args),
            Self::Tradeoff(args) => tradeoff::execute(args),
            Self::View(args) => view::execute(args),
            Self::Scenes(args) => scenes::execute(args),
            Self::Schema(args) => schema::execute(args),
        }
    }
}

/// Does what `arguments` ask for, the first of which is the name of the program; returns the exit code.
///
/// Handlers of signals stay in place: to be called once in a process.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let cli = match Cli::try_parse_from(arguments) {
        Ok(cli) => cli,
        // Help and the version come this way too: they are data.
        Err(other) => {
            let printed = other.print().or_else(print::unless_gone);
            if let Some(error) = printed.err().filter(|_| !other.use_stderr()) {
                return failed(&CliError::Stdout(error));
            }
            return u8::try_from(other.exit_code()).unwrap_or(2);
        }
    };
    match panic::catch_unwind(|| signals::let_large_writes_fail().and_then(|()| cli.command.execute())) {
        Ok(Ok(())) => 0,
        Ok(Err(error)) => failed(&error),
        Err(_) => {
            print::talk("this is a bug in curveflow: please report the lines above and the scene");
            70
        }
    }
}

/// Says what went wrong; returns the exit code.
fn failed(error: &CliError) -> u8 {
    print::talk(&format!("error: {}", with_causes(error)));
    exit_code(error)
}

/// The one map from errors to exit codes; 0 is success, 2 is clap's, 70 a panic.
fn exit_code(error: &CliError) -> u8 {
    match error {
        CliError::Usage { .. } => 2,
        CliError::InvalidScene(_) | CliError::Unusable { .. } => 3,
        CliError::Numerical { .. }
        | CliError::UsedUp { .. }
        | CliError::Unmeasured(_)
        | CliError::AllFailed
        | CliError::NotReached { .. } => 4,
        CliError::Storage(_)
        | CliError::Unwritten { .. }
        | CliError::Lost(_)
        | CliError::Stdout(_)
        | CliError::Signals(_) => 5,
        CliError::Stopped { .. } | CliError::LadderStopped { .. } => 6,
        CliError::Unreadable(_) | CliError::OtherScene { .. } | CliError::OwnTerms { .. } => 7,
    }
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }
}
