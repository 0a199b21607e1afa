//! The wish to stop, from outside.

use std::ffi::c_int;
use std::fs;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

use crate::error::CliError;

/// Besides SIGTERM: the terminal has gone, the processor time is used up, the batch system is about to end the job.
#[cfg(unix)]
const ENDINGS: &[c_int] = {
    use signal_hook::consts::{SIGHUP, SIGUSR1, SIGUSR2, SIGXCPU};
    &[SIGHUP, SIGXCPU, SIGUSR1, SIGUSR2]
};
#[cfg(not(unix))]
const ENDINGS: &[c_int] = &[];

/// Raised by SIGINT, SIGTERM and [`ENDINGS`]. A second SIGINT, from a hand that will not wait, ends the process at once; not a second
/// SIGTERM, since `timeout` and batch systems send two in a row, and what was computed would be lost.
pub fn stop_flag() -> Result<Arc<AtomicBool>, CliError> {
    let (stop, interrupted) = (Arc::new(AtomicBool::new(false)), Arc::new(AtomicBool::new(false)));
    flag::register_conditional_shutdown(SIGINT, 6, Arc::clone(&interrupted))
        .and_then(|_| flag::register(SIGINT, interrupted))
        .map_err(CliError::Signals)?;
    let endings = ENDINGS.iter().copied().filter(|signal| !is_ignored(*signal));
    for signal in [SIGINT, SIGTERM].into_iter().chain(endings) {
        flag::register(signal, Arc::clone(&stop)).map_err(CliError::Signals)?;
    }
    Ok(stop)
}

/// Whether who started this process has it ignore `signal`, as `nohup` does: then it goes on where the terminal has gone. Where the
/// system does not say, it may be so of SIGHUP.
fn is_ignored(signal: c_int) -> bool {
    let Ok(status) = fs::read_to_string("/proc/self/status") else { return Some(&signal) == ENDINGS.first() };
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0);
    mask >> (signal - 1) & 1 == 1
}

/// Lets a write beyond the limit on the size of files fail, as on a full disk; otherwise SIGXFSZ would end the process.
pub fn let_large_writes_fail() -> Result<(), CliError> {
    #[cfg(unix)]
    flag::register(signal_hook::consts::SIGXFSZ, Arc::default()).map_err(CliError::Signals)?;
    Ok(())
}
