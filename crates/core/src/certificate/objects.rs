//! JSON objects and numbers as certificates write them.

use serde::{Serialize, Serializer};
use std::fmt::Display;

/// Declares objects by their members, in the order in which these are written; those behind
/// `optional` are left out if there are none.
macro_rules! objects {
    ($($name:ident $(<$($parameter:tt),+>)? {
        $($member:ident: $type:ty),* $(,)? $(; optional $($more:ident: $more_type:ty),* $(,)?)?
    })*) => {$(
        pub(super) struct $name $(<$($parameter),+>)? {
            $($member: $type,)*
            $($($more: Option<$more_type>),*)?
        }

        impl $(<$($parameter),+>)? Serialize for $name $(<$($parameter),+>)?
        where
            $($type: Serialize,)*
            $($($more_type: Serialize),*)?
        {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                use serde::ser::SerializeMap as _;
                let mut map = serializer.serialize_map(None)?;
                $(map.serialize_entry(stringify!($member), &self.$member)?;)*
                $($(if let Some(more) = &self.$more {
                    map.serialize_entry(stringify!($more), more)?;
                })*)?
                map.end()
            }
        }
    )*};
}
pub(super) use objects;

/// Writes an object by its members, in the order in which they stand here; those behind `optional` are
/// left out if there are none.
macro_rules! object {
    ($serializer:ident, {
        $($member:ident: $value:expr),* $(,)? $(; optional $($more:ident: $extra:expr),* $(,)?)?
    }) => {{
        use serde::ser::SerializeMap as _;
        let mut map = $serializer.serialize_map(None)?;
        $(map.serialize_entry(stringify!($member), &$value)?;)*
        $($(if let Some(more) = &$extra {
            map.serialize_entry(stringify!($more), more)?;
        })*)?
        map.end()
    }};
}
pub(super) use object;

/// Lets types be written so.
macro_rules! written {
    ($($type:ty: |$own:ident| $members:tt)*) => {$(
        impl Serialize for $type {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                let $own = self;
                object!(serializer, $members)
            }
        }
    )*};
}
pub(super) use written;

/// A number that other readers might round, as a string.
pub(super) struct Big<T>(pub(super) T);

impl<T: Display> Serialize for Big<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(&self.0)
    }
}

pub(super) fn bigs<T: Display>(values: &[T]) -> Vec<Big<&T>> {
    values.iter().map(Big).collect()
}
