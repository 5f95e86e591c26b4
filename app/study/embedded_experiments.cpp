#include "app/study/embedded_experiments.hpp"

#include <algorithm>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/errors.hpp"
#include "core/base/files/byte_source.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/input_file.hpp"
#include "core/base/text/retired_names.hpp"
#include "core/base/text/spelling.hpp"
#include "core/records/studies/study_folder.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kYear = 4;  ///< The names of papers' experiments end in so many digits.

bool is_of_paper(const std::string& name) {
  return name.size() > kYear &&
         name.find_first_not_of("0123456789", name.size() - kYear) == std::string::npos;
}

}  // namespace

std::vector<std::string> paper_names() {
  std::vector<std::string> names = experiment_names();
  std::erase_if(names, [](const std::string& name) { return !is_of_paper(name); });
  return names;
}

std::vector<std::string> experiment_names() {
  std::vector<std::string> names;
  for (const Resource& resource : embedded_experiments())
    names.push_back(std::filesystem::path(resource.name).stem().string());
  std::ranges::sort(names, {}, [](const std::string& name) {
    const std::string year = is_of_paper(name) ? name.substr(name.size() - kYear) : "";
    return std::tuple(!is_of_paper(name), year, name);
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
      if (std::filesystem::exists(own, error))
        return {read_file(own), own.string(), own.parent_path()};
    }
    return {std::string(resource.bytes), fmt::format("embedded {}", resource.name), {}};
  }
  if (const std::string_view now = replacement_of(NameKind::kExperiment, name); !now.empty())
    throw InvalidInput(fmt::format("the experiment {} is now called {}", name, now));
  const std::vector<std::string> names = experiment_names();
  const std::string_view meant =
      likely_word(name, std::vector<std::string_view>(names.begin(), names.end()));
  throw InvalidInput(fmt::format(
      "no experiment \"{}\"; {}there is {}, or a file by its path", printable(name),
      meant.empty() ? "" : fmt::format("did you mean \"{}\"? ", meant), fmt::join(names, ", ")));
}

bool is_experiment_file(const std::string& file_or_name) {
  std::error_code error;
  return handed_in(file_or_name) || std::filesystem::is_regular_file(file_or_name, error) ||
         file_or_name.find_first_of("./") != std::string::npos;
}

ExperimentText experiment_of(const std::string& file_or_name) {
  if (is_experiment_file(file_or_name))
    return {.text = read_input(file_or_name),
            .source = input_name(file_or_name),
            .folder = handed_in(file_or_name) ? std::filesystem::path()
                                              : std::filesystem::path(file_or_name).parent_path()};
  return experiment_text(file_or_name, std::nullopt);
}

std::vector<std::filesystem::path> study_folders(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> found;
  for (const std::string& name : experiment_names())
    if (is_study(folder / name)) found.push_back(folder / name);
  return found;
}

}  // namespace mapproof
