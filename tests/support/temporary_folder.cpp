#include "tests/support/temporary_folder.hpp"

#include <cstdlib>
#include <string>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"

namespace mapproof::test {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (fs::temp_directory_path() / "mapproof-test-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) throw IoError(pattern, "cannot be made");
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

fs::path TemporaryFolder::file(std::string_view name, std::string_view bytes) const {
  write_file(path_ / name, bytes);
  return path_ / name;
}

}  // namespace mapproof::test
