#include "core/external/external_method.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/sha256.hpp"
#include "core/json/record_reader.hpp"
#include "core/model/method.hpp"

namespace mapproof {

namespace fs = std::filesystem;

std::string_view name(ExternalInput input) {
  constexpr std::array<std::string_view, 3> kNames = {"distances", "features", "history"};
  return kNames[static_cast<std::size_t>(input)];
}

ExternalMethods parse_external_methods(std::string_view text, const std::string& source) {
  ExternalMethods all = from_json_text<ExternalMethods>(text, source);
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < all.methods.size(); ++i) {
    const std::string& name = all.methods[i].name;
    const std::string pointer = fmt::format("/methods/{}/name", i);
    if (method_named(name))
      throw IoError(source, pointer, fmt::format("\"{}\" is a method of mapproof", name));
    if (!names.insert(name).second) throw IoError(source, pointer, "is there twice");
  }
  return all;
}

std::vector<ExternalSetting> settings_of(const ExternalMethods& methods) {
  std::vector<ExternalSetting> settings;
  for (const ExternalMethod& method : methods.methods) {
    if (method.values.empty()) settings.push_back({.method = &method, .parameter = {}});
    for (const double value : method.values)
      settings.push_back({.method = &method, .parameter = value});
  }
  return settings;
}

std::string slug(const ExternalSetting& setting) {
  if (!setting.parameter) return setting.method->name;
  return fmt::format("{}-{}{}", setting.method->name, setting.method->symbol, *setting.parameter);
}

std::string label(const ExternalSetting& setting) {
  if (!setting.parameter) return setting.method->label;
  return fmt::format("{}, {} = {}", setting.method->label, setting.method->symbol,
                     *setting.parameter);
}

std::string digest_of(const ExternalMethod& method, const fs::path& folder) {
  if (method.files.empty()) return "";
  std::vector<std::string> files = method.files;
  std::ranges::sort(files);
  std::string digests;
  for (const std::string& file : files) {
    const fs::path path(file);
    if (path.is_absolute() || std::ranges::find(path, "..") != path.end())
      throw IoError(file, "a file of a method is below the folder of its methods.json");
    digests += file + " " + sha256_hex(read_file(folder / path)) + "\n";
  }
  return sha256_hex(digests);
}

}  // namespace mapproof
