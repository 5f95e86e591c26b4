#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "render/figures/curves/log_log.hpp"
#include "render/figures/maps/path_styles.hpp"
#include "render/figures/words.hpp"
#include "reports/sections/opening.hpp"
#include "reports/sections/slam/slam_report.hpp"
#include "reports/sections/slam/slam_words.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostRuns = 2;  ///< Told before anything else.
constexpr std::size_t kMostThumbnails = 6;

/// "Plaza 1: 0.19 m refined, 0.36 m spectral (rigid), 16 m dead reckoning (unaligned). "; an
/// alignment is told once for methods in a row that share it. Empty if no method has an error.
std::vector<Phrase> errors_of(const SlamRun& run) {
  std::vector<Phrase> phrases;
  const TrajectoryError* before = nullptr;
  for (const auto& [method, called] :
       {std::pair{SlamMethod::kRefined, "refined"}, std::pair{SlamMethod::kSpectral, "spectral"},
        std::pair{SlamMethod::kDeadReckoning, "dead reckoning"}}) {
    const TrajectoryError* error = error_of(run, method);
    if (error == nullptr || !std::isfinite(error->mean_m)) continue;
    std::string text;
    if (before != nullptr && before->alignment != error->alignment)
      text = fmt::format(" ({})", alignment_words(before->alignment));
    if (before != nullptr) text += ", ";
    const std::string metres = significant(error->mean_m, 2) + "\u00a0m";
    phrases.push_back({std::move(text)});
    phrases.push_back(before == nullptr ? strong(metres) : Phrase{metres});
    phrases.push_back({std::string(" ") + called});
    before = error;
  }
  if (before != nullptr)
    phrases.push_back({fmt::format(" ({}). ", alignment_words(before->alignment))});
  return phrases;
}

}  // namespace

Opening slam_opening(const SlamStudy& study, const StudyFigures& figures) {
  Opening opening;
  Paragraph text;
  std::size_t told = 0;
  for (const SlamRun& run : study.runs) {
    std::vector<Phrase> errors = errors_of(run);
    if (run.simulated || errors.empty() || told == kMostRuns) continue;
    if (told++ == 0) text.phrases.push_back({"Mean position error on "});
    text.phrases.push_back(strong(title_of(run)));
    text.phrases.push_back({": "});
    text.phrases.insert(text.phrases.end(), errors.begin(), errors.end());
  }
  const double slope =
      study.convergence.empty() ? NAN : convergence_slope(study.convergence.front());
  if (std::isfinite(slope)) {
    text.phrases.push_back(
        {"In simulation the error of the observation model goes as the readings "
         "to the power "});
    text.phrases.push_back(strong(slope_words(slope)));
    text.phrases.push_back({"; theory: \u22121/2."});
  }
  if (!text.phrases.empty()) opening.findings.push_back(std::move(text));
  std::vector<std::string> ids = {"fig-2b", "fig-2c", "fig-1b", "fig-1a"};
  for (const FigureGroup& group : figures.groups)
    ids.push_back(group.figures.empty() ? group.scenes.front().id : group.figures.front().id);
  opening.figure_ids = present_ids(ids, figures, kMostThumbnails);
  return opening;
}

}  // namespace mapproof
