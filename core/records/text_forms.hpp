#pragma once

#include "core/json/fields.hpp"
#include "core/records/json_values.hpp"

namespace mapproof {

// Texts that stand in ids and names of files.

inline constexpr TextForm kPlainId = {
    "^[a-z][a-z0-9-]*$",
    [](std::string_view text) { return is_plain_id(text) && text[0] >= 'a' && text[0] <= 'z'; },
    "lower-case letters, digits and '-', a letter first"};

inline constexpr TextForm kPlainIdOrNone = {
    "^([a-z][a-z0-9-]*)?$",
    [](std::string_view text) { return text.empty() || kPlainId.holds(text); }, kPlainId.expected};

namespace record_rules {

inline constexpr FieldRule kId = {.max_bytes = 64, .form = &kPlainId};

}  // namespace record_rules

}  // namespace mapproof
