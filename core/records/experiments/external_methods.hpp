#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/json/fields.hpp"
#include "core/model/experiment.hpp"
#include "core/records/text_forms.hpp"

namespace mapproof {

// The fields of mapping methods that are commands (core/json/fields.hpp): of an experiment, and of
// methods.json.

inline EnumNames enum_names(ExternalInput) {
  return names_up_to(ExternalInput::kHistory, "external_input");
}

/// Of a parameter: it stands in ids.
inline constexpr TextForm kSymbol = {
    "^[A-Za-z][A-Za-z0-9]*$",
    [](std::string_view text) {
      constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
      constexpr std::string_view kDigits = "0123456789";
      if (text.empty() || kLetters.find(text.front()) == std::string_view::npos) return false;
      for (const char c : text)
        if (kLetters.find(c) == std::string_view::npos && kDigits.find(c) == std::string_view::npos)
          return false;
      return true;
    },
    "letters and digits, a letter first"};

template <typename Visitor>
void fields(Visitor& v, ExternalMethod& method) {
  v.type("external_method");
  v.field("name", method.name,
          {.description = "Unlike those of mapproof.", .max_bytes = 40, .form = &kPlainId});
  v.field("label", method.label,
          {.description = "Its name in tables and figures.", .not_empty = true, .max_bytes = 100});
  v.field("source", method.source,
          {.description = "Author and year.", .max_bytes = 200, .key = Key::kIfAny});
  v.field("input", method.input, {.description = "What the command gets of each map."});
  v.field("command", method.command,
          {.description = "The program and its arguments, started in the folder of this file.",
           .min_items = 1,
           .max_items = 100,
           .not_empty = true});
  v.field("files", method.files,
          {.description = "What the method is made of: records know their SHA-256.",
           .max_items = 1000,
           .not_empty = true,
           .key = Key::kIfAny});
  v.field("timeout_s", method.timeout_s,
          {.description = "Seconds for each map; 60 where it is left out.",
           .minimum = 0.0,
           .maximum = 1e6,
           .above_minimum = true,
           .key = Key::kOptional});
  const auto visit = [&](auto& parameter) {
    parameter.field(
        "symbol", method.symbol,
        {.description = "As tables and figures show it.", .max_bytes = 20, .form = &kSymbol});
    parameter.field("values", method.values,
                    {.description = "One method for each value.",
                     .whole_as_integers = true,
                     .ascending = true,
                     .min_items = 1,
                     .max_items = 100});
  };
  v.group("parameter", visit,
          {.description = "What the method is tuned by.",
           .key = Key::kOptional,
           .written = !method.symbol.empty()});
}

/// methods.json.
struct ExternalMethodsFile {
  std::vector<ExternalMethod> methods;
};

template <typename Visitor>
void fields(Visitor& v, ExternalMethodsFile& file) {
  v.file("mapproof.methods", "Mapping methods that are commands.");
  v.field("methods", file.methods, {.min_items = 1, .max_items = 100});
}

/// What is wrong with the names of methods in one experiment, and with which of them.
struct ExternalNameFault {
  std::size_t method = 0;
  std::string what;
};

/// A name that is there twice or that mapproof has, or an id that two settings would have.
/// @param ours  The settings of mapproof's methods that stand beside them.
std::optional<ExternalNameFault> name_fault_of(std::span<const ExternalMethod> methods,
                                               std::span<const MethodSetting> ours);

/// Reads methods.json; the methods are started in its folder. @throws IoError with the location.
std::vector<ExternalMethod> parse_external_methods(std::string_view text,
                                                   const std::string& source);

/// SHA-256 of the bytes of the method's files, by their names; empty without files.
/// @throws IoError if one cannot be read or is not below the method's folder, InvalidInput if the
///         method has none.
std::string digest_of(const ExternalMethod& method);

}  // namespace mapproof
