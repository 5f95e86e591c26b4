#include "core/records/studies/study_folder.hpp"

#include <system_error>

#include "core/base/errors.hpp"
#include "core/base/files.hpp"
#include "core/json/json_cursor.hpp"

namespace mapproof {

namespace fs = std::filesystem;

bool is_study(const fs::path& folder) {
  std::error_code error;
  return fs::is_regular_file(folder / kStudyFile, error);
}

void require_study(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) throw IoError(folder.string(), "does not exist");
  if (is_study(folder)) return;
  if (!fs::exists(folder / "results.csv", error))
    throw IoError(folder.string(), "holds no study: study.json is missing");
  throw IoError(folder.string(),
                "holds results.csv without study.json; write one beside it, at least "
                R"({"schema": {"name": "mapproof.results_study", "version": 1}, "title": "..."})");
}

std::string study_schema(const fs::path& folder) {
  if (!is_study(folder)) return "";
  const fs::path path = folder / kStudyFile;
  return schema_of(parse_json(read_file(path), path.string()).cursor()).name;
}

}  // namespace mapproof
