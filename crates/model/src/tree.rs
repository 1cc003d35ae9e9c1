//! A model as a tree of values in SI units: the same keys as in a file, without its units and expressions.
//!
//! A number may be infinite or none at all here, as JSON has it not, so that such a number is found and not lost.

use std::fmt;

use indexmap::IndexMap;
use serde::de::value::{MapDeserializer, SeqDeserializer};
use serde::de::{self, Deserializer, IntoDeserializer, Visitor};
use serde::ser::{self, Serialize};

/// A value.
#[derive(Debug, Clone, PartialEq)]
pub enum Tree {
    /// Nothing.
    Null,
    /// A number, in SI.
    Number(f64),
    /// A whole number.
    Count(u64),
    /// True or false.
    Flag(bool),
    /// A text.
    Text(String),
    /// A list.
    List(Vec<Tree>),
    /// Values with keys.
    Map(IndexMap<String, Tree>),
}

impl Tree {
    /// What a part of a model says; nothing where it can't be said in such a tree.
    pub fn of<T: Serialize + ?Sized>(part: &T) -> Tree {
        part.serialize(Writer).unwrap_or(Tree::Null)
    }

    /// The value of a key, where there is one.
    pub fn get(&self, key: &str) -> Option<&Tree> {
        match self {
            Tree::Map(members) => members.get(key).filter(|value| **value != Tree::Null),
            Tree::Null
            | Tree::Number(_)
            | Tree::Count(_)
            | Tree::Flag(_)
            | Tree::Text(_)
            | Tree::List(_) => None,
        }
    }

    /// An entry of a list.
    pub fn entry(&self, index: usize) -> Option<&Tree> {
        match self {
            Tree::List(items) => items.get(index),
            Tree::Null
            | Tree::Number(_)
            | Tree::Count(_)
            | Tree::Flag(_)
            | Tree::Text(_)
            | Tree::Map(_) => None,
        }
    }

    /// The number, where this is one.
    pub fn number(&self) -> Option<f64> {
        match self {
            Tree::Number(number) => Some(*number),
            Tree::Null
            | Tree::Count(_)
            | Tree::Flag(_)
            | Tree::Text(_)
            | Tree::List(_)
            | Tree::Map(_) => None,
        }
    }

    /// The text, where this is one.
    pub fn text(&self) -> Option<&str> {
        match self {
            Tree::Text(text) => Some(text),
            Tree::Null
            | Tree::Number(_)
            | Tree::Count(_)
            | Tree::Flag(_)
            | Tree::List(_)
            | Tree::Map(_) => None,
        }
    }
}

impl From<&str> for Tree {
    fn from(text: &str) -> Tree {
        Tree::Text(text.to_owned())
    }
}

impl FromIterator<Tree> for Tree {
    fn from_iter<I: IntoIterator<Item = Tree>>(items: I) -> Tree {
        Tree::List(items.into_iter().collect())
    }
}

/// The word of a file for a choice.
pub fn word<T: Serialize + ?Sized>(choice: &T) -> String {
    match Tree::of(choice) {
        Tree::Text(word) => word,
        kind @ (Tree::Null
        | Tree::Number(_)
        | Tree::Count(_)
        | Tree::Flag(_)
        | Tree::List(_)
        | Tree::Map(_)) => {
            let kind = kind.get("type").and_then(Tree::text);
            kind.unwrap_or_default().to_owned()
        }
    }
}

impl<'de> IntoDeserializer<'de, Unwritten> for &'de Tree {
    type Deserializer = &'de Tree;
    fn into_deserializer(self) -> &'de Tree {
        self
    }
}

/// A part of a model is what its tree says.
impl<'de> Deserializer<'de> for &'de Tree {
    type Error = Unwritten;
    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Unwritten> {
        match self {
            Tree::Null => visitor.visit_unit(),
            Tree::Number(number) => visitor.visit_f64(*number),
            Tree::Count(count) => visitor.visit_u64(*count),
            Tree::Flag(flag) => visitor.visit_bool(*flag),
            Tree::Text(text) => visitor.visit_borrowed_str(text),
            Tree::List(items) => visitor.visit_seq(SeqDeserializer::new(items.iter())),
            Tree::Map(members) => {
                let members = members.iter().map(|(key, value)| (key.as_str(), value));
                visitor.visit_map(MapDeserializer::new(members))
            }
        }
    }
    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Unwritten> {
        match self {
            Tree::Null => visitor.visit_none(),
            value => visitor.visit_some(value),
        }
    }
    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Unwritten> {
        let word = self.text().unwrap_or_default();
        visitor.visit_enum(word.into_deserializer())
    }
    serde::forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf unit
        unit_struct newtype_struct seq tuple tuple_struct map struct identifier ignored_any
    }
}

/// What a tree can't hold, or a model.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct Unwritten(String);

impl ser::Error for Unwritten {
    fn custom<T: fmt::Display>(said: T) -> Self {
        Unwritten(said.to_string())
    }
}

impl de::Error for Unwritten {
    fn custom<T: fmt::Display>(said: T) -> Self {
        Unwritten(said.to_string())
    }
}

fn unwritten<T>() -> Result<T, Unwritten> {
    Err(Unwritten("no model holds such a value".to_owned()))
}

/// Writes a tree.
struct Writer;

type Written = Result<Tree, Unwritten>;

impl ser::Serializer for Writer {
    type Ok = Tree;
    type Error = Unwritten;
    type SerializeSeq = Items;
    type SerializeTuple = Items;
    type SerializeTupleStruct = ser::Impossible<Tree, Unwritten>;
    type SerializeTupleVariant = ser::Impossible<Tree, Unwritten>;
    type SerializeMap = Members;
    type SerializeStruct = Members;
    type SerializeStructVariant = ser::Impossible<Tree, Unwritten>;

    fn serialize_bool(self, value: bool) -> Written {
        Ok(Tree::Flag(value))
    }
    fn serialize_i8(self, value: i8) -> Written {
        Ok(Tree::Number(value.into()))
    }
    fn serialize_i16(self, value: i16) -> Written {
        Ok(Tree::Number(value.into()))
    }
    fn serialize_i32(self, value: i32) -> Written {
        Ok(Tree::Number(value.into()))
    }
    fn serialize_i64(self, _: i64) -> Written {
        unwritten()
    }
    fn serialize_u8(self, value: u8) -> Written {
        Ok(Tree::Count(value.into()))
    }
    fn serialize_u16(self, value: u16) -> Written {
        Ok(Tree::Count(value.into()))
    }
    fn serialize_u32(self, value: u32) -> Written {
        Ok(Tree::Count(value.into()))
    }
    fn serialize_u64(self, value: u64) -> Written {
        Ok(Tree::Count(value))
    }
    fn serialize_f32(self, value: f32) -> Written {
        Ok(Tree::Number(value.into()))
    }
    fn serialize_f64(self, value: f64) -> Written {
        Ok(Tree::Number(value))
    }
    fn serialize_char(self, value: char) -> Written {
        Ok(Tree::Text(value.to_string()))
    }
    fn serialize_str(self, value: &str) -> Written {
        Ok(Tree::Text(value.to_owned()))
    }
    fn serialize_bytes(self, _: &[u8]) -> Written {
        unwritten()
    }
    fn serialize_none(self) -> Written {
        Ok(Tree::Null)
    }
    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Written {
        value.serialize(self)
    }
    fn serialize_unit(self) -> Written {
        Ok(Tree::Null)
    }
    fn serialize_unit_struct(self, _: &'static str) -> Written {
        Ok(Tree::Null)
    }
    fn serialize_unit_variant(self, _: &'static str, _: u32, word: &'static str) -> Written {
        Ok(Tree::Text(word.to_owned()))
    }
    fn serialize_newtype_struct<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        value: &T,
    ) -> Written {
        value.serialize(self)
    }
    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
        _: &T,
    ) -> Written {
        unwritten()
    }
    fn serialize_seq(self, length: Option<usize>) -> Result<Items, Unwritten> {
        Ok(Items(Vec::with_capacity(length.unwrap_or(0))))
    }
    fn serialize_tuple(self, length: usize) -> Result<Items, Unwritten> {
        self.serialize_seq(Some(length))
    }
    fn serialize_tuple_struct(
        self,
        _: &'static str,
        _: usize,
    ) -> Result<Self::SerializeTupleStruct, Unwritten> {
        unwritten()
    }
    fn serialize_tuple_variant(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
        _: usize,
    ) -> Result<Self::SerializeTupleVariant, Unwritten> {
        unwritten()
    }
    fn serialize_map(self, length: Option<usize>) -> Result<Members, Unwritten> {
        Ok(Members {
            members: IndexMap::with_capacity(length.unwrap_or(0)),
            key: String::new(),
        })
    }
    fn serialize_struct(self, _: &'static str, length: usize) -> Result<Members, Unwritten> {
        self.serialize_map(Some(length))
    }
    fn serialize_struct_variant(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
        _: usize,
    ) -> Result<Self::SerializeStructVariant, Unwritten> {
        unwritten()
    }
}

/// A list that is being written.
struct Items(Vec<Tree>);

impl Items {
    fn add<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Unwritten> {
        self.0.push(value.serialize(Writer)?);
        Ok(())
    }
}

impl ser::SerializeSeq for Items {
    type Ok = Tree;
    type Error = Unwritten;
    fn serialize_element<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Unwritten> {
        self.add(value)
    }
    fn end(self) -> Written {
        Ok(Tree::List(self.0))
    }
}

impl ser::SerializeTuple for Items {
    type Ok = Tree;
    type Error = Unwritten;
    fn serialize_element<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Unwritten> {
        self.add(value)
    }
    fn end(self) -> Written {
        Ok(Tree::List(self.0))
    }
}

/// A map that is being written.
struct Members {
    members: IndexMap<String, Tree>,
    key: String,
}

impl ser::SerializeMap for Members {
    type Ok = Tree;
    type Error = Unwritten;
    fn serialize_key<T: Serialize + ?Sized>(&mut self, key: &T) -> Result<(), Unwritten> {
        match key.serialize(Writer)? {
            Tree::Text(key) => self.key = key,
            Tree::Null
            | Tree::Number(_)
            | Tree::Count(_)
            | Tree::Flag(_)
            | Tree::List(_)
            | Tree::Map(_) => {
                return unwritten();
            }
        }
        Ok(())
    }
    fn serialize_value<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Unwritten> {
        let key = std::mem::take(&mut self.key);
        self.members.insert(key, value.serialize(Writer)?);
        Ok(())
    }
    fn end(self) -> Written {
        Ok(Tree::Map(self.members))
    }
}

impl ser::SerializeStruct for Members {
    type Ok = Tree;
    type Error = Unwritten;
    fn serialize_field<T: Serialize + ?Sized>(
        &mut self,
        key: &'static str,
        value: &T,
    ) -> Result<(), Unwritten> {
        self.members
            .insert(key.to_owned(), value.serialize(Writer)?);
        Ok(())
    }
    fn end(self) -> Written {
        Ok(Tree::Map(self.members))
    }
}
