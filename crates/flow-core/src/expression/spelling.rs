//! What a name in the spelling of other languages is called here.

/// Names that are not close to ours letter by letter.
const SYNONYMS: [(&str, &str); 11] = [
    ("log", "ln"),
    ("fabs", "abs"),
    ("absolute", "abs"),
    ("square", "^2"),
    ("power", "^"),
    ("pow", "^"),
    ("π", "pi"),
    ("κ", "kappa"),
    ("ρ", "rho"),
    ("φ", "phi"),
    ("theta", "phi"),
];

/// What to write instead of `name`, in which a module may come first as in `np.exp`; none if that is not known.
pub(super) fn ours(name: &str, allowed: &[&str]) -> Option<String> {
    let last = name.rsplit('.').next().unwrap_or(name);
    if let Some((_, here)) = SYNONYMS.iter().find(|(there, _)| *there == last) {
        // A Greek letter says nothing where its variable does not exist.
        return (here.starts_with('^') || allowed.contains(here)).then(|| (*here).to_owned());
    }
    for (superscript, power) in [('²', "^2"), ('³', "^3")] {
        if let Some(base) = last.strip_suffix(superscript).filter(|base| allowed.contains(base)) {
            return Some(format!("{base}{power}"));
        }
    }
    (last != name && allowed.contains(&last)).then(|| last.to_owned())
}

/// The name from `start` to `end` of `text` with the attributes that follow it: `np` of `np.exp(kappa)` gives `np.exp`.
pub(super) fn dotted(text: &str, start: usize, end: usize) -> &str {
    let mut stop = end;
    while let Some(rest) = text[stop..].strip_prefix('.').filter(|rest| rest.starts_with(char::is_alphabetic))
    {
        let length = rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len());
        stop += 1 + length;
    }
    &text[start..stop]
}

#[cfg(test)]
mod tests {
    use super::super::Expression;

    fn message(text: &str) -> String {
        Expression::parse(text, &["kappa", "protein"]).unwrap_err().to_string()
    }

    #[test]
    fn python_is_told_what_to_write() {
        let power = "column 6: a power is written `^`, as in `kappa^2`, not `**`";
        assert_eq!(message("kappa**2"), power);
        assert_eq!(message("kappa ** 2"), "column 7: a power is written `^`, as in `kappa^2`, not `**`");
        for (text, found, here) in [
            ("np.exp(-kappa)", "np.exp", "exp"),
            ("2*numpy.pi", "numpy.pi", "pi"),
            ("np.log(kappa)", "np.log", "ln"),
            ("log(kappa)", "log", "ln"),
            ("jax.numpy.tanh(kappa)", "jax.numpy.tanh", "tanh"),
            ("np.power(kappa, 2)", "np.power", "^"),
            ("κ^2", "κ", "kappa"),
            ("2*kappa²", "kappa²", "kappa^2"),
        ] {
            let expected = format!("unknown name `{found}` (did you mean `{here}`?)");
            assert!(message(text).contains(&expected), "{text}: {}", message(text));
        }
        assert!(
            message("np.arcsinh(kappa)")
                .contains("unknown name `np.arcsinh`; allowed: kappa, protein, pi, exp")
        );
        assert!(message("ρ").contains("unknown name `ρ`; allowed"));
    }
}
