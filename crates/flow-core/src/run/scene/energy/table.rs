//! The list of energy terms.

use schemars::JsonSchema;
use serde::Serialize;

use super::{
    Adhesion, Agents, Area, Bending, EnergyTable, Length, Local, Membrane, Packing, Regularization, Start,
    Term,
};
use crate::run::scene::section::Section;

/// Defines [`Energy`] from the keys of its tables and their types, in the order in which terms are added up.
macro_rules! tables {
    ($($key:ident: $Table:ident),* $(,)?) => {
        /// Energies named by the scene; an absent table is an absent term.
        #[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
        #[schemars(extend("minProperties" = 1))]
        #[non_exhaustive]
        pub struct Energy {
            $(
                #[doc = concat!("Table `[energy.", stringify!($key), "]`.")]
                #[serde(skip_serializing_if = "Option::is_none")]
                pub $key: Option<$Table>,
            )*
        }

        impl Energy {
            /// Reads `[energy]`; `densities` are the names that terms may refer to. `None` if it has no term at all.
            pub(in crate::run::scene) fn read(mut section: Section<'_>, densities: &[String]) -> Option<Self> {
                let energy = Self {
                    $($key: section.section(stringify!($key)).and_then(|table| $Table::read(table, densities)),)*
                };
                let empty = section.is_empty();
                section.finish();
                (!empty).then_some(energy)
            }

            /// The tables that there are, with their keys.
            fn tables(&self) -> impl Iterator<Item = (&'static str, &dyn EnergyTable)> {
                let tables = [$((stringify!($key), self.$key.as_ref().map(|table| table as &dyn EnergyTable))),*];
                tables.into_iter().filter_map(|(key, table)| Some((key, table?)))
            }
        }
    };
}

tables! {
    bending: Bending,
    regularization: Regularization,
    length: Length,
    area: Area,
    adhesion: Adhesion,
    agents: Agents,
    membrane: Membrane,
    packing: Packing,
    local: Local,
}

impl Energy {
    /// The terms of a checked scene.
    pub(in crate::run) fn terms<'a>(&'a self, start: &'a Start<'_>) -> impl Iterator<Item = Term> + 'a {
        self.tables().map(|(_, table)| table.term(start))
    }

    /// Width of the sharpest fronts that the terms make, if any makes fronts.
    pub(in crate::run) fn front_width(&self) -> Option<f64> {
        self.tables().filter_map(|(_, table)| table.front_width()).reduce(f64::min)
    }

    /// What to try where the term `name` takes most of the time, if there is more to say than of any term.
    pub(in crate::run) fn cheaper(&self, name: &str) -> Option<&'static str> {
        self.tables().find(|(key, _)| *key == name)?.1.cheaper()
    }
}
