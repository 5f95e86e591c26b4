#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/given_path.hpp"
#include "core/model/map_record.hpp"
#include "core/results/results_study.hpp"

namespace mapproof {

/// The schema of a study.json that stands beside a results.csv and nothing else.
inline constexpr std::string_view kResultsStudy = "mapproof.results_study";

/// The name of a study of that schema that has none.
inline constexpr std::string_view kNamelessResults = "results";

/// Reads a study.json of that schema (docs/file-formats.md); the rows and the labels of what it
/// does not name are missing.
/// @throws IoError with the place.
ResultsStudy parse_results_study(std::string_view text, const std::string& source);

/// Reads study.json and results.csv of the folder.
/// @throws IoError with the place: also if the table has no row, or if study.json names a setup, a
///         method or a factor that no row has.
ResultsStudy read_results_study(const std::filesystem::path& folder);

/// The maps in maps/NAME.csv, by name as ids. @throws IoError with the place.
std::vector<MapRecord> read_given_maps(const std::filesystem::path& folder);

/// The paths in paths/NAME.tum, by name, with the ground truth in paths/NAME.truth.tum and the
/// alignment to it that study.json asks for; as they were given.
/// @throws IoError with the place; also for a ground truth of no path.
std::vector<GivenPath> read_given_paths(const std::filesystem::path& folder);

/// Every file of a study of results, below the folder: study.json, results.csv, maps and paths.
std::vector<std::filesystem::path> results_study_files(const std::filesystem::path& folder);

/// What is in maps/ and paths/ and is not read, a sentence each that begins with the file as seen
/// from the folder: all but maps/NAME.csv, paths/NAME.tum and hidden files.
std::vector<std::string> passed_over_files(const std::filesystem::path& folder);

/// Whether the folder's study.json is of that schema, be the rest readable or not.
bool is_results_study(const std::filesystem::path& folder);

}  // namespace mapproof
