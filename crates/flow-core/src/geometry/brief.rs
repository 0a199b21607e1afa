//! Numbers in messages.

use std::fmt::{self, Display, Formatter};

/// Four digits of a number, with an exponent only where zeros would hide them.
pub(crate) struct Brief(pub f64);

impl Display for Brief {
    fn fmt(&self, out: &mut Formatter<'_>) -> fmt::Result {
        let size = self.0.abs();
        match size {
            0.0 => write!(out, "0"),
            1e-3..1e5 => {
                let decimals = (3.0 - size.log10().floor()).max(0.0) as usize;
                write!(out, "{:.decimals$}", self.0)
            }
            _ => write!(out, "{:.3e}", self.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Brief;

    #[test]
    fn digits_are_seen_and_zeros_are_few() {
        let texts = [0.0, 1.25704, -0.012345678, 99_999.4, 1e5, 1.0311e-8, f64::INFINITY]
            .map(|x| Brief(x).to_string());
        assert_eq!(texts, ["0", "1.257", "-0.01235", "99999", "1.000e5", "1.031e-8", "inf"]);
    }
}
