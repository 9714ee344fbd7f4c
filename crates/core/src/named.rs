//! Names of the variants of an enum: as they are written, and read.

/// Gives an enum `ALL`, `name`, `Display` and `FromStr`, with the error of what is no name.
macro_rules! named {
    ($type:ident { $($variant:ident = $name:literal),* $(,)? } $unknown:ident = $message:literal) => {
        impl $type {
            /// All of them, in the order of their declaration.
            pub const ALL: [Self; [$($name),*].len()] = [$(Self::$variant),*];

            /// The name in certificates, in JSON and on the command line.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)*
                }
            }
        }

        impl std::fmt::Display for $type {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.pad(self.name())
            }
        }

        #[doc = concat!("A word that is no name of a [`", stringify!($type), "`].")]
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub struct $unknown;

        impl std::fmt::Display for $unknown {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str($message)
            }
        }

        impl std::error::Error for $unknown {}

        impl std::str::FromStr for $type {
            type Err = $unknown;

            fn from_str(name: &str) -> Result<Self, $unknown> {
                match name {
                    $($name => Ok(Self::$variant),)*
                    _ => Err($unknown),
                }
            }
        }
    };
}
pub(crate) use named;
