#include "reports/history/whole_database.hpp"

#include <cstdint>
#include <system_error>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "reports/history/night.hpp"
#include "reports/history/schema.hpp"

namespace mapproof {

namespace fs = std::filesystem;

namespace {

/// Far from where numbers would run over.
constexpr std::int64_t kMostNights = 100'000'000;

/// What SQLite's check cannot find: bytes that changed into words and numbers that have no meaning.
std::string damage_of_rows(Database& database) {
  if (version_of(database) != schema_version()) return "";
  Statement nights(database, "SELECT number, verdict FROM nights");
  while (nights.step()) {
    if (nights.integer(0) < 1 || nights.integer(0) > kMostNights)
      return fmt::format("there is no night {}", nights.integer(0));
    if (!night_verdict_named(nights.text(1)))
      return fmt::format("night {} has the unknown verdict \"{}\"", nights.integer(0),
                         printable(nights.text(1)));
  }
  Statement findings(database, "SELECT night, kind FROM findings");
  while (findings.step())
    if (!rule_named(findings.text(1)))
      return fmt::format("night {} has the unknown finding \"{}\"", findings.integer(0),
                         printable(findings.text(1)));
  return "";
}

}  // namespace

std::unique_ptr<Database> open_whole(const fs::path& path, Database::Access access,
                                     std::string& damage) {
  try {
    auto database = std::make_unique<Database>(path, access);
    damage = database->damage();
    if (damage.empty()) damage = damage_of_tables(*database);
    if (damage.empty()) damage = damage_of_rows(*database);
    if (damage.empty()) return database;
  } catch (const DamagedFile& error) {
    // What may not be read or is in use is not damaged: that is not caught.
    damage = error.damage();
  }
  return nullptr;
}

fs::path set_aside(const fs::path& path) {
  std::error_code error;
  fs::path aside;
  for (int i = 1; aside.empty() || fs::exists(aside, error); ++i)
    aside = path.string() + ".damaged-" + std::to_string(i);
  fs::rename(path, aside, error);
  if (error) throw IoError(path.string(), "is damaged and cannot be set aside: " + error.message());
  for (const char* journal : {"-journal", "-wal", "-shm"})
    fs::rename(path.string() + journal, aside.string() + journal, error);
  return aside;
}

}  // namespace mapproof
