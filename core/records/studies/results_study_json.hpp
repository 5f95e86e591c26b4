#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/given_path.hpp"
#include "core/model/map_record.hpp"
#include "core/model/paths/space_path.hpp"
#include "core/records/studies/quantity_fields.hpp"
#include "core/records/text_forms.hpp"
#include "core/records/value_fields.hpp"
#include "core/results/results_study.hpp"

namespace mapproof {

/// The schema of a study.json that goes with a results.csv and nothing else.
inline constexpr std::string_view kResultsStudy = "mapproof.results_study";

/// The name of a study of that schema that has none.
inline constexpr std::string_view kNamelessResults = "results";

/// Reads a study.json of that schema (docs/file-formats.md); the rows and the labels of what it
/// does not name are missing.
/// @throws IoError with the location.
ResultsStudy parse_results_study(std::string_view text, const std::string& source);

/// Reads study.json and results.csv of the folder.
/// @throws IoError with the location: also if the table has no row, or if study.json names a setup,
/// a
///         method or a factor that no row has.
ResultsStudy read_results_study(const std::filesystem::path& folder);

/// The maps in maps/NAME.csv, by name as ids. @throws IoError with the location.
std::vector<MapRecord> read_given_maps(const std::filesystem::path& folder);

/// The paths in paths/NAME.tum, by name, with the ground truth in paths/NAME.groundtruth.tum and
/// the alignment to it that study.json asks for; as they were given.
/// @throws IoError with the location; also for a ground truth of no path.
std::vector<GivenPath> read_given_paths(const std::filesystem::path& folder);

/// The errors of poses in errors/RUN/METHOD.csv, by run, then by method. @throws IoError with the
/// location.
std::vector<PathErrors> read_path_errors(const std::filesystem::path& folder);

/// The text of study.json of a study without paths: its name, title, question, command, labels and
/// quantities.
std::string results_study_json(const ResultsStudy& study);

/// Every file of a study of results, below the folder: study.json, results.csv, maps, paths and
/// errors.
std::vector<std::filesystem::path> results_study_files(const std::filesystem::path& folder);

/// What is in maps/, paths/ and errors/ and is not read, a sentence each that begins with the file
/// as seen from the folder: all but maps/NAME.csv, paths/NAME.tum, errors/RUN/METHOD.csv and hidden
/// files.
std::vector<std::string> passed_over_files(const std::filesystem::path& folder);

/// Whether the folder's study.json is of that schema, be the rest readable or not.
bool is_results_study(const std::filesystem::path& folder);

// The fields of the study.json of a results.csv (core/json/fields.hpp).

/// How paths are aligned to their ground truths.
enum class PathAlignment { kNone, kRigid, kSimilarity };

inline Alignment alignment_of(PathAlignment alignment) {
  constexpr std::array kAlignments = {Alignment::kNone, Alignment::kRigid, Alignment::kSimilarity};
  return kAlignments[static_cast<std::size_t>(alignment)];
}

inline std::string_view name(PathAlignment alignment) { return name(alignment_of(alignment)); }

inline EnumNames enum_names(PathAlignment) {
  return names_up_to(PathAlignment::kSimilarity, "path_alignment");
}

namespace record_rules {

inline constexpr FieldRule kLabels = {
    .description = "In the order of tables; ids that are left out follow, under their ids.",
    .max_items = 10'000,
    .key = Key::kOptional};

}  // namespace record_rules

template <typename Visitor>
void fields(Visitor& v, Label& label) {
  v.field("id", label.id, {.max_bytes = 1000});
  v.field("label", label.label, {.not_empty = true, .max_bytes = 1000});
}

struct FactorLabel : Label {};

template <typename Visitor>
void fields(Visitor& v, FactorLabel& factor) {
  v.about("The id is NAME of the column at.NAME.");
  fields(v, static_cast<Label&>(factor));
  v.field("unit", factor.unit, {.max_bytes = 100, .key = Key::kOptional});
}

/// study.json.
struct ResultsHead {
  ResultsStudy study;
  PathAlignment alignment = PathAlignment::kNone;
};

template <typename Visitor>
void fields(Visitor& v, ResultsHead& head) {
  using namespace record_rules;
  ResultsStudy& study = head.study;
  if constexpr (Visitor::kReads) {
    study.name = kNamelessResults;
    study.results.are_repeats = true;
  }
  v.file("mapproof.results_study",
         "study.json of a results.csv that any program wrote: a title and what the ids in the "
         "table stand for.");
  v.field(
      "name", study.name,
      {.description = "Ids of figures and tables begin with it; \"results\" where it is left out.",
       .max_bytes = 100,
       .form = &kPlainId,
       .key = Key::kOptional});
  v.field("title", study.title, {.not_empty = true, .max_bytes = 1000});
  v.field("question", study.question,
          {.description = "What was asked and how it was tried.", .key = Key::kOptional});
  v.field("compared_with", study.compared_with,
          {.description = "What the results are judged against, within a sentence; each other "
                          "where it is left out.",
           .key = Key::kOptional});
  v.field("command", study.command,
          {.description = "The command that made the results.", .key = Key::kOptional});
  std::vector<Quantity> quantities;
  if constexpr (!Visitor::kReads)
    for (const std::string& id : study.quantities)
      quantities.push_back(study.results.quantities.at(id));
  v.field("quantities", quantities,
          {.description = "In the order of tables. A quantity of the dictionary may be left out, "
                          "or named by its id alone.",
           .max_items = kLabels.max_items,
           .key = Key::kOptional});
  check_ids(v, "quantities", quantities);
  v.field("setups", study.setups, kLabels);
  v.field("methods", study.methods, kLabels);
  std::vector<FactorLabel> factors;
  if constexpr (!Visitor::kReads)
    for (const Label& factor : study.factors) factors.push_back({factor});
  v.field("factors", factors, kLabels);
  check_ids(v, "setups", study.setups);
  check_ids(v, "methods", study.methods);
  check_ids(v, "factors", factors);
  v.field("runs_are_repeats", study.results.are_repeats,
          {.description = "Whether runs differ by chance alone, so that means over them and tests "
                          "make sense; true where it is left out.",
           .key = Key::kOptional});
  const auto visit = [&](auto& paths) { paths.field("align", head.alignment); };
  v.group("paths", visit,
          {.description = "How each path in paths/ is aligned to its ground truth before it is "
                          "drawn; not at all where this is left out.",
           .key = Key::kOptional});
  if constexpr (Visitor::kReads) {
    for (const Quantity& quantity : quantities) {
      study.quantities.push_back(quantity.id);
      study.results.quantities.declare(quantity);
    }
    study.factors.assign(factors.begin(), factors.end());
  }
}

}  // namespace mapproof
