//! The program `curveflow`.

use std::env;
use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(flow_cli::run(env::args_os()))
}
