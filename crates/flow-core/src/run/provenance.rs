//! What made a record: program, machine, and what to cite.

/// Where a record comes from; the scene, the counters and the seconds spent are in the record itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Provenance {
    /// Version of Curveflow.
    pub version: String,
    /// Its commit, with `-dirty` if files differed from it; none if it was not built from a repository.
    pub commit: Option<String>,
    /// System, architecture and number of processors.
    pub machine: String,
    /// What to cite.
    pub citation: String,
}

const CITATION: &str = concat!(
    "Curveflow ",
    env!("CARGO_PKG_VERSION"),
    ". Model: K. Promislow, T. Vu and B. Wetton, ",
    "Gradient Flows of Interfacial Energies: Curvature Agents and Incompressibility."
);

impl Provenance {
    /// This program on this machine.
    #[must_use]
    pub fn here() -> Self {
        let processors = match std::thread::available_parallelism().map_or(0, usize::from) {
            1 => "1 processor".to_owned(),
            many => format!("{many} processors"),
        };
        Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            commit: option_env!("CURVEFLOW_COMMIT").map(str::to_owned),
            machine: format!("{} {}, {processors}", std::env::consts::OS, std::env::consts::ARCH),
            citation: CITATION.to_owned(),
        }
    }

    /// Whether `other` is the same program: the same version of the same commit.
    #[must_use]
    pub fn same_program(&self, other: &Self) -> bool {
        self.version == other.version && self.commit == other.commit
    }
}

impl std::fmt::Display for Provenance {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(out, "Curveflow {}", self.version)?;
        if let Some(commit) = &self.commit {
            write!(out, " ({commit})")?;
        }
        write!(out, " on {}", self.machine)
    }
}
