#include "reports/history/whole_database.hpp"

#include <cstdint>
#include <string>
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

/// What SQLite does not ask: a last page that was cut is read as if zeros stood at its end.
std::string damage_of_length(Database& database, const fs::path& path) {
  Statement page(database, "PRAGMA page_size");
  std::error_code error;
  const std::uintmax_t bytes = fs::file_size(path, error);
  if (error || !page.step() || bytes % static_cast<std::uintmax_t>(page.integer(0)) == 0) return "";
  return fmt::format("it is cut off after {} bytes", bytes);
}

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

std::unique_ptr<Database> open_whole(const fs::path& path, Database::Access access) {
  auto database = std::make_unique<Database>(path, access);
  std::string damage = database->damage();
  if (damage.empty()) damage = damage_of_length(*database, path);
  if (damage.empty()) damage = damage_of_tables(*database);
  if (damage.empty()) damage = damage_of_rows(*database);
  if (!damage.empty()) throw DamagedFile(path.string(), damage);
  return database;
}

}  // namespace mapproof
