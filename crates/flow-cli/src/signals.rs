//! The wish to stop, from outside.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use crate::error::CliError;

/// Raised by SIGINT and SIGTERM. A second SIGINT, from a hand that will not wait, ends the process at once; not a second SIGTERM,
/// since `timeout` and batch systems send two in a row, and what was computed would be lost.
pub fn stop_flag() -> Result<Arc<AtomicBool>, CliError> {
    use signal_hook::consts::{SIGINT, SIGTERM};
    let (stop, interrupted) = (Arc::new(AtomicBool::new(false)), Arc::new(AtomicBool::new(false)));
    signal_hook::flag::register_conditional_shutdown(SIGINT, 6, Arc::clone(&interrupted))
        .and_then(|_| signal_hook::flag::register(SIGINT, interrupted))
        .and_then(|_| signal_hook::flag::register(SIGINT, Arc::clone(&stop)))
        .and_then(|_| signal_hook::flag::register(SIGTERM, Arc::clone(&stop)))
        .map_err(CliError::Signals)?;
    Ok(stop)
}
