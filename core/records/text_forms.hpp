#pragma once

#include <string_view>

#include "core/json/fields.hpp"

namespace mapproof {

// Texts that stand in ids and names of files.

inline bool is_plain(std::string_view text) {
  constexpr std::string_view kAllowed = "abcdefghijklmnopqrstuvwxyz0123456789-";
  return text.find_first_not_of(kAllowed) == std::string_view::npos;
}

inline constexpr TextForm kPlainText = {
    "^[a-z0-9-]+$", [](std::string_view text) { return !text.empty() && is_plain(text); },
    "letters a to z, digits and '-'"};

inline constexpr TextForm kPlainId = {"^[a-z][a-z0-9-]*$",
                                      [](std::string_view text) {
                                        return kPlainText.holds(text) && text[0] >= 'a' &&
                                               text[0] <= 'z';
                                      },
                                      "lower-case letters, digits and '-', a letter first"};

inline constexpr TextForm kPlainIdOrNone = {
    "^([a-z][a-z0-9-]*)?$",
    [](std::string_view text) { return text.empty() || kPlainId.holds(text); }, kPlainId.expected};

/// Of a method, with its parameter: "isomap-K6", "kpca-gaussian-sigma2-0.05".
inline constexpr TextForm kMethodId = {
    "^[a-z][A-Za-z0-9.+-]*$",
    [](std::string_view text) {
      constexpr std::string_view kAllowed =
          "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789.+-";
      return !text.empty() && text[0] >= 'a' && text[0] <= 'z' &&
             text.find_first_not_of(kAllowed) == std::string_view::npos;
    },
    "letters, digits, '.', '+' and '-', a small letter first"};

/// Of a figure of a paper: the ids that the program gives begin otherwise.
inline constexpr TextForm kFigureId = {
    "^fig-[a-z0-9-]*$",
    [](std::string_view text) { return text.starts_with("fig-") && is_plain(text); },
    "\"fig-\", then lower-case letters, digits and '-'"};

/// Of a table of a paper, likewise.
inline constexpr TextForm kTableId = {"^table-[a-z0-9-]*[a-z0-9]$",
                                      [](std::string_view text) {
                                        return text.starts_with("table-") && !text.ends_with('-') &&
                                               is_plain(text);
                                      },
                                      "\"table-\" and small letters, digits or '-'"};

/// Of an experiment.
inline constexpr TextForm kStudyName = {
    "^[A-Za-z0-9_-]+$",
    [](std::string_view text) {
      constexpr std::string_view kAllowed =
          "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";
      return !text.empty() && text.find_first_not_of(kAllowed) == std::string_view::npos;
    },
    "letters, digits, '-' and '_'"};

namespace record_rules {

inline constexpr FieldRule kId = {.max_bytes = 64, .form = &kPlainId};
inline constexpr FieldRule kMethod = {.max_bytes = 64, .form = &kMethodId};

}  // namespace record_rules

}  // namespace mapproof
