#include "tests/support/plaza.hpp"

#include <cstdlib>

#include "core/records/ranges/range_logs.hpp"

namespace mapproof::test {

std::optional<std::filesystem::path> plaza_folder() {
  const char* folder = std::getenv("MAPPROOF_PLAZA");
  if (folder == nullptr || *folder == '\0') return std::nullopt;
  return folder;
}

std::optional<RangeLog> plaza(const std::string& name) {
  const auto folder = plaza_folder();
  if (!folder) return std::nullopt;
  return read_range_log(*folder / name);
}

}  // namespace mapproof::test
