#pragma once

#include <span>
#include <string_view>

namespace mapproof {

/// What a name of the interface names.
enum class NameKind {
  kOption,      ///< Of the command line: "--kind", of one command alone: "diff --out".
  kValue,       ///< Of an option: a strategy.
  kKey,         ///< Of a JSON file: "landmarks".
  kColumn,      ///< Of a table that mapproof writes: "ellipse_rotation_deg" of a map.
  kFormat,      ///< Of a JSON file, the name of its schema: "mapproof.map".
  kExperiment,  ///< That `reproduce` knows: "labels".
};

/// A name that was replaced.
struct RetiredName {
  NameKind kind;
  std::string_view name;
  std::string_view now;
};

/// All of them. A name that is retired is refused in one line with its new one.
std::span<const RetiredName> retired_names();

/// The name that replaced `name`; empty if it is not a retired name of that kind.
/// @param among  The new name is one of these; empty: any.
std::string_view replacement_of(NameKind kind, std::string_view name,
                                std::span<const std::string_view> among = {});

}  // namespace mapproof
