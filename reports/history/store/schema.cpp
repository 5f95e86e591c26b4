#include "reports/history/store/schema.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <system_error>

#include <fmt/format.h>
#include <sqlite3.h>

#include "core/base/errors.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/results/quantity.hpp"
#include "reports/history/nightly_notes.hpp"
#include "reports/history/nightly_run.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

/// "mppf": marks our stores among other SQLite files, in PRAGMA application_id.
constexpr int kApplication = 0x6d707066;

constexpr const char* kVersion1 = R"(
CREATE TABLE nights (
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  started_utc TEXT NOT NULL,
  ended_utc TEXT NOT NULL,
  command TEXT NOT NULL,
  provenance TEXT NOT NULL,
  host TEXT NOT NULL,
  processor TEXT NOT NULL,
  cores INTEGER NOT NULL,
  jobs INTEGER NOT NULL,
  reference INTEGER,
  verdict TEXT NOT NULL
);
CREATE TABLE studies (
  id INTEGER PRIMARY KEY,
  night INTEGER NOT NULL REFERENCES nights(number) ON DELETE CASCADE,
  name TEXT NOT NULL,
  kind TEXT NOT NULL,
  order_digest TEXT NOT NULL,
  runs INTEGER NOT NULL,
  seconds REAL,
  peak_memory_mib REAL,
  UNIQUE (night, name)
);
CREATE TABLE series (
  id INTEGER PRIMARY KEY,
  sensor TEXT NOT NULL,
  method TEXT NOT NULL,
  step INTEGER NOT NULL,
  quantity TEXT NOT NULL,
  UNIQUE (sensor, method, step, quantity)
);
CREATE TABLE runs (
  id INTEGER PRIMARY KEY,
  name TEXT NOT NULL UNIQUE,
  unit TEXT NOT NULL
);
CREATE TABLE scores (
  study INTEGER NOT NULL REFERENCES studies(id) ON DELETE CASCADE,
  series INTEGER NOT NULL REFERENCES series(id),
  run INTEGER NOT NULL REFERENCES runs(id),
  value REAL,
  PRIMARY KEY (study, series, run)
) WITHOUT ROWID;
CREATE TABLE trends (
  study INTEGER NOT NULL REFERENCES studies(id) ON DELETE CASCADE,
  series INTEGER NOT NULL REFERENCES series(id),
  runs INTEGER NOT NULL,
  median REAL,
  level REAL,
  PRIMARY KEY (study, series)
) WITHOUT ROWID;
CREATE TABLE figures (
  study INTEGER NOT NULL REFERENCES studies(id) ON DELETE CASCADE,
  file TEXT NOT NULL,
  digest TEXT NOT NULL,
  bytes INTEGER NOT NULL,
  PRIMARY KEY (study, file)
) WITHOUT ROWID;
CREATE INDEX figures_by_digest ON figures(digest);
)";

/// Pins, and what was found, one by one: before, a nightly run had its verdict alone.
constexpr const char* kVersion2 = R"(
ALTER TABLE nights ADD COLUMN pinned INTEGER NOT NULL DEFAULT 0;
CREATE TABLE findings (
  id INTEGER PRIMARY KEY,
  night INTEGER NOT NULL REFERENCES nights(number) ON DELETE CASCADE,
  study TEXT NOT NULL,
  kind TEXT NOT NULL,
  subject TEXT NOT NULL,
  quantity TEXT NOT NULL,
  since INTEGER NOT NULL,
  sentence TEXT NOT NULL
);
CREATE INDEX findings_by_night ON findings(night);
)";

/// What studies declare in addition to the dictionary of quantities. Before, a number that the
/// dictionary did not have was of "other", with its name behind the method's, and the error of the
/// observation matrix had another name.
constexpr const char* kVersion3 = R"(
CREATE TABLE quantities (
  study INTEGER NOT NULL REFERENCES studies(id) ON DELETE CASCADE,
  id TEXT NOT NULL,
  label TEXT NOT NULL,
  unit TEXT NOT NULL,
  better TEXT NOT NULL,
  PRIMARY KEY (study, id)
) WITHOUT ROWID;
INSERT OR IGNORE INTO quantities (study, id, label, unit, better)
  SELECT t.study, substr(s.method, instr(s.method, ' ') + 1),
         substr(s.method, instr(s.method, ' ') + 1), '', 'neither'
  FROM trends t JOIN series s ON s.id = t.series
  WHERE s.quantity = 'other' AND instr(s.method, ' ') > 0;
UPDATE series SET quantity = substr(method, instr(method, ' ') + 1),
                  method = substr(method, 1, instr(method, ' ') - 1)
  WHERE quantity = 'other' AND instr(method, ' ') > 0;
UPDATE series SET quantity = 'observation_error' WHERE quantity = 'observation';
UPDATE findings SET quantity = 'observation_error' WHERE quantity = 'observation';
)";

/// What a study itself calls its setups and methods. Before, methods had mapproof's labels, which
/// are wrong where a study declares its own methods: there each label is its id, the part before
/// its levels ("ekf" of "ekf noise=0.1").
constexpr const char* kVersion4 = R"(
CREATE TABLE labels (
  study INTEGER NOT NULL REFERENCES studies(id) ON DELETE CASCADE,
  kind TEXT NOT NULL,
  id TEXT NOT NULL,
  label TEXT NOT NULL,
  PRIMARY KEY (study, kind, id)
) WITHOUT ROWID;
INSERT OR IGNORE INTO labels (study, kind, id, label)
  SELECT study, 'method', id, id FROM (
    SELECT study, CASE WHEN words = '' THEN method ELSE words END AS id FROM (
      SELECT study, method, rtrim(rtrim(head, replace(head, ' ', ''))) AS words FROM (
        SELECT t.study, s.method,
               CASE WHEN instr(s.method, '=') = 0 THEN s.method || ' '
                    ELSE substr(s.method, 1, instr(s.method, '=') - 1) END AS head
        FROM trends t JOIN series s ON s.id = t.series JOIN studies u ON u.id = t.study
        WHERE u.kind IN ('mapproof.results_study', 'mapproof.trial_study'))));
)";

/// Nightly runs were called nights.
constexpr const char* kVersion5 = R"(
ALTER TABLE nights RENAME TO nightly_runs;
ALTER TABLE studies RENAME COLUMN night TO nightly_run;
ALTER TABLE findings RENAME COLUMN night TO nightly_run;
DROP INDEX findings_by_night;
CREATE INDEX findings_by_nightly_run ON findings(nightly_run);
)";

/// Studies of a topic, the digests of experiments and runs that passed had other names.
constexpr const char* kVersion6 = R"(
ALTER TABLE studies RENAME COLUMN order_digest TO experiment_digest;
UPDATE studies SET kind = 'mapproof.topic_study' WHERE kind = 'mapproof.trial_study';
UPDATE nightly_runs SET verdict = 'passed' WHERE verdict = 'good';
)";

/// Which commit was under test and where it is shown, the local time, by how much findings changed,
/// and what people said of them. The identifier is random, as UUIDs of version 4 are.
constexpr const char* kVersion7 = R"(
ALTER TABLE nightly_runs ADD COLUMN utc_offset_s INTEGER NOT NULL DEFAULT 0;
ALTER TABLE nightly_runs ADD COLUMN commit_id TEXT NOT NULL DEFAULT '';
ALTER TABLE nightly_runs ADD COLUMN repository TEXT NOT NULL DEFAULT '';
ALTER TABLE nightly_runs ADD COLUMN build TEXT NOT NULL DEFAULT '';
ALTER TABLE findings ADD COLUMN change REAL;
CREATE TABLE notes (
  id INTEGER PRIMARY KEY,
  nightly_run INTEGER NOT NULL,
  finding INTEGER NOT NULL,
  kind TEXT NOT NULL,
  study TEXT NOT NULL,
  subject TEXT NOT NULL,
  quantity TEXT NOT NULL,
  since INTEGER NOT NULL,
  change REAL,
  text TEXT NOT NULL,
  written_utc TEXT NOT NULL
);
CREATE TABLE facts (
  name TEXT PRIMARY KEY,
  value TEXT NOT NULL
) WITHOUT ROWID;
INSERT INTO facts (name, value)
  SELECT 'identifier', 'urn:uuid:' || substr(h, 1, 8) || '-' || substr(h, 9, 4) || '-4' ||
         substr(h, 14, 3) || '-a' || substr(h, 18, 3) || '-' || substr(h, 21, 12)
  FROM (SELECT lower(hex(randomblob(16))) AS h);
)";

/// The order of a study's methods, which their styles in figures depend on.
constexpr const char* kVersion8 = R"(
ALTER TABLE labels ADD COLUMN position INTEGER NOT NULL DEFAULT 0;
)";

constexpr std::array kVersions = {kVersion1, kVersion2, kVersion3, kVersion4,
                                  kVersion5, kVersion6, kVersion7, kVersion8};

int pragma(Database& database, const std::string& name) {
  Statement statement(database, "PRAGMA " + name);
  return statement.step() ? static_cast<int>(statement.integer(0)) : 0;
}

void make_tables_from(Database& database, int from, int version) {
  Transaction transaction(database);
  for (int next = from; next < version; ++next)
    database.execute(kVersions.at(static_cast<std::size_t>(next)));
  database.execute(
      fmt::format("PRAGMA user_version = {}; PRAGMA application_id = {}", version, kApplication));
  transaction.commit();
}

/// "nightly_runs.number" of every column there is. Names, since how a statement is written down is
/// SQLite's.
std::set<std::string> columns_of(Database& database) {
  Statement rows(database,
                 "SELECT t.name || '.' || c.name FROM sqlite_schema t "
                 "JOIN pragma_table_info(t.name) c WHERE t.type = 'table'");
  std::set<std::string> columns;
  while (rows.step()) columns.insert(rows.text(0));
  return columns;
}

/// By SQLite's own copy, which is whole whatever a killed writer left.
void copy_to(Database& database, const fs::path& path) {
  fs::path beside = path;
  beside += ".part";
  std::error_code error;
  fs::remove(beside, error);
  {
    Database copy(beside, Database::Access::kCreate);
    sqlite3_backup* backup = sqlite3_backup_init(copy.handle(), "main", database.handle(), "main");
    if (backup == nullptr) copy.fail();
    const int code = sqlite3_backup_step(backup, -1);
    sqlite3_backup_finish(backup);
    if (code != SQLITE_DONE) copy.fail();
  }
  fs::rename(beside, path, error);
  if (error) throw IoError(path.string(), "cannot be put in place: " + error.message());
  sync_folder(path.parent_path());
}

fs::path free_name(const fs::path& path) {
  fs::path candidate = path;
  std::error_code error;
  for (int i = 2; fs::exists(candidate, error); ++i)
    candidate = path.string() + "-" + std::to_string(i);
  return candidate;
}

}  // namespace

namespace fs = std::filesystem;

namespace {

/// Far from where numbers would run over.
constexpr std::int64_t kMostNightlyRuns = 100'000'000;

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

/// Of the numbers that trends are drawn of: SQLite's columns hold any text and infinity, too.
std::string damage_of_trends(Database& database) {
  Statement rows(database,
                 "SELECT u.nightly_run, u.name, s.sensor, s.method, s.step, s.quantity "
                 "FROM trends t JOIN studies u ON u.id = t.study JOIN series s ON s.id = t.series "
                 "WHERE typeof(t.median) NOT IN ('real', 'integer', 'null') "
                 "OR typeof(t.level) NOT IN ('real', 'integer', 'null') "
                 "OR abs(t.median) > 1.7976931348623157e308 "
                 "OR abs(t.level) > 1.7976931348623157e308");
  if (!rows.step()) return "";
  const SeriesId series{.sensor = rows.text(2),
                        .method = rows.text(3),
                        .step = static_cast<int>(rows.integer(4)),
                        .quantity = rows.text(5)};
  return printable(fmt::format("nightly run {}, study {}: the trend of {} of {} is not a number",
                               rows.integer(0), rows.text(1), series.quantity, subject_of(series)),
                   1000);
}

/// Of texts that SQLite refuses to read for their length: fails where there is one.
std::string damage_of_texts(Database& database) {
  for (const char* all :
       {"SELECT max(length(started_utc), length(ended_utc), length(command), length(provenance), "
        "length(host), length(processor), length(commit_id), length(repository), length(build)) "
        "FROM nightly_runs",
        "SELECT max(length(name), length(kind), length(experiment_digest)) FROM studies",
        "SELECT max(length(sensor), length(method), length(quantity)) FROM series",
        "SELECT max(length(name), length(unit)) FROM runs",
        "SELECT max(length(study), length(subject), length(quantity), length(sentence)) "
        "FROM findings",
        "SELECT max(length(study), length(subject), length(quantity), length(text), "
        "length(written_utc)) FROM notes",
        "SELECT max(length(id), length(label)) FROM labels", "SELECT length(value) FROM facts"}) {
    Statement rows(database, all);
    rows.run();
  }
  return "";
}

/// Of seconds and memory, which costs are judged by.
std::string damage_of_costs(Database& database) {
  Statement rows(database,
                 "SELECT nightly_run, name FROM studies "
                 "WHERE typeof(seconds) NOT IN ('real', 'integer', 'null') "
                 "OR typeof(peak_memory_mib) NOT IN ('real', 'integer', 'null') "
                 "OR abs(seconds) > 1.7976931348623157e308 "
                 "OR abs(peak_memory_mib) > 1.7976931348623157e308");
  if (!rows.step()) return "";
  return printable(fmt::format("nightly run {}, study {}: its seconds or its memory are not a "
                               "number",
                               rows.integer(0), rows.text(1)),
                   1000);
}

/// The types that a value of a declared column may have, as typeof() names them. NULL is left to
/// SQLite's check.
const char* types_of(std::string_view declared) {
  if (declared == "INTEGER") return "'integer', 'null'";
  return declared == "REAL" ? "'real', 'integer', 'null'" : "'text', 'null'";
}

/// Of values of other types than their columns declare, which SQLite keeps, and reads as 0.
std::string damage_of_types(Database& database) {
  Database whole(":memory:", Database::Access::kCreate);
  make_tables(whole, schema_version());
  Statement columns(whole,
                    "SELECT t.name, c.name, c.type FROM sqlite_schema t "
                    "JOIN pragma_table_info(t.name) c WHERE t.type = 'table' AND c.type <> ''");
  std::map<std::string, std::string> cases;  // Of each table: the first column that is wrong.
  while (columns.step())
    cases[columns.text(0)] += fmt::format(" WHEN typeof({0}) NOT IN ({1}) THEN '{0}'",
                                          columns.text(1), types_of(columns.text(2)));
  for (const auto& [table, wrong] : cases) {
    Statement rows(database,
                   fmt::format("SELECT CASE{} END AS wrong FROM {} WHERE wrong IS NOT NULL LIMIT 1",
                               wrong, table));
    if (rows.step())
      return fmt::format("a value of {}.{} is not of the column's type", table, rows.text(0));
  }
  return "";
}

/// Of times that are none: "2026-01-02T03:04:05Z" alone is one.
std::string damage_of_times(Database& database) {
  Statement rows(database,
                 "SELECT number, started_utc, ended_utc FROM nightly_runs "
                 "WHERE strftime('%Y-%m-%dT%H:%M:%SZ', started_utc) IS NOT started_utc "
                 "OR (ended_utc <> '' "
                 "AND strftime('%Y-%m-%dT%H:%M:%SZ', ended_utc) IS NOT ended_utc)");
  if (!rows.step()) return "";
  return fmt::format("nightly run {} has no time from \"{}\" to \"{}\"", rows.integer(0),
                     printable(rows.text(1)), printable(rows.text(2)));
}

bool is_file_name(std::string_view name) {
  constexpr std::size_t kLongest = 255;
  return !name.empty() && name.size() <= kLongest && name != "." && name != ".." &&
         name.find('/') == std::string_view::npos && name.find('\0') == std::string_view::npos;
}

bool is_digest(std::string_view text) {
  constexpr std::size_t kDigits = 64;
  return text.size() == kDigits &&
         text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

/// What SQLite's check cannot find: bytes that changed into names and numbers without meaning.
std::string damage_of_rows(Database& database) {
  if (version_of(database) != schema_version()) return "";
  Statement nightly_runs(database, "SELECT number, verdict FROM nightly_runs");
  while (nightly_runs.step()) {
    if (nightly_runs.integer(0) < 1 || nightly_runs.integer(0) > kMostNightlyRuns)
      return fmt::format("there is no nightly run {}", nightly_runs.integer(0));
    if (!nightly_verdict_named(nightly_runs.text(1)))
      return fmt::format("nightly run {} has the unknown verdict \"{}\"", nightly_runs.integer(0),
                         printable(nightly_runs.text(1)));
  }
  // Both are parts of paths.
  Statement studies(database, "SELECT name FROM studies");
  while (studies.step())
    if (!is_file_name(studies.text(0)))
      return fmt::format("no study has the name \"{}\"", printable(studies.text(0)));
  Statement figures(database, "SELECT DISTINCT digest FROM figures");
  while (figures.step())
    if (!is_digest(figures.text(0)))
      return fmt::format("no file has the SHA-256 \"{}\"", printable(figures.text(0)));
  Statement findings(database, "SELECT nightly_run, kind FROM findings");
  while (findings.step())
    if (!rule_named(findings.text(1)))
      return fmt::format("nightly run {} has the unknown finding \"{}\"", findings.integer(0),
                         printable(findings.text(1)));
  Statement notes(database, "SELECT nightly_run, kind FROM notes");
  while (notes.step())
    if (!note_kind_named(notes.text(1)))
      return fmt::format("nightly run {} has a note of the unknown kind \"{}\"", notes.integer(0),
                         printable(notes.text(1)));
  for (const auto& damage_of :
       {damage_of_texts, damage_of_trends, damage_of_costs, damage_of_types, damage_of_times})
    if (std::string damage = damage_of(database); !damage.empty()) return damage;
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

int schema_version() { return static_cast<int>(kVersions.size()); }

int version_of(Database& database) {
  const int version = pragma(database, "user_version");
  if (version == 0 && pragma(database, "schema_version") == 0) return 0;
  if (pragma(database, "application_id") != kApplication)
    throw IoError(database.path().string(), "is an SQLite file, but no history of mapproof's");
  if (version > schema_version())
    throw IoError(database.path().string(),
                  fmt::format("is of version {}; this program knows versions up to {}", version,
                              schema_version()));
  return version;
}

std::string damage_of_tables(Database& database) {
  const int version = version_of(database);
  if (version == 0) return "it holds nothing";
  Database whole(":memory:", Database::Access::kCreate);
  make_tables(whole, version);
  const std::set<std::string> wanted = columns_of(whole);
  const std::set<std::string> there = columns_of(database);
  std::set<std::string> missing;
  std::ranges::set_difference(wanted, there, std::inserter(missing, missing.end()));
  return missing.empty() ? "" : "it has no " + *missing.begin();
}

void make_tables(Database& database, int version) {
  if (version < 1 || version > schema_version())
    throw InvalidInput("make_tables: there is no such version");
  make_tables_from(database, version_of(database), version);
}

fs::path migrate(Database& database) {
  const int version = version_of(database);
  if (version == schema_version()) return {};
  fs::path backup;
  if (version > 0) {
    backup = free_name(fmt::format("{}.v{}-backup", database.path().string(), version));
    copy_to(database, backup);
  }
  make_tables_from(database, version, schema_version());
  return backup;
}

}  // namespace mapproof
