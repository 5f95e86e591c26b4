#include "reports/history/whole_database.hpp"

#include <cstdint>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/results/quantity.hpp"
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

/// Of what studies declare, and of values of what neither they nor the dictionary have.
std::string damage_of_quantities(Database& database) {
  Statement declared(database, "SELECT id, label, unit, better FROM quantities");
  while (declared.step()) {
    const auto better = better_named(declared.text(3));
    if (!better) return fmt::format("no quantity is better \"{}\"", printable(declared.text(3)));
    std::string problem = problem_of({.id = declared.text(0),
                                      .label = declared.text(1),
                                      .unit = declared.text(2),
                                      .better = *better});
    if (!problem.empty()) return problem;
  }
  Statement undeclared(database,
                       "SELECT DISTINCT s.quantity FROM trends t JOIN series s ON s.id = t.series "
                       "LEFT JOIN quantities q ON q.study = t.study AND q.id = s.quantity "
                       "WHERE q.id IS NULL");
  while (undeclared.step())
    if (find_quantity(undeclared.text(0)) == nullptr)
      return fmt::format("it has values of the unknown quantity \"{}\"",
                         printable(undeclared.text(0)));
  return "";
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
  return damage_of_quantities(database);
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
