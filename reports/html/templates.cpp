#include "reports/html/templates.hpp"

#include <span>
#include <system_error>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/resource.hpp"
#include "reports/html/template_check.hpp"

namespace mapproof {

std::span<const Resource> embedded_templates();

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargest = std::size_t{1} << 20;  ///< Bytes of one file.

/// Replaces the templates that the folder holds; a pipe or a device is not a template.
void override_from(const fs::path& folder, Templates& templates) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) throw IoError(folder.string(), "is not a folder");
  bool any = false;
  for (auto& [name, text] : templates.files) {
    const fs::path path = folder / name;
    if (!fs::exists(path, error)) continue;
    if (!fs::is_regular_file(path, error)) throw IoError(path.string(), "is not a file");
    text = read_file(path, kLargest);
    templates.sources[name] = path.string();
    any = true;
  }
  if (!any)
    throw IoError(folder.string(), "holds no template (report.mustache, report.css, \u2026)");
}

}  // namespace

Templates load_templates(const std::optional<fs::path>& folder) {
  Templates templates;
  for (const Resource& resource : embedded_templates()) {
    templates.files[std::string(resource.name)] = resource.bytes;
    templates.sources[std::string(resource.name)] = "templates/" + std::string(resource.name);
  }
  if (folder) override_from(*folder, templates);
  check_templates(templates.files, templates.sources);
  return templates;
}

}  // namespace mapproof
