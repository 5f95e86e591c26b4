#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/json/fields.hpp"
#include "core/records/text_forms.hpp"

namespace mapproof {

/// What a method of somebody else gets for each map (docs/external-methods.md).
enum class ExternalInput {
  kDistances,  ///< M x M distances of the observation vectors; infinite: no common step.
  kFeatures,   ///< M x C observation vectors; 0 where nothing was observed.
  kHistory,    ///< M x N observations as they came; NaN: nothing observed.
};

/// "distances", "features", "history".
std::string_view name(ExternalInput input);

inline EnumNames enum_names(ExternalInput) {
  return names_up_to(ExternalInput::kHistory, "external_input");
}

/// A mapping method that is a command.
struct ExternalMethod {
  std::string name;
  std::string label;
  std::string source;
  ExternalInput input = ExternalInput::kDistances;
  std::vector<std::string> command;  ///< Started in the folder of methods.json.
  std::vector<std::string> files;    ///< What it is made of, below that folder.
  double timeout_s = 60.0;           ///< For each map.
  std::string symbol;                ///< Of its parameter; empty: it has none.
  std::vector<double> values;        ///< Of the parameter.
};

/// methods.json.
struct ExternalMethods {
  std::vector<ExternalMethod> methods;
};

template <typename Visitor>
void fields(Visitor& v, ExternalMethod& method) {
  v.type("external_method");
  v.field("name", method.name,
          {.description = "Unlike those of mapproof.", .max_bytes = 60, .form = &kPlainId});
  v.field("label", method.label, {.not_empty = true, .max_bytes = 200});
  v.field("source", method.source,
          {.description = "Author and year.", .max_bytes = 1000, .key = Key::kOptional});
  v.field("input", method.input);
  v.field("command", method.command,
          {.description = "The program and its arguments, started in the folder of this file.",
           .min_items = 1,
           .max_items = 100,
           .not_empty = true});
  v.field("files", method.files,
          {.description = "What the method is made of: their digest is part of the records.",
           .max_items = 1000,
           .key = Key::kOptional});
  v.field("timeout_s", method.timeout_s,
          {.description = "Seconds for each map; 60 where it is left out.",
           .minimum = 0.0,
           .maximum = 1e6,
           .above_minimum = true,
           .key = Key::kOptional});
  const auto visit = [&](auto& parameter) {
    parameter.field("symbol", method.symbol,
                    {.not_empty = true, .max_bytes = 20, .form = &kStudyName});
    parameter.field("values", method.values, {.unique = true, .min_items = 1, .max_items = 100});
  };
  v.group("parameter", visit, {.key = Key::kOptional});
}

template <typename Visitor>
void fields(Visitor& v, ExternalMethods& all) {
  v.file("mapproof.methods", "Mapping methods that are commands.");
  v.field("methods", all.methods, {.min_items = 1, .max_items = 100});
}

/// Reads methods.json. @throws IoError with the location; also for a name that is there twice or
///         that a method of mapproof has.
ExternalMethods parse_external_methods(std::string_view text, const std::string& source);

/// One method with one value of its parameter.
struct ExternalSetting {
  const ExternalMethod* method = nullptr;
  std::optional<double> parameter;
};

/// All of them, in the order of the file.
std::vector<ExternalSetting> settings_of(const ExternalMethods& methods);

/// "tsne", "tsne-perplexity10": unique in a file, safe in file names.
std::string slug(const ExternalSetting& setting);
/// "t-SNE, perplexity = 10".
std::string label(const ExternalSetting& setting);

/// SHA-256 of the bytes of the method's files, by their names; empty without files.
/// @throws IoError if one cannot be read or is not below `folder`.
std::string digest_of(const ExternalMethod& method, const std::filesystem::path& folder);

}  // namespace mapproof
