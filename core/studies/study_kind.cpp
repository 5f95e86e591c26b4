#include "core/studies/study_kind.hpp"

#include <algorithm>
#include <array>
#include <system_error>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/json/json_cursor.hpp"
#include "core/json/json_document.hpp"
#include "core/json/text_input.hpp"
#include "core/records/studies/results_table.hpp"
#include "core/records/studies/study_folder.hpp"

namespace mapproof {

namespace fs = std::filesystem;

std::span<const StudyKind* const> all_study_kinds() {
  static const std::array kKinds = {&kMappingStudies, &kRangeStudies, &kTopicStudies,
                                    &kTableStudies};
  return kKinds;
}

const StudyKind& kind_of_experiment(std::string_view text, const std::string& source) {
  const JsonDocument document = parse_json(text, source);
  const std::string schema = schema_of(document.cursor()).name;
  for (const StudyKind* kind : all_study_kinds())
    if (!kind->experiment.empty() && kind->experiment == schema) return *kind;
  throw IoError(source, "/schema/name", "is not an experiment: " + in_quotes(schema));
}

const StudyKind* kind_of_study(const fs::path& folder) {
  require_study(folder);
  const std::string schema = study_schema(folder);
  const auto kinds = all_study_kinds();
  const auto found = std::ranges::find(kinds, schema, &StudyKind::study);
  return found == kinds.end() ? nullptr : *found;
}

std::vector<fs::path> files_of_run(const fs::path& folder, const std::string& run) {
  std::vector<fs::path> all, of_run;
  const StudyKind* kind = kind_of_study(folder);
  if (kind == nullptr) return all;
  const auto add = [&](const fs::path& path) {
    all.push_back(path.lexically_relative(folder));
    if (path.stem() == run || path.parent_path().filename() == run) of_run.push_back(all.back());
  };
  for (const fs::path& record : kind->records) {
    std::error_code error;
    if (fs::is_regular_file(folder / record, error)) add(folder / record);
    for (fs::recursive_directory_iterator entry(folder / record, error), end;
         !error && entry != end; entry.increment(error))
      if (entry->is_regular_file()) add(entry->path());
  }
  // The one table of other programs holds every run.
  if (!of_run.empty() && kind->experiment.empty()) of_run.emplace_back(kResultsFile);
  std::vector<fs::path>& found = of_run.empty() ? all : of_run;
  std::ranges::sort(found);
  return found;
}

namespace {

/// The rows of a study's results.csv; of what its records hold besides, nothing is known.
void add_table(const fs::path& folder, StudyContents& contents) {
  Results& results = contents.results;
  results.rows = read_results_csv(folder / kResultsFile, results.quantities);
  for (const Result& row : results.rows)
    if (!row.run.empty()) contents.runs.set(row.run, row.group);
}

}  // namespace

StudyContents read_study_contents(const fs::path& folder, const ContentsAsked& asked) {
  const std::string source = (folder / kStudyFile).string();
  const std::string text = read_file(source);
  StudyContents contents;
  contents.kind = schema_of(parse_json(text, source).cursor()).name;
  const auto kinds = all_study_kinds();
  const auto kind = std::ranges::find(kinds, contents.kind, &StudyKind::study);
  if (kind == kinds.end())
    throw IoError(source, "/schema/name", "is not a study: \"" + printable(contents.kind) + "\"");
  (*kind)->read(folder, text, asked, contents);
  std::error_code error;
  if (contents.results.rows.empty() && contents.problems.empty() &&
      fs::exists(folder / kResultsFile, error))
    try_file(contents, folder, folder / kResultsFile, asked, [&] { add_table(folder, contents); });
  return contents;
}

std::string results_table_of(const fs::path& folder) {
  return results_csv(read_study_contents(folder, {}).results.rows);
}

void write_results_table(const fs::path& folder) {
  OutputFolder(folder).write_durably(kResultsFile, results_table_of(folder));
}

}  // namespace mapproof
