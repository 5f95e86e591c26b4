#pragma once

#include <cstddef>
#include <string>

#include <nlohmann/json.hpp>

namespace mapproof {

/// The form of all JSON that core writes: keys in the order given, two spaces an indent, numbers as
/// short as they can be read back exactly, non-finite ones as null. Arrays of plain values, and
/// whatever fits into 100 columns, stand on one line. Ends with a newline.
std::string json_text(const nlohmann::ordered_json& value);

/// An element of an array in such a file, as it stands there, without its indent and comma.
/// @param indent  Of the element, spaces.
std::string json_element(const nlohmann::ordered_json& value, std::size_t indent);

/// All on one line, with a newline at its end: a record of a .jsonl file.
std::string json_line(const nlohmann::ordered_json& value);

}  // namespace mapproof
