//! Values that are one of a few names.

/// Declares an enum whose variants have names in scenes; the name is written once, here.
macro_rules! names {
    ($(#[$doc:meta])* pub enum $type:ident { $($(#[$variant_doc:meta])* $variant:ident = $name:literal,)+ }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, schemars::JsonSchema)]
        #[non_exhaustive]
        pub enum $type {
            $($(#[$variant_doc])* #[schemars(rename = $name)] $variant,)+
        }

        impl $type {
            /// Every choice, in the order of the documentation.
            pub const ALL: &'static [Self] = &[$(Self::$variant),+];

            /// The name in scenes.
            #[must_use]
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)+
                }
            }
        }

        impl $crate::run::scene::choice::Choice for $type {
            const ALL: &'static [Self] = Self::ALL;

            fn name(self) -> &'static str {
                Self::name(self)
            }
        }

        impl serde::Serialize for $type {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.serialize_str(self.name())
            }
        }
    };
}

pub(super) use names;

/// A type whose values are named in scenes.
pub(super) trait Choice: Copy + 'static {
    /// Every choice.
    const ALL: &'static [Self];

    /// The name in scenes.
    fn name(self) -> &'static str;
}
