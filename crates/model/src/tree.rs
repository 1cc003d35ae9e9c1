//! A model as a tree of values in SI units: the same keys as in a file, without its units and expressions.
//!
//! A number may be infinite or none at all here, as JSON has it not, so that such a number is found and not lost.

use std::fmt;

use indexmap::IndexMap;
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
            Tree::Null | Tree::Number(_) | Tree::Count(_) | Tree::Text(_) | Tree::List(_) => None,
        }
    }

    /// The text, where this is one.
    pub fn text(&self) -> Option<&str> {
        match self {
            Tree::Text(text) => Some(text),
            Tree::Null | Tree::Number(_) | Tree::Count(_) | Tree::List(_) | Tree::Map(_) => None,
        }
    }
}

/// The word of a file for a choice.
pub fn word<T: Serialize + ?Sized>(choice: &T) -> String {
    match Tree::of(choice) {
        Tree::Text(word) => word,
        kind @ (Tree::Null | Tree::Number(_) | Tree::Count(_) | Tree::List(_) | Tree::Map(_)) => {
            let kind = kind.get("type").and_then(Tree::text);
            kind.unwrap_or_default().to_owned()
        }
    }
}

/// What no tree can hold.
#[derive(Debug)]
pub struct Unwritten;

impl fmt::Display for Unwritten {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("no model holds such a value")
    }
}

impl std::error::Error for Unwritten {}

impl ser::Error for Unwritten {
    fn custom<T: fmt::Display>(_: T) -> Self {
        Unwritten
    }
}

/// Writes a tree.
struct Writer;

type Written = Result<Tree, Unwritten>;

impl ser::Serializer for Writer {
    type Ok = Tree;
    type Error = Unwritten;
    type SerializeSeq = Items;
    type SerializeTuple = Items;
    type SerializeTupleStruct = Items;
    type SerializeTupleVariant = ser::Impossible<Tree, Unwritten>;
    type SerializeMap = Members;
    type SerializeStruct = Members;
    type SerializeStructVariant = ser::Impossible<Tree, Unwritten>;

    fn serialize_bool(self, _: bool) -> Written {
        Err(Unwritten)
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
        Err(Unwritten)
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
        Err(Unwritten)
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
        Err(Unwritten)
    }
    fn serialize_seq(self, length: Option<usize>) -> Result<Items, Unwritten> {
        Ok(Items(Vec::with_capacity(length.unwrap_or(0))))
    }
    fn serialize_tuple(self, length: usize) -> Result<Items, Unwritten> {
        self.serialize_seq(Some(length))
    }
    fn serialize_tuple_struct(self, _: &'static str, length: usize) -> Result<Items, Unwritten> {
        self.serialize_seq(Some(length))
    }
    fn serialize_tuple_variant(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
        _: usize,
    ) -> Result<Self::SerializeTupleVariant, Unwritten> {
        Err(Unwritten)
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
        Err(Unwritten)
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

impl ser::SerializeTupleStruct for Items {
    type Ok = Tree;
    type Error = Unwritten;
    fn serialize_field<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Unwritten> {
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
            Tree::Null | Tree::Number(_) | Tree::Count(_) | Tree::List(_) | Tree::Map(_) => {
                return Err(Unwritten);
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
