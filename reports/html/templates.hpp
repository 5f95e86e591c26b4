#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace mapproof {

/// The files of a page:  "report.mustache", its parts, "report.css" and "report.js".
struct Templates {
  std::map<std::string, std::string> files;    ///< By name.
  std::map<std::string, std::string> sources;  ///< The origin of each, for messages.
};

/// The embedded templates, each replaced by the file of the same name in `folder` if it exists.
/// @throws IoError if `folder` is not a folder, or a file cannot be used (syntax, a template within
///         itself, an end tag within the style sheet or the script): "<path>: line: what".
Templates load_templates(const std::optional<std::filesystem::path>& folder = std::nullopt);

}  // namespace mapproof
