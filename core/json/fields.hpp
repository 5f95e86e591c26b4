#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/not_finite.hpp"

namespace mapproof {

/// Every record's fields are written down once, in a function template beside its type:
///
///   template <typename Visitor>
///   void fields(Visitor& v, Note& note) {
///     v.type("note");
///     v.field("text", note.text);
///     v.field("colour", note.colour, {.description = "Of the theme."});
///   }
///
/// From it record_writer.hpp makes the writer, record_reader.hpp the strict reader, and
/// tests/support/schemas/record_schema.hpp the schema in docs/schemas; other visitors may ask it
/// for more. FieldVisitor lists the calls that a visitor receives.
///
/// An enumeration has its names in `EnumNames enum_names(Enum)`; what is an array of fixed size in
/// files has its elements in `auto as_tuple(T&)`, a std::tuple of references. A map has any keys.
///
/// The functions are called with default values too, and by writers, which change nothing. What a
/// rule takes from another field is read behind that field.

/// Whether a key has to be there.
enum class Key {
  kRequired,
  kOptional,  ///< What a file leaves out keeps the value that it has by default.
  kIfAny,     ///< The same, and an empty value is neither written nor read, as null.
  kNotNull,   ///< Required, and an empty optional is neither written nor read, as null.
};

/// The rules of a value besides its type, in the words of JSON Schema. Of an array, all but the
/// numbers of its items hold for each item.
struct FieldRule {
  std::string_view description = {};
  double minimum = -kInfinity;
  double maximum = kInfinity;
  bool above_minimum = false;      ///< The minimum itself is too little.
  bool nullable = false;           ///< Numbers, or points, that are not finite are null.
  bool nullable_entries = false;   ///< The numbers of a matrix that are not finite are null.
  double null_is = kNaN;           ///< What null is read as.
  bool whole_as_integers = false;  ///< 1e5 is written as 100000.
  bool integer = false;            ///< Of a double: whole, and the same.
  bool upper_triangle = false;     ///< All that is held of a square matrix: row by row.
  bool as_columns = false;         ///< Of records: an object that has an array for each field.
  bool unique = false;             ///< No two items are equal.
  bool ascending = false;          ///< Each number is above the one before it.
  bool or_one = false;      ///< Of numbers: a file may give a single one without the brackets.
  std::size_t columns = 0;  ///< Of a matrix; 0: as the type has, or as many as the first row.
  std::size_t min_items = 0;
  std::size_t max_items = std::numeric_limits<std::size_t>::max();
  std::size_t max_keys = std::numeric_limits<std::size_t>::max();  ///< Of a map.
  bool not_empty = false;          ///< Of a text, and the rows of a matrix.
  std::size_t max_bytes = 10'000;  ///< Of a text.
  const struct TextForm* form = nullptr;
  const FieldRule* items = nullptr;  ///< Of arrays in an array: what each of them is held to.
  Key key = Key::kRequired;
  bool when = true;  ///< Else the key must not be there.
  /// Of an enumeration: `when` and `key` of fields that follow depend on it alone; of a text: on
  /// which of `known` it is, if any.
  bool decides = false;
  std::span<const std::string_view> known = {};
  bool written = true;  ///< Else left out by the writer.
};

/// Texts of a certain form.
struct TextForm {
  std::string_view pattern;              ///< Of the schema.
  bool (*holds)(std::string_view text);  ///< The same for the reader.
  std::string_view expected;             ///< "lower-case letters".
};

/// What the values of an enumeration are called in files, in the order of the enumerators from 0.
struct EnumNames {
  std::string_view type;  ///< "colour": of the enumeration in the schema and in messages.
  std::span<const std::string_view> names;
};

/// What a value is called in files.
template <typename Enum>
std::string_view name_in_files(Enum value) {
  return enum_names(value).names[static_cast<std::size_t>(value)];
}

/// The calls that a visitor receives. It overrides those that it needs; this one ignores all.
struct FieldVisitor {
  static constexpr bool kReads = false;  ///< Whether it fills the fields in.

  /// What the schema calls the record; without, it has no name of its own.
  void type(std::string_view) {}
  /// The description of the record.
  void about(std::string_view) {}
  /// First of a whole file: the name of its schema, "mapproof.figure", and its description.
  void file(std::string_view, std::string_view) {}
  /// First of an alternative of a variant: the key that distinguishes alternatives, and its value.
  void tag(std::string_view, std::string_view) {}
  /// A key and its value, in the order of files.
  template <typename T>
  void field(std::string_view, T&, const FieldRule& = {}) {}
  /// An object within the record: a key, and what visits its fields. Of the rule key, when,
  /// written and description count.
  template <typename Fields>
  void group(std::string_view, Fields, const FieldRule& = {}) {}
  /// How many of its keys a record has, where there are bounds to that.
  void key_count(std::size_t, std::size_t) {}
  /// What is wrong with the fields so far beyond the rules: at a key, "limits" or "axes/0/limits",
  /// or at an item of its array.
  void refuse(std::string_view, std::string_view) {}
  void refuse(std::string_view, std::size_t, std::string_view) {}
};

/// For visitors that change nothing.
template <typename Visitor, typename T>
void visit_fields(Visitor& visitor, const T& record) {
  fields(visitor, const_cast<T&>(record));
}

/// The names that name() gives to the enumerators up to the last one.
template <typename Enum>
EnumNames names_up_to(Enum last, std::string_view type) {
  static const std::vector<std::string_view> names = [last] {
    std::vector<std::string_view> all;
    for (std::size_t i = 0; i <= static_cast<std::size_t>(last); ++i)
      all.push_back(name(static_cast<Enum>(i)));
    return all;
  }();
  return {type, names};
}

}  // namespace mapproof
