#include "app/output_paths.hpp"

#include <array>
#include <string>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/byte_source.hpp"
#include "core/base/files/paths.hpp"
#include "reports/diff/items.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

/// An output and what an earlier one of its type holds near its beginning.
struct Output {
  const char* option;
  fs::path path;
  std::string_view mark;
};

bool is_earlier_output(const Output& output) {
  return ByteSource(output.path).peek(4096).find(output.mark) != std::string_view::npos;
}

void check_path(const Output& output, const fs::path& input) {
  const fs::path path = real_path(output.path), compared = real_path(input);
  const auto refuse = [&](const char* why) {
    throw InvalidInput(
        fmt::format("{} {}: {}", output.option, printable(output.path.string()), why));
  };
  std::error_code error;
  if (path == compared) refuse("is what is compared");
  if (!lies_in(path, compared) || !fs::is_directory(compared, error)) return;
  if (!item_name(path, compared).kind.empty())
    refuse("is the path of a figure, image, table or page that is compared");
  if (fs::is_regular_file(path, error) && !is_earlier_output(output))
    refuse("is a file of a folder that is compared");
}

void require_replaceable(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw IoError(path.string(), "is not a regular file, and cannot be replaced");
}

}  // namespace

void check_output_paths(const DiffOptions& options, std::span<const fs::path> inputs) {
  const std::array outputs = {
      Output{"--page", options.page, "content=\"mapproof\""},
      Output{"--junit", options.junit, "<testsuites"},
      Output{"--markdown", options.markdown, "### mapproof diff"},
  };
  for (const fs::path& input : inputs)
    if (!options.images.empty() && !input.empty() && overlap(options.images, input))
      throw InvalidInput(fmt::format("--images {} and {}: one is the other or lies in it",
                                     printable(options.images), printable(input.string())));
  const auto is_file = [](const Output& o) { return !o.path.empty() && o.path != "-"; };
  for (const Output& output : outputs) {
    if (!is_file(output)) continue;
    for (const fs::path& input : inputs)
      if (!input.empty()) check_path(output, input);
    require_replaceable(output.path);
    if (!options.images.empty() && lies_in(real_path(output.path), real_path(options.images)))
      throw InvalidInput(fmt::format("{} {} lies in the folder of --images", output.option,
                                     printable(output.path.string())));
    for (const Output& other : outputs)
      if (&other != &output && is_file(other) && real_path(other.path) == real_path(output.path))
        throw InvalidInput(fmt::format("{} and {} are one file: {}", output.option, other.option,
                                       printable(output.path.string())));
  }
}

}  // namespace mapproof
