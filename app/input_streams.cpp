#include "app/input_streams.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/byte_source.hpp"
#include "core/base/files/input_file.hpp"

namespace mapproof {
namespace {

/// Device and number of a stream.
using StreamId = std::pair<dev_t, ino_t>;

/// Of what can be read once; a file that has a name is opened again by it.
std::optional<StreamId> stream_id(const std::string& path) {
  const std::optional<int> number = handed_in(path);
  struct stat facts {};
  if (!number || ::fstat(*number, &facts) != 0) return std::nullopt;
  if (S_ISDIR(facts.st_mode) || (S_ISREG(facts.st_mode) && path != "-")) return std::nullopt;
  return StreamId{facts.st_dev, facts.st_ino};
}

}  // namespace

void refuse_shared_streams(std::span<const std::string> inputs) {
  std::map<StreamId, std::string> seen;
  for (const std::string& path : inputs) {
    const std::optional<StreamId> id = stream_id(path);
    if (!id) continue;
    const auto [other, is_new] = seen.emplace(*id, path);
    if (is_new) continue;
    throw InvalidInput(path == other->second
                           ? fmt::format("{} is given twice: it can be read once", input_name(path))
                           : fmt::format("{} and {} are one stream: it can be read once",
                                         input_name(other->second), input_name(path)));
  }
}

std::string made_file(const std::string& path) {
  constexpr std::size_t kLargest = std::size_t{1} << 28;
  if (!stream_id(path)) return path;
  const int number = *handed_in(path);
  const Descriptor file = anonymous_file(read_input(path, kLargest), input_name(path));
  const int flags = number > STDERR_FILENO ? O_CLOEXEC : 0;
  if (::dup3(file.get(), number, flags) < 0) throw IoError(input_name(path), std::strerror(errno));
  return path == "-" ? "/dev/stdin" : path;
}

}  // namespace mapproof
