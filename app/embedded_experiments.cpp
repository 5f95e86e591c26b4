#include "app/embedded_experiments.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/errors.hpp"
#include "core/base/files.hpp"

namespace mapproof {

std::vector<std::string> experiment_names() {
  std::vector<std::string> names;
  for (const Resource& resource : embedded_experiments())
    names.push_back(std::filesystem::path(resource.name).stem().string());
  // Names end in the year of their paper.
  constexpr std::size_t kYear = 4;
  std::ranges::stable_sort(names, {}, [](const std::string& name) {
    return name.size() < kYear ? name : name.substr(name.size() - kYear);
  });
  return names;
}

ExperimentText experiment_text(const std::string& name,
                               const std::optional<std::filesystem::path>& templates) {
  for (const Resource& resource : embedded_experiments()) {
    if (std::filesystem::path(resource.name).stem() != name) continue;
    if (templates) {
      const std::filesystem::path own = *templates / "experiments" / resource.name;
      std::error_code error;
      if (std::filesystem::exists(own, error)) return {read_file(own), own.string()};
    }
    return {std::string(resource.bytes), fmt::format("embedded {}", resource.name)};
  }
  throw InvalidInput(fmt::format("no experiment \"{}\"; there is {}", printable(name),
                                 fmt::join(experiment_names(), ", ")));
}

}  // namespace mapproof
