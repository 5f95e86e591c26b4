#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/console.hpp"
#include "app/disclosure.hpp"
#include "app/study/page_content.hpp"
#include "app/study/study_outputs.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/model/slam/slam_study.hpp"
#include "core/records/studies/folder_lock.hpp"
#include "render/output/file_format.hpp"
#include "render/plot/figure.hpp"
#include "render/scene/film.hpp"
#include "render/scene/scene.hpp"
#include "render/scene_client/scene_client.hpp"
#include "render/theme/theme.hpp"
#include "reports/html/templates.hpp"
#include "reports/model/report.hpp"
#include "reports/sections/study_figures.hpp"

namespace mapproof {

/// Reads the records of a folder and makes report and figures of them; no solver runs. The folder
/// holds a study of any kind, or studies in folders below it (see study_folders()).
/// @param command  The one that makes it again; empty: that of the session which made the records,
///                 or `fallback`.
/// @throws IoError.
FolderReport read_folder_report(const std::filesystem::path& folder,
                                const std::optional<std::string>& command,
                                const std::string& fallback);

/// Reports of several studies in one, with what is missing at its head.
/// @throws InvalidInput if an id stands in two of them.
FolderReport joined_report(const std::filesystem::path& folder, std::vector<FolderReport> parts);

/// The report of a range-only study that is at hand, with its figures.
/// @param command  The one that makes the study again.
FolderReport slam_folder_report(const std::filesystem::path& folder, const SlamStudy& study,
                                const SlamTimings& timings, std::span<const Session> sessions,
                                const std::string& command);

/// Adds all figures, scenes and films of a study.
void add_images(const StudyFigures& figures, FolderReport& report);

/// All of a report's.
Images images_of(const FolderReport& report);

/// What was drawn.
struct Drawn {
  std::map<std::string, std::size_t> figure_bytes;  ///< Of each figure's SVG file, by its id.
  /// The drawings of scenes by their ids; for a dark page, with dark images, which files lack.
  std::map<std::string, std::string> scene_svg;
  std::string renderer;     ///< What drew the scenes; empty if there are none.
  std::string scene_error;  ///< Why scenes are missing; empty if none is.

  /// The size of what a page shows under that id; 0 if it was not drawn.
  std::size_t svg_bytes(const std::string& id) const;

  /// The drawing itself; empty if it was not drawn.
  /// @param figures  The folder that the files went to.
  /// @throws IoError.
  std::string svg(const std::string& id, const std::filesystem::path& figures) const;
};

/// How images are drawn, and where to.
struct DrawingJob {
  OutputFolder folder;
  Theme theme;
  std::optional<Theme> dark = {};  ///< That of a page which shows 3-D figures in the dark.
  int jobs = 1;
  FileFormats formats = usual_formats();
  CountProgress progress = {};  ///< May be called from any thread, one call at a time.
};

/// Draws the images: figures several at a time, scenes one by one beside them.
/// @throws IoError.
Drawn write_images(const Images& images, const DrawingJob& job, SceneClient& client);

/// How a report is written.
struct ReportOutputs {
  const Templates& page;
  int jobs = 1;
  const Disclosure& disclosure;
  CountProgress progress = {};  ///< Called for each image that is drawn.
  /// Called with what the page does not carry, if there is such.
  std::function<void(const std::string&)> note = {};
};

/// Writes figures/, tables/ and report.html, which names what drew the scenes and carries the
/// records of the report's folder (see page_records()), into that folder, and pages/ where one page
/// cannot hold all (see pages_of()).
/// @param of_folder  The lock of that folder.
/// @return The path of the report.
/// @throws IoError.
/// @throws SceneError once all else is written, if a scene could not be drawn.
std::filesystem::path write_report(const FolderReport& report, const ReportOutputs& outputs,
                                   const FolderLock& of_folder);

}  // namespace mapproof
