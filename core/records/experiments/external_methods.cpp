#include "core/records/experiments/external_methods.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/sha256.hpp"
#include "core/json/record_reader.hpp"
#include "core/model/map_record.hpp"

namespace mapproof {

namespace fs = std::filesystem;

std::optional<ExternalNameFault> name_fault_of(std::span<const ExternalMethod> methods,
                                               std::span<const MethodSetting> ours) {
  std::set<std::string> names, ids;
  for (const MethodSetting& setting : ours) ids.insert(slug(setting));
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const ExternalMethod& method = methods[i];
    if (method_named(method.name) || method.name == kPairs || method.name == kSpectralMap)
      return {{i, fmt::format("\"{}\" is a method of mapproof", method.name)}};
    if (!names.insert(method.name).second) return {{i, "is there twice"}};
    const MethodGrid grid{method_of(method), method.values};
    for (const MethodSetting& setting : settings_of(std::vector{grid})) {
      const std::string id = slug(setting);
      if (id.size() > record_rules::kMethod.max_bytes)
        return {{i, fmt::format("the id \"{}\" is longer than {} bytes", id,
                                record_rules::kMethod.max_bytes)}};
      if (!ids.insert(id).second)
        return {{i, fmt::format("the id \"{}\" is that of another method, too", id)}};
    }
  }
  return std::nullopt;
}

std::vector<ExternalMethod> parse_external_methods(std::string_view text,
                                                   const std::string& source) {
  std::vector<ExternalMethod> methods = from_json_text<ExternalMethodsFile>(text, source).methods;
  if (const auto fault = name_fault_of(methods, {}))
    throw IoError(source, fmt::format("/methods/{}/name", fault->method), fault->what);
  for (ExternalMethod& method : methods) method.folder = fs::path(source).parent_path();
  return methods;
}

std::string digest_of(const ExternalMethod& method) {
  if (!method.folder) throw InvalidInput(method.name + ": has no folder");
  if (method.files.empty()) return "";
  std::vector<std::string> files = method.files;
  std::ranges::sort(files);
  std::string digests;
  for (const std::string& file : files) {
    const fs::path path(file);
    if (path.is_absolute() || std::ranges::find(path, "..") != path.end())
      throw IoError(file, "a file of a method is below the folder of the file that names it");
    digests += file + " " + sha256_hex(read_file(*method.folder / path)) + "\n";
  }
  return sha256_hex(digests);
}

}  // namespace mapproof
