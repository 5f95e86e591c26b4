// The history of nightly runs.
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/out_of_memory.hpp"
#include "reports/history/history_export.hpp"
#include "reports/history/history_store.hpp"
#include "tests/fuzz/properties.hpp"
#include "tests/fuzz/target.hpp"

namespace mapproof::fuzz {
namespace {

namespace fs = std::filesystem;

/// A folder in memory, where there is one, that is removed at the end.
struct Folder {
  fs::path path;

  Folder() {
    const fs::path memory = "/dev/shm";
    std::string name =
        ((fs::is_directory(memory) ? memory : fs::temp_directory_path()) / "mapproof-XXXXXX");
    if (::mkdtemp(name.data()) == nullptr) std::abort();
    path = name;
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
};

void read_all(HistoryStore store) {
  store.damage();
  for (const NightlyFacts& facts : store.nightly_runs()) {
    store.findings(facts.number);
    for (const NightlyStudy& study : store.studies(facts.number)) {
      store.scores(facts.number, study.name);
      store.trend(study.name, study.experiment_digest, 10, facts.number);
    }
  }
  store.digests();
  store.last_number();
  const auto ignore = [](std::string_view) {};
  export_history_csv(store, ignore);
  export_history_json(store, ignore);
}

/// As read_all. SQLite says that it is out of memory where a record says that it is larger.
void read_or_name(HistoryStore (*open)(const fs::path&), const fs::path& folder) {
  try {
    read_all(open(folder));
  } catch (const OutOfMemory& error) {
    const std::string file = history_file(folder).string();
    if (std::string_view(error.what()).find(file) == std::string_view::npos)
      found("what SQLite has no memory for is named", error.what());
    throw IoError(file, error.what());
  }
}

/// A store that is read stays as it is; one that is opened to be written to is migrated or refused.
void read_history(std::string_view bytes) {
  static const Folder folder;
  const fs::path file = history_file(folder.path);
  for (const auto& entry : fs::directory_iterator(folder.path)) fs::remove_all(entry.path());
  write_file(file, bytes);
  try {
    read_or_name(HistoryStore::open_existing, folder.path);
  } catch (const IoError&) {
    expect_equal("a store that is refused stays as it is", read_file(file), bytes);
  }
  read_or_name(HistoryStore::open, folder.path);
}
const Added kHistory({.name = "history", .run = read_history, .memory = std::size_t{96} << 20});

}  // namespace
}  // namespace mapproof::fuzz
