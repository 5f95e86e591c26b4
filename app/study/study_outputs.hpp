#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "render/plot/figure.hpp"
#include "render/scene/film.hpp"
#include "render/scene/scene.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// Whose question a study asks: that of a paper, one of our topics, or one of a user's own table.
enum class StudyOrigin { kPaper, kTopic, kTable };

/// The report of a folder of records and the figures in it, as values.
struct FolderReport {
  std::filesystem::path folder;
  StudyOrigin origin = StudyOrigin::kPaper;
  bool is_of_studies = false;  ///< The folder has their records, of which `render` draws figures.
  Report report = {};
  std::vector<Section> in_company =
      {};                            ///< Its sections as they stand beside those of other studies.
  std::string group = {};            ///< What heads them in the contents of such a report.
  std::vector<Figure> figures = {};  ///< In the order of the report.
  std::vector<Scene> scenes = {};    ///< Likewise.
  std::vector<Film> films = {};      ///< Of some of the scenes.
  std::size_t runs = 0;
  std::optional<bool> reached_aim = {};   ///< None: nothing is aimed at.
  std::string incomplete = {};            ///< What is still to be run, a sentence; empty: nothing.
  std::vector<std::string> missing = {};  ///< Data asked for that are not there.
  std::map<std::string, std::string> link_words = {};  ///< See HtmlOptions.
};

/// A study in numbers: as a few lines of text, and for --json.
struct StudyNumbers {
  std::string text;
  nlohmann::ordered_json object;
  std::vector<std::string> missing = {};  ///< Data asked for that are not there.
};

/// How a kind of study is shown; its study.json has the schema of a StudyKind.
struct StudyOutputs {
  std::string_view study;
  /// Its report with its figures; no solver runs. `command` makes the study again. @throws IoError.
  FolderReport (*report)(const std::filesystem::path& folder, const std::string& command);
  /// @throws IoError.
  StudyNumbers (*numbers)(const std::filesystem::path& folder);
};

/// A file each; a new one is added to study_outputs.cpp.
extern const StudyOutputs kMappingOutputs, kRangeOutputs, kTopicOutputs, kTableOutputs;

/// Those of the study in a folder. @throws IoError if there is none, or of no kind that is known.
const StudyOutputs& outputs_of_study(const std::filesystem::path& folder);

}  // namespace mapproof
