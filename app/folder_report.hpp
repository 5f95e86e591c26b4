#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "render/plot/figure.hpp"
#include "render/theme/theme.hpp"
#include "reports/html/templates.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// The report of a folder of records and the figures in it, as values.
struct FolderReport {
  std::filesystem::path folder;
  Report report;
  std::vector<Section> in_company;  ///< Its sections as they stand beside those of other studies.
  std::vector<Figure> figures;      ///< In the order of the report.
  std::size_t runs = 0;
  std::vector<std::string> missing;  ///< Data asked for that are not there.
};

/// Reads the records of a folder and makes report and figures of them; no solver runs. The folder
/// holds a study of either kind, or studies in folders below it (see study_folders()).
/// @param command  The one that makes it again; empty: that of the session which made the records,
///                 or `fallback`.
/// @throws IoError.
FolderReport read_folder_report(const std::filesystem::path& folder,
                                const std::optional<std::string>& command,
                                const std::string& fallback);

/// The studies right below a folder that holds none itself, in the order of the experiments that
/// `reproduce` knows. @throws IoError if it cannot be listed.
std::vector<std::filesystem::path> study_folders(const std::filesystem::path& folder);

/// Reports of several studies in one, with what is missing at its head.
/// @throws InvalidInput if an id stands in two of them.
FolderReport joined(const std::filesystem::path& folder, std::vector<FolderReport> parts);

/// Draws the figures into `folder`, several at a time; no two may have one id.
/// @return The text of each SVG file by its figure's id. @throws IoError.
std::map<std::string, std::string> write_figures(const std::vector<const Figure*>& figures,
                                                 const Theme& theme,
                                                 const std::filesystem::path& folder, int jobs);

/// Writes figures/, tables/ and report.html into the report's folder.
/// @return The path of the report.
std::filesystem::path write_report(const FolderReport& report, const Templates& page, int jobs);

}  // namespace mapproof
