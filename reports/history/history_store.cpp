#include "reports/history/history_store.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/files/paths.hpp"
#include "core/base/not_finite.hpp"
#include "reports/history/store/database.hpp"
#include "reports/history/store/schema.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNightlyColumns =
    "number, started_utc, ended_utc, command, provenance, host, processor, cores, jobs, reference, "
    "pinned, verdict, utc_offset_s, commit_id, repository, build";
constexpr int kColumnsOfFacts = 16;
constexpr const char* kFindingColumns =
    "nightly_run, study, kind, subject, quantity, since, sentence, change";

NightlyFacts read_facts(const Statement& row, const fs::path& path) {
  NightlyFacts facts{.number = static_cast<int>(row.integer(0)),
                     .started_utc = row.text(1),
                     .ended_utc = row.text(2),
                     .command = row.text(3),
                     .provenance = row.text(4),
                     .host = row.text(5),
                     .processor = row.text(6),
                     .cores = static_cast<int>(row.integer(7)),
                     .jobs = static_cast<int>(row.integer(8))};
  if (!row.is_null(9)) facts.reference = static_cast<int>(row.integer(9));
  facts.pinned = row.integer(10) != 0;
  const auto verdict = nightly_verdict_named(row.text(11));
  if (!verdict)
    throw DamagedFile(path.string(), fmt::format("nightly run {} has the unknown verdict \"{}\"",
                                                 facts.number, printable(row.text(11))));
  facts.verdict = *verdict;
  facts.utc_offset_s = static_cast<int>(row.integer(12));
  facts.commit = row.text(13);
  facts.repository = row.text(14);
  facts.build = row.text(15);
  return facts;
}

/// A row of kFindingColumns.
NightlyFinding read_finding(const Statement& row, const fs::path& path) {
  const auto rule = rule_named(row.text(2));
  if (!rule)
    throw DamagedFile(path.string(), fmt::format("nightly run {} has the unknown finding \"{}\"",
                                                 row.integer(0), printable(row.text(2))));
  NightlyFinding finding{.study = row.text(1),
                         .rule = *rule,
                         .subject = row.text(3),
                         .quantity = row.text(4),
                         .since = static_cast<int>(row.integer(5)),
                         .sentence = row.text(6)};
  if (!row.is_null(7)) finding.change = row.real(7);
  return finding;
}

/// What a study declared of its quantities.
Quantities read_quantities(Database& database, std::int64_t study) {
  Statement rows(database, "SELECT id, label, unit, better FROM quantities WHERE study = ?");
  rows.bind(study);
  Quantities quantities;
  while (rows.step())
    quantities.declare(study_quantity(rows.text(0), rows.text(1), rows.text(2),
                                      better_named(rows.text(3)).value_or(Better::kNeither)));
  return quantities;
}

/// What a study called its setups, methods and factors.
StudyLabels read_labels(Database& database, std::int64_t study) {
  StudyLabels labels;
  Statement rows(database,
                 "SELECT kind, id, label FROM labels WHERE study = ? ORDER BY position, id");
  rows.bind(study);
  while (rows.step()) {
    const std::string kind = rows.text(0), id = rows.text(1);
    if (kind == "method") labels.add_method(id, rows.text(2));
    if (kind == "setup") labels.setups[id] = rows.text(2);
    if (kind == "factor") labels.factors[id].label = rows.text(2);
    if (kind == "unit") labels.factors[id].unit = rows.text(2);
  }
  return labels;
}

/// A trend has no infinite points: an infinite value is missing there, and stays among the scores.
double finite_or_nan(double value) { return std::isfinite(value) ? value : kNaN; }

template <typename Row>
std::int64_t id_of(Database& database, Statement& find, Statement& insert, const Row& bind) {
  bind(find);
  if (find.step()) {
    const std::int64_t id = find.integer(0);
    while (find.step()) {
    }
    return id;
  }
  bind(insert);
  insert.run();
  return database.last_row();
}

/// Refuses a folder whose history is gone: its nightly runs would be compared with nothing. A
/// damaged one that was renamed is left for a new one on purpose.
void refuse_lost_history(const fs::path& path) {
  std::error_code error;
  const std::string kept = path.filename().string() + ".damaged-";
  for (fs::directory_iterator entry(path.parent_path(), error), end; !error && entry != end;
       entry.increment(error))
    if (entry->path().filename().string().starts_with(kept)) return;
  for (fs::directory_iterator entry(path.parent_path() / "nightly_runs", error), end;
       !error && entry != end; entry.increment(error))
    if (std::error_code unknown; fs::exists(entry->path() / "nightly_run.json", unknown))
      throw IoError(path.string(),
                    "is gone, and nightly_runs/ has nightly runs that it recorded; put a copy of "
                    "it back, or move nightly_runs/ away, and a new history begins");
}

/// Makes a history without nightly runs. It is renamed into place when it is whole: a file without
/// tables is damage.
void begin_history(const fs::path& path) {
  const fs::path journal = path.string() + "-journal";
  std::error_code error;
  refuse_lost_history(path);
  if (fs::exists(fs::symlink_status(journal, error)))
    throw IoError(journal.string(), "belongs to a history that is gone; move it where that is");
  const fs::path beside = path.string() + ".part";
  fs::remove(beside, error);
  {
    Database database(beside, Database::Access::kCreate);
    make_tables(database, schema_version());
  }
  fs::rename(beside, path, error);
  if (error) throw IoError(path.string(), "cannot be put in place: " + error.message());
  sync_folder(path.parent_path());
}

std::unique_ptr<Database> open_to_append(const fs::path& path) {
  try {
    return open_whole(path, Database::Access::kWrite);
  } catch (const DamagedFile& error) {
    throw IoError(path.string(), fmt::format("is damaged: {}; put a copy of it back, or rename it "
                                             "to {}.damaged-1, and a new history begins",
                                             error.damage(), path.filename().string()));
  }
}

}  // namespace

fs::path history_file(const fs::path& store) { return store / "history.sqlite"; }

HistoryStore HistoryStore::open(const fs::path& store) {
  const fs::path path = history_file(store);
  std::error_code error;
  // A link to nowhere is there: its history may be on a disk that is not.
  if (fs::symlink_status(path, error).type() == fs::file_type::not_found) begin_history(path);
  HistoryStore opened(open_to_append(path));
  Database& database = *opened.database_;
  const int version = version_of(database);
  const fs::path backup = migrate(database);
  if (!backup.empty())
    opened.remarks_.push_back(
        fmt::format("{}: was of version {}; it is now of version {}, and kept as it "
                    "was in {}",
                    path.string(), version, schema_version(), backup.filename().string()));
  return opened;
}

HistoryStore HistoryStore::open_existing(const fs::path& store) {
  const fs::path path = history_file(store);
  if (!is_there(path))
    throw IoError(store.string(), "holds no history.sqlite; mapproof nightly makes one");
  std::unique_ptr<Database> database = open_whole(path, Database::Access::kRead);
  const int version = version_of(*database);
  if (version != schema_version())
    throw IoError(path.string(), fmt::format("is of version {}; the next mapproof nightly brings "
                                             "it to version {}",
                                             version, schema_version()));
  return HistoryStore(std::move(database));
}

std::vector<NightlyFacts> HistoryStore::nightly_runs() {
  Statement rows(*database_,
                 fmt::format("SELECT {} FROM nightly_runs ORDER BY number", kNightlyColumns));
  std::vector<NightlyFacts> nightly_runs;
  while (rows.step()) nightly_runs.push_back(read_facts(rows, database_->path()));
  return nightly_runs;
}

std::vector<NightlyFinding> HistoryStore::findings(int nightly_run) {
  Statement rows(
      *database_,
      fmt::format("SELECT {} FROM findings WHERE nightly_run = ? ORDER BY id", kFindingColumns));
  rows.bind(nightly_run);
  std::vector<NightlyFinding> findings;
  while (rows.step()) findings.push_back(read_finding(rows, database_->path()));
  return findings;
}

std::map<int, std::vector<NightlyFinding>> HistoryStore::all_findings() {
  Statement rows(*database_,
                 fmt::format("SELECT {} FROM findings ORDER BY nightly_run, id", kFindingColumns));
  std::map<int, std::vector<NightlyFinding>> findings;
  while (rows.step())
    findings[static_cast<int>(rows.integer(0))].push_back(read_finding(rows, database_->path()));
  return findings;
}

std::map<int, std::vector<std::string>> HistoryStore::study_names() {
  Statement rows(*database_, "SELECT nightly_run, name FROM studies ORDER BY nightly_run, id");
  std::map<int, std::vector<std::string>> names;
  while (rows.step()) names[static_cast<int>(rows.integer(0))].push_back(rows.text(1));
  return names;
}

std::vector<NightlyStudy> HistoryStore::studies(int nightly_run) {
  Statement rows(
      *database_,
      "SELECT id, name, kind, experiment_digest, runs, seconds, peak_memory_mib FROM studies "
      "WHERE nightly_run = ? ORDER BY id");
  rows.bind(nightly_run);
  std::vector<NightlyStudy> studies;
  while (rows.step()) {
    NightlyStudy study{.name = rows.text(1),
                       .kind = rows.text(2),
                       .experiment_digest = rows.text(3),
                       .runs = static_cast<int>(rows.integer(4))};
    if (!rows.is_null(5)) study.seconds = rows.real(5);
    if (!rows.is_null(6)) study.peak_memory_mib = rows.real(6);
    Statement files(*database_,
                    "SELECT file, digest, bytes FROM figures WHERE study = ? ORDER BY file");
    files.bind(rows.integer(0));
    study.quantities = read_quantities(*database_, rows.integer(0));
    study.labels = read_labels(*database_, rows.integer(0));
    while (files.step()) study.figures.push_back({files.text(0), files.text(1), files.integer(2)});
    studies.push_back(std::move(study));
  }
  return studies;
}

Scores HistoryStore::scores(int nightly_run, const std::string& study) {
  Statement series(
      *database_,
      "SELECT t.id, v.series, COUNT(*), s.sensor, s.method, s.step, s.quantity "
      "FROM studies t JOIN scores v ON v.study = t.id JOIN series s ON s.id = v.series "
      "WHERE t.nightly_run = ? AND t.name = ? GROUP BY t.id, v.series");
  series.bind(nightly_run).bind(study);
  Scores scores;
  while (series.step()) {
    std::vector<RunValue>& values = scores[{series.text(3), series.text(4),
                                            static_cast<int>(series.integer(5)), series.text(6)}];
    values.reserve(static_cast<std::size_t>(series.integer(2)));
    Statement rows(*database_,
                   "SELECT r.name, r.unit, v.value FROM scores v JOIN runs r ON r.id = v.run "
                   "WHERE v.study = ? AND v.series = ?");
    rows.bind(series.integer(0)).bind(series.integer(1));
    while (rows.step()) values.push_back({rows.text(0), rows.text(1), rows.real(2)});
    if (!std::ranges::is_sorted(values, {}, &RunValue::run))
      std::ranges::sort(values, {}, &RunValue::run);
  }
  return scores;
}

StudyTrend HistoryStore::trend(const std::string& study, const std::string& experiment_digest,
                               int most, int until) {
  StudyTrend trend{.name = study};
  std::map<std::int64_t, std::size_t> place;  // Of a row of studies.
  Statement rows(
      *database_,
      fmt::format("SELECT {}, s.id, s.peak_memory_mib FROM nightly_runs n JOIN studies s ON "
                  "s.nightly_run = n.number WHERE s.name = ? AND s.experiment_digest = ? AND "
                  "n.number <= ? ORDER BY n.number DESC LIMIT ?",
                  kNightlyColumns));
  rows.bind(study).bind(experiment_digest).bind(until).bind(most);
  std::vector<std::int64_t> ids;
  while (rows.step()) {
    trend.nightly_runs.push_back(read_facts(rows, database_->path()));
    ids.push_back(rows.integer(kColumnsOfFacts));
    trend.peak_memory_mib.push_back(rows.real(kColumnsOfFacts + 1));
  }
  std::ranges::reverse(trend.nightly_runs);
  std::ranges::reverse(ids);
  std::ranges::reverse(trend.peak_memory_mib);
  if (!ids.empty()) trend.quantities = read_quantities(*database_, ids.back());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    trend.labels.add(read_labels(*database_, ids[i]));
    Statement medians(
        *database_,
        "SELECT s.sensor, s.method, s.step, s.quantity, t.median, t.level FROM trends t "
        "JOIN series s ON s.id = t.series WHERE t.study = ?");
    medians.bind(ids[i]);
    while (medians.step()) {
      const SeriesId series{medians.text(0), medians.text(1), static_cast<int>(medians.integer(2)),
                            medians.text(3)};
      const auto put = [&](auto& all, double value) {
        auto& values = all[series];
        values.resize(ids.size(), kNaN);
        values[i] = value;
      };
      put(trend.medians, medians.real(4));
      put(trend.levels, medians.real(5));
    }
  }
  return trend;
}

void HistoryStore::append(const NightlyRun& nightly_run) {
  const NightlyFacts& facts = nightly_run.facts;
  if (facts.number <= last_number())
    throw InvalidInput(
        fmt::format("nightly run {} is not after nightly run {}", facts.number, last_number()));
  Transaction transaction(*database_);
  Statement insert(*database_, fmt::format("INSERT INTO nightly_runs ({}) VALUES "
                                           "(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
                                           kNightlyColumns));
  insert.bind(facts.number).bind(facts.started_utc).bind(facts.ended_utc).bind(facts.command);
  insert.bind(facts.provenance).bind(facts.host).bind(facts.processor);
  insert.bind(facts.cores).bind(facts.jobs);
  if (facts.reference)
    insert.bind(*facts.reference);
  else
    insert.bind_null();
  insert.bind(0).bind(name(facts.verdict)).bind(facts.utc_offset_s);
  insert.bind(facts.commit).bind(facts.repository).bind(facts.build).run();
  for (const NightlyStudy& study : nightly_run.studies) append_study(facts.number, study);
  Statement found(
      *database_,
      "INSERT INTO findings (nightly_run, study, kind, subject, quantity, since, sentence, change) "
      "VALUES (?, ?, ?, ?, ?, ?, ?, ?)");
  for (const NightlyFinding& finding : nightly_run.findings)
    found.bind(facts.number)
        .bind(finding.study)
        .bind(name(finding.rule))
        .bind(finding.subject)
        .bind(finding.quantity)
        .bind(finding.since)
        .bind(finding.sentence)
        .bind(finding.change.value_or(kNaN))
        .run();
  transaction.commit();
}

void HistoryStore::append_study(int nightly_run, const NightlyStudy& study) {
  Statement insert(
      *database_,
      "INSERT INTO studies (nightly_run, name, kind, experiment_digest, runs, seconds, "
      "peak_memory_mib) VALUES (?, ?, ?, ?, ?, ?, ?)");
  insert.bind(nightly_run)
      .bind(study.name)
      .bind(study.kind)
      .bind(study.experiment_digest)
      .bind(study.runs);
  insert.bind(study.seconds.value_or(kNaN)).bind(study.peak_memory_mib.value_or(kNaN)).run();
  const std::int64_t id = database_->last_row();
  Statement declare(
      *database_, "INSERT INTO quantities (study, id, label, unit, better) VALUES (?, ?, ?, ?, ?)");
  for (const Quantity& quantity : study.quantities.declared())
    declare.bind(id)
        .bind(quantity.id)
        .bind(quantity.label)
        .bind(quantity.unit)
        .bind(name(quantity.better))
        .run();
  Statement call(*database_,
                 "INSERT INTO labels (study, kind, id, label, position) VALUES (?, ?, ?, ?, ?)");
  for (const auto& [setup, label] : study.labels.setups)
    call.bind(id).bind("setup").bind(setup).bind(label).bind(0).run();
  for (const auto& [factor, of] : study.labels.factors) {
    call.bind(id).bind("factor").bind(factor).bind(of.label).bind(0).run();
    call.bind(id).bind("unit").bind(factor).bind(of.unit).bind(0).run();
  }
  int position = 0;
  for (const std::string& method : study.labels.ordered())
    call.bind(id)
        .bind("method")
        .bind(method)
        .bind(study.labels.methods.at(method))
        .bind(position++)
        .run();

  Statement find_series(*database_,
                        "SELECT id FROM series WHERE sensor = ? AND method = ? AND step = ? AND "
                        "quantity = ?");
  Statement add_series(*database_,
                       "INSERT INTO series (sensor, method, step, quantity) VALUES (?, ?, ?, ?)");
  Statement find_run(*database_, "SELECT id FROM runs WHERE name = ?1 AND ?2 = ?2");
  Statement add_run(*database_, "INSERT INTO runs (name, unit) VALUES (?, ?)");
  Statement score(*database_, "INSERT INTO scores (study, series, run, value) VALUES (?, ?, ?, ?)");
  Statement median(
      *database_, "INSERT INTO trends (study, series, runs, median, level) VALUES (?, ?, ?, ?, ?)");
  std::unordered_map<Name, std::int64_t> run_ids;
  for (const auto& [key, values] : study.scores) {
    const std::int64_t series =
        id_of(*database_, find_series, add_series, [&key = key](Statement& statement) {
          statement.bind(key.sensor).bind(key.method).bind(key.step).bind(key.quantity);
        });
    for (const RunValue& value : values) {
      auto [run, is_new] = run_ids.try_emplace(value.run, 0);
      if (is_new)
        run->second = id_of(*database_, find_run, add_run, [&value](Statement& statement) {
          statement.bind(value.run.get()).bind(value.unit.get());
        });
      score.bind(id).bind(series).bind(run->second).bind(value.value).run();
    }
    median.bind(id).bind(series).bind(static_cast<int>(values.size()));
    median.bind(finite_or_nan(known_median(values)));
    median.bind(finite_or_nan(level_of(study.quantities.at(key.quantity), values))).run();
  }
  Statement figure(*database_,
                   "INSERT INTO figures (study, file, digest, bytes) VALUES (?, ?, ?, ?)");
  for (const FigureFile& file : study.figures)
    figure.bind(id).bind(file.file).bind(file.digest).bind(file.bytes).run();
}

std::vector<NightlyNote> HistoryStore::notes() {
  Statement rows(
      *database_,
      "SELECT nightly_run, finding, kind, study, subject, quantity, since, change, text, "
      "written_utc FROM notes ORDER BY id");
  std::vector<NightlyNote> notes;
  while (rows.step()) {
    const auto kind = note_kind_named(rows.text(2));
    if (!kind)
      throw DamagedFile(
          database_->path().string(),
          fmt::format("there is no note of the kind \"{}\"", printable(rows.text(2))));
    notes.push_back({.nightly_run = static_cast<int>(rows.integer(0)),
                     .finding = static_cast<int>(rows.integer(1)),
                     .kind = *kind,
                     .study = rows.text(3),
                     .subject = rows.text(4),
                     .quantity = rows.text(5),
                     .since = static_cast<int>(rows.integer(6)),
                     .text = rows.text(8),
                     .written_utc = rows.text(9)});
    if (!rows.is_null(7)) notes.back().change = rows.real(7);
  }
  return notes;
}

void HistoryStore::add_note(const NightlyNote& note) {
  Statement(*database_, "DELETE FROM notes WHERE nightly_run = ? AND finding = ? AND kind = ?")
      .bind(note.nightly_run)
      .bind(note.finding)
      .bind(name(note.kind))
      .run();
  if (note.text.empty()) return;
  Statement(*database_,
            "INSERT INTO notes (nightly_run, finding, kind, study, subject, quantity, since, "
            "change, text, written_utc) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)")
      .bind(note.nightly_run)
      .bind(note.finding)
      .bind(name(note.kind))
      .bind(note.study)
      .bind(note.subject)
      .bind(note.quantity)
      .bind(note.since)
      .bind(note.change.value_or(kNaN))
      .bind(note.text)
      .bind(note.written_utc)
      .run();
}

void HistoryStore::add_notes(const std::vector<NightlyNote>& notes) {
  Transaction transaction(*database_);
  for (NightlyNote note : notes) {
    Statement find(*database_, "SELECT 1 FROM nightly_runs WHERE number = ?");
    if (!find.bind(note.nightly_run).step())
      throw InvalidInput(fmt::format("there is no nightly run {}", note.nightly_run));
    if (note.finding > 0) {
      const std::vector<NightlyFinding> found = findings(note.nightly_run);
      if (std::cmp_greater(note.finding, found.size()))
        throw InvalidInput(fmt::format("nightly run {} has no finding {}; it has {}",
                                       note.nightly_run, note.finding, found.size()));
      put_finding(note, found[static_cast<std::size_t>(note.finding - 1)]);
    }
    add_note(note);
    if (note.kind == NoteKind::kAccepted && !note.text.empty())
      Statement(*database_, "UPDATE nightly_runs SET pinned = (number = ?)")
          .bind(note.nightly_run)
          .run();
  }
  transaction.commit();
}

std::string HistoryStore::identifier() {
  Statement row(*database_, "SELECT value FROM facts WHERE name = 'identifier'");
  return row.step() ? row.text(0) : "";
}

void HistoryStore::pin(int nightly_run) {
  Transaction transaction(*database_);
  Statement find(*database_, "SELECT 1 FROM nightly_runs WHERE number = ?");
  if (!find.bind(nightly_run).step())
    throw InvalidInput(fmt::format("there is no nightly run {}", nightly_run));
  find.run();
  Statement(*database_, "UPDATE nightly_runs SET pinned = (number = ?)").bind(nightly_run).run();
  transaction.commit();
}

void HistoryStore::remove(const std::vector<int>& nightly_runs) {
  Transaction transaction(*database_);
  Statement gone(*database_, "DELETE FROM nightly_runs WHERE number = ?");
  for (const int nightly_run : nightly_runs) gone.bind(nightly_run).run();
  database_->execute(
      "DELETE FROM series WHERE id NOT IN (SELECT series FROM trends);"
      "DELETE FROM runs WHERE id NOT IN (SELECT run FROM scores);");
  transaction.commit();
}

void HistoryStore::compact() { database_->execute("VACUUM"); }

std::vector<std::string> HistoryStore::digests() {
  Statement rows(*database_, "SELECT DISTINCT digest FROM figures ORDER BY digest");
  std::vector<std::string> digests;
  while (rows.step()) digests.push_back(rows.text(0));
  return digests;
}

int HistoryStore::last_number() {
  Statement row(*database_,
                "SELECT max(coalesce((SELECT max(number) FROM nightly_runs), 0), "
                "coalesce((SELECT seq FROM sqlite_sequence WHERE name = 'nightly_runs'), 0))");
  return row.step() ? static_cast<int>(row.integer(0)) : 0;
}

}  // namespace mapproof
