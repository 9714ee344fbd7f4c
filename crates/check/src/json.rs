//! A strict reading of JSON (sections 1 and 3 of the specification). `serde_json` reads the text;
//! what is here sees to it that each value is of its own type and each member is there, once.

use crate::rejection::{Checked, Failure};
use serde::de::{Deserialize, Deserializer, Error, MapAccess, SeqAccess, Unexpected, Visitor};
use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;
use std::str::FromStr;

/// A value of the certificate's grammar.
pub(crate) trait Value: Sized {
    fn read<'de, D: Deserializer<'de>>(from: D) -> Result<Self, D::Error>;

    /// What a missing member amounts to, if it may be missing.
    fn missing() -> Option<Self> {
        None
    }
}

/// A member that may be missing.
#[derive(Debug)]
pub(crate) struct Optional<T>(pub Option<T>);

impl<T: Value> Value for Optional<T> {
    fn read<'de, D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        T::read(from).map(|value| Optional(Some(value)))
    }

    fn missing() -> Option<Self> {
        Some(Optional(None))
    }
}

/// A value where `serde` reads it: an entry of a list, or the value of a member.
pub(crate) struct Strict<T>(pub T);

impl<'de, T: Value> Deserialize<'de> for Strict<T> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        T::read(from).map(Strict)
    }
}

/// Reads a certificate.
pub(crate) fn parse<T: Value>(text: &[u8]) -> Checked<T> {
    let document = serde_json::from_slice(text);
    let Strict(document) = document.map_err(|error| Failure::rejected(error.to_string()))?;
    Ok(document)
}

/// Section 1, *int*. `serde_json` hands on what has a fraction, an exponent or a minus before zero
/// as a floating point number, which is refused here, and refuses leading zeros by itself.
struct Int;

pub(crate) const INT_LIMIT: u64 = 1 << 53;

impl Visitor<'_> for Int {
    type Value = i64;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an integer below 2^53")
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<i64, E> {
        let wrong = || E::invalid_value(Unexpected::Unsigned(value), &self);
        (value < INT_LIMIT)
            .then_some(value as i64)
            .ok_or_else(wrong)
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<i64, E> {
        let wrong = || E::invalid_value(Unexpected::Signed(value), &self);
        let small = value.unsigned_abs() < INT_LIMIT;
        small.then_some(value).ok_or_else(wrong)
    }
}

macro_rules! ints {
    ($($type:ty),*) => {$(
        impl Value for $type {
            fn read<'de, D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
                let value = from.deserialize_i64(Int)?;
                let wrong = |_| D::Error::custom(format!("{value} is out of range"));
                <$type>::try_from(value).map_err(wrong)
            }
        }
    )*};
}

ints!(u32, u64, usize, i64);

impl Value for String {
    fn read<'de, D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        String::deserialize(from)
    }
}

/// `null`, or a value.
impl<T: Value> Value for Option<T> {
    fn read<'de, D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let value = Option::<Strict<T>>::deserialize(from)?;
        Ok(value.map(|Strict(value)| value))
    }
}

struct List<T>(PhantomData<T>);

impl<'de, T: Value> Visitor<'de> for List<T> {
    type Value = Vec<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut entries: A) -> Result<Vec<T>, A::Error> {
        let mut list = Vec::new();
        while let Some(Strict(entry)) = entries.next_element()? {
            list.push(entry);
        }
        Ok(list)
    }
}

impl<T: Value> Value for Box<T> {
    fn read<'de, D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        T::read(from).map(Box::new)
    }
}

impl<T: Value> Value for Vec<T> {
    fn read<'de, D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_seq(List(PhantomData))
    }
}

/// Exactly so many values.
struct Array<T, const N: usize>(PhantomData<T>);

impl<'de, T: Value + Default, const N: usize> Visitor<'de> for Array<T, N> {
    type Value = [T; N];

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a list of {N} entries")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut entries: A) -> Result<[T; N], A::Error> {
        let mut list = std::array::from_fn(|_| T::default());
        for (k, place) in list.iter_mut().enumerate() {
            let Strict(entry) = entries
                .next_element()?
                .ok_or_else(|| Error::invalid_length(k, &self))?;
            *place = entry;
        }
        match entries.next_element::<Strict<T>>()? {
            None => Ok(list),
            Some(_) => Err(Error::invalid_length(N + 1, &self)),
        }
    }
}

impl<T: Value + Default, const N: usize> Value for [T; N] {
    fn read<'de, D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_seq(Array::<T, N>(PhantomData))
    }
}

/// Section 1, *big*: a decimal integer in its only spelling, as a number or as its digits.
#[derive(Debug, Default)]
pub(crate) struct Big<T>(pub T);

struct Decimal<T>(PhantomData<T>);

/// What is read from decimal digits.
pub(crate) trait Digits: FromStr {
    /// So many characters at most, where reading takes the square of their number.
    const MOST: usize = usize::MAX;
}

impl Digits for u64 {}
impl Digits for i128 {}
impl Digits for String {}

impl<T: Digits> Visitor<'_> for Decimal<T> {
    type Value = Big<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a string that holds a decimal integer")
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Big<T>, E> {
        let digits = text.strip_prefix('-').unwrap_or(text).as_bytes();
        let only_spelling = match digits {
            [b'0'] => digits.len() == text.len(),
            [b'1'..=b'9', rest @ ..] => rest.iter().all(u8::is_ascii_digit),
            _ => false,
        };
        let fits = only_spelling && text.len() <= T::MOST;
        let value = fits.then(|| text.parse().ok()).flatten();
        let wrong = || E::custom(format!("`{text}` is not an integer in range"));
        value.map(Big).ok_or_else(wrong)
    }
}

impl From<Big<u64>> for u64 {
    fn from(Big(value): Big<u64>) -> u64 {
        value
    }
}

impl<T: Digits> Value for Big<T> {
    fn read<'de, D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_str(Decimal(PhantomData))
    }
}

/// The name of a member, after its escapes are read.
pub(crate) struct Name<'de>(Cow<'de, str>);

impl Name<'_> {
    pub(crate) fn as_str(&self) -> &str {
        &self.0
    }
}

struct NameVisitor;

impl<'de> Visitor<'de> for NameVisitor {
    type Value = Name<'de>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the name of a member")
    }

    fn visit_borrowed_str<E: Error>(self, name: &'de str) -> Result<Name<'de>, E> {
        Ok(Name(Cow::Borrowed(name)))
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<Name<'de>, E> {
        Ok(Name(Cow::Owned(name.to_owned())))
    }
}

impl<'de> Deserialize<'de> for Name<'de> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_str(NameVisitor)
    }
}

/// Reads the value of a member, which must not have been there before.
pub(crate) fn fill<'de, A: MapAccess<'de>, T: Value>(
    object: &mut A,
    name: &str,
    place: &mut Option<T>,
) -> Result<(), A::Error> {
    if place.is_some() {
        return Err(Error::custom(format!("the member `{name}` is repeated")));
    }
    let Strict(value) = object.next_value()?;
    *place = Some(value);
    Ok(())
}

/// Evidence that was moved to the laboratory, as the member or the `kind` that it was.
const LABORATORY: [&str; 4] = ["oriented", "overlap", "added", "points"];

pub(crate) fn is_of_laboratory(name: &str) -> bool {
    LABORATORY.contains(&name)
}

/// Why a member, or a kind, is not known.
pub(crate) fn unknown<E: Error>(name: &str) -> E {
    Error::custom(if is_of_laboratory(name) {
        format!("evidence `{name}` belongs to the laboratory: this checker does not verify it")
    } else {
        format!("the member `{name}` does not belong there")
    })
}

/// The value of a member, which must be there unless it is optional.
pub(crate) fn present<T: Value, E: Error>(value: Option<T>, name: &str) -> Result<T, E> {
    let value = value.or_else(T::missing);
    value.ok_or_else(|| Error::custom(format!("the member `{name}` is missing")))
}

/// Declares types that are read from objects with exactly these members, in any order.
macro_rules! objects {
    ($($(#[$doc:meta])* $name:ident { $($member:ident: $type:ty),* $(,)? })*) => {$(
        $(#[$doc])*
        #[derive(Debug)]
        // A few members are for people alone; they are read so that their type is checked.
        #[allow(dead_code)]
        pub(crate) struct $name {
            $(pub $member: $type),*
        }

        impl $crate::json::Value for $name {
            fn read<'de, D: serde::Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
                struct ExactMembers;

                impl<'de> serde::de::Visitor<'de> for ExactMembers {
                    type Value = $name;

                    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        f.write_str("an object")
                    }

                    fn visit_map<A: serde::de::MapAccess<'de>>(
                        self,
                        mut object: A,
                    ) -> Result<$name, A::Error> {
                        $(let mut $member: Option<$type> = None;)*
                        while let Some(name) = object.next_key::<$crate::json::Name>()? {
                            match name.as_str() {
                                $(stringify!($member) => $crate::json::fill(
                                    &mut object, stringify!($member), &mut $member,
                                )?,)*
                                other => return Err($crate::json::unknown(other)),
                            }
                        }
                        Ok($name {
                            $($member: $crate::json::present($member, stringify!($member))?),*
                        })
                    }
                }

                from.deserialize_map(ExactMembers)
            }
        }
    )*};
}
pub(crate) use objects;

/// What a kind makes of a member that it has.
pub(crate) fn own<T: Value, U: TryFrom<T>, E: Error>(value: Option<T>, name: &str) -> Result<U, E> {
    let value = present(value, name)?;
    U::try_from(value).map_err(|_| Error::custom(format!("`{name}` is null")))
}

/// Declares objects of several kinds, each with its members; and for all members the types of their
/// values. A name has one type in all kinds, so that `kind` need not be the first member.
macro_rules! kinds {
    ($what:literal $name:ident {
        $($kind:literal $variant:ident { $($own:ident: $own_type:ty),* $(,)? })*
    } members { $($member:ident: $type:ty),* $(,)? }) => {
        $(
            #[derive(Debug)]
            pub(crate) struct $variant {
                $(pub $own: $own_type),*
            }
        )*

        #[derive(Debug)]
        pub(crate) enum $name {
            $($variant($variant)),*
        }

        impl $name {
            pub(crate) fn kind(&self) -> &'static str {
                match self {
                    $(Self::$variant(_) => $kind),*
                }
            }
        }

        #[derive(Default)]
        struct AnyMembers {
            kind: Option<String>,
            $($member: Option<$type>),*
        }

        impl AnyMembers {
            fn read<'de, A: serde::de::MapAccess<'de>>(mut object: A) -> Result<Self, A::Error> {
                let mut members = AnyMembers::default();
                let mut unknown: Option<String> = None;
                while let Some(name) = object.next_key::<$crate::json::Name>()? {
                    match name.as_str() {
                        "kind" => $crate::json::fill(&mut object, "kind", &mut members.kind)?,
                        $(stringify!($member) => $crate::json::fill(
                            &mut object, stringify!($member), &mut members.$member,
                        )?,)*
                        other => {
                            object.next_value::<serde::de::IgnoredAny>()?;
                            unknown = unknown.or(Some(other.into()));
                        }
                    }
                }
                // Where the kind is unknown as well, it says more.
                let kind = members.kind.clone();
                let kind = kind.filter(|kind| $crate::json::is_of_laboratory(kind));
                match unknown {
                    Some(name) => Err($crate::json::unknown(&kind.unwrap_or(name))),
                    None => Ok(members),
                }
            }

            /// The value of its kind, which has all members that are there, and no others.
            fn into_value<E: serde::de::Error>(mut self) -> Result<$name, E> {
                let kind: String = $crate::json::present(self.kind.take(), "kind")?;
                let value = match kind.as_str() {
                    $($kind => $name::$variant($variant {
                        $($own: $crate::json::own(self.$own.take(), stringify!($own))?),*
                    }),)*
                    other if $crate::json::is_of_laboratory(other) => {
                        return Err($crate::json::unknown(other));
                    }
                    other => return Err(E::custom(format!("`{other}` is no kind of {}", $what))),
                };
                $(if self.$member.is_some() {
                    return Err($crate::json::unknown(stringify!($member)));
                })*
                Ok(value)
            }
        }

        impl $crate::json::Value for $name {
            fn read<'de, D: serde::Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
                struct OfAnyKind;

                impl<'de> serde::de::Visitor<'de> for OfAnyKind {
                    type Value = $name;

                    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        f.write_str("an object")
                    }

                    fn visit_map<A: serde::de::MapAccess<'de>>(
                        self,
                        object: A,
                    ) -> Result<$name, A::Error> {
                        AnyMembers::read(object)?.into_value()
                    }
                }

                from.deserialize_map(OfAnyKind)
            }
        }
    };
}
pub(crate) use kinds;
