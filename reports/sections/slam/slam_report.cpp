#include "reports/sections/slam/slam_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "core/model/slam/method_record.hpp"
#include "render/figures/curves/log_log.hpp"
#include "render/figures/curves/refinement_starts.hpp"
#include "render/figures/maps/path_styles.hpp"
#include "render/figures/status_text.hpp"
#include "reports/sections/fit_section.hpp"
#include "reports/sections/fit_text.hpp"
#include "reports/sections/opening.hpp"
#include "reports/sections/provenance.hpp"
#include "reports/sections/slam/slam_figures.hpp"
#include "reports/sections/slam/slam_tables.hpp"
#include "reports/sections/slam/slam_text.hpp"
#include "reports/sections/study_report.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

/// ".58 m for spectral, 4-D (rigid)"; empty if the method has no error.
std::string error_words_of(const SlamRun& run, SlamMethod method) {
  const TrajectoryError* error = error_of(run, method);
  if (error == nullptr || !std::isfinite(error->mean_m)) return "";
  return fmt::format("{} for {} ({})", error_text(error->mean_m), info(method).label,
                     alignment_words(error->alignment));
}

/// The mean errors that a reader wants first.
std::string error_sentence_of(const SlamRun& run) {
  std::vector<std::string> parts;
  for (const SlamMethod method : {SlamMethod::kRefined, SlamMethod::kSpectral,
                                  SlamMethod::kSpectralKnown, SlamMethod::kDeadReckoning})
    if (std::string text = error_words_of(run, method); !text.empty())
      parts.push_back(std::move(text));
  return parts.empty() ? "" : listed(parts, 6);
}

/// The scale error of the ranges, where the refinement determined it.
std::string scale_words(const SlamRun& run) {
  const SlamRecord* refined = record_of(run, SlamMethod::kRefined);
  if (refined == nullptr || refined->estimate.range_scale == 1.0) return "";
  const double percent = 100.0 * (refined->estimate.range_scale - 1.0);
  return fmt::format(
      " Its ranges are {} % too {}, as the refinement estimates from odometry and ranges alone.",
      significant(std::abs(percent), 2), percent > 0.0 ? "long" : "short");
}

std::string start_words(const SlamRun& run) {
  std::vector<std::string> parts;
  for (const auto& [method, where] :
       {std::pair{SlamMethod::kRefined, "the spectral answer"},
        std::pair{SlamMethod::kRefinedFromOdometry, "dead reckoning"},
        std::pair{SlamMethod::kRefinedFromRandom, "random landmarks"}})
    if (const StartCount count = starts_at_optimum(run.starts, method); count.of > 0)
      parts.push_back(fmt::format("{} of {} from {}", count.reached, count.of, where));
  if (parts.empty()) return "";
  return " Starts of the refinement that end within 1 % of the least cost: " + listed(parts, 3) +
         ".";
}

void add_run(const SlamRun& run, BulletList& findings) {
  const std::string errors = error_sentence_of(run);
  std::string text = errors.empty()
                         ? fmt::format(": {} mapped, no error claimed, there being no true path.",
                                       counted(std::ssize(run.log.landmarks), "landmark"))
                         : ": mean position error " + errors + ".";
  findings.items.push_back(
      {{strong(title_of(run)), phrase(text + scale_words(run) + start_words(run))}});
}

/// The errors of landmarks and positions with the most measurements.
std::string end_words(const ConvergenceCurve& curve) {
  const ConvergencePoint& last = curve.points.back();
  if (last.landmarks_m.values == 0) return "";
  std::string text = fmt::format(" After {} the mean error of landmarks is {}",
                                 counted(last.steps, "step"), error_text(last.landmarks_m.mean));
  if (last.positions_m.values > 0)
    text += fmt::format(
        ", single positions of the robot, which have no more measurements than at the start, {}",
        error_text(last.positions_m.mean));
  return text + ".";
}

void add_convergence(const SlamStudy& study, BulletList& findings) {
  if (study.convergence.empty()) return;
  const ConvergenceCurve& curve = study.convergence.front();
  const double slope = convergence_slope(curve);
  if (!std::isfinite(slope)) return;
  const std::string text = slope_words(slope);
  findings.items.push_back(
      {{strong("Convergence"),
        phrase(fmt::format(": the error of the observation model changes as the number of "
                           "measurements to the power {} ({}; {}, without an interval); theory "
                           "predicts \u22121/2.{}{}",
                           text, curve.title, slope_basis(curve), variant_words(study),
                           end_words(curve)))}});
}

void add_remarks_on_paper(BulletList& findings) {
  findings.items.push_back(
      {{strong("The paper\u2019s numbers"),
        phrase(
            ": its text prints no errors; it refers to its technical report for them. So there is "
            "nothing to compare ours with. Fig. 2A is a photograph of the robot: left out.")}});
}

using RunList = std::vector<const SlamRun*>;

RunList runs_of(const SlamStudy& study, bool simulated) {
  RunList runs;
  for (const SlamRun& run : study.runs)
    if (run.simulated == simulated) runs.push_back(&run);
  return runs;
}

/// What the reader of the log did or noticed.
void add_remarks(const SlamRun& run, Section& section) {
  if (run.log.remarks.empty()) return;
  section.blocks.emplace_back(plain("When the log was read:"));
  BulletList remarks;
  for (const std::string& remark : run.log.remarks)
    remarks.items.push_back({{{remark, Emphasis::kData}}});
  section.blocks.emplace_back(std::move(remarks));
}

/// The first figure in full width, the others side by side.
Section section_of(const FigureGroup* figures, std::string id, std::string title) {
  if (figures == nullptr) return {std::move(id), std::move(title), {}};
  Section section{figures->id, figures->title, {plain(figures->words)}};
  section.blocks.emplace_back(figure_block(figures->figures.front()));
  Gallery others = gallery_of(*figures, 1);
  if (!others.figures.empty()) section.blocks.emplace_back(std::move(others));
  return section;
}

/// The path and beside it the drive from above, which readers want to see; then what they rest on.
Section path_section(const FigureGroup* figures, std::string id, std::string title) {
  if (figures == nullptr) return {std::move(id), std::move(title), {}};
  static constexpr std::string_view kDriveScene = "scene-drive-";  // docs/figures.md
  Section section{figures->id, figures->title, {plain(figures->words)}};
  Gallery gallery = gallery_of(*figures);
  const auto others = std::ranges::stable_partition(
      gallery.figures.begin() + 1, gallery.figures.end(),
      [](const FigureBlock& figure) { return figure.id.starts_with(kDriveScene); });
  gallery.open = static_cast<std::size_t>(others.begin() - gallery.figures.begin());
  section.blocks.emplace_back(std::move(gallery));
  return section;
}

/// Eq. 5 and what the paper's text reads off it.
Paragraph bound_words(const ConvergenceCurve& curve) {
  std::vector<double> steps, sines;
  for (const ConvergencePoint& point : curve.points) {
    steps.push_back(point.steps);
    sines.push_back(point.sine.values > 0 ? point.sine.mean : kNaN);
  }
  return plain(fmt::format(
      "Eq. 5 bounds the sine of the largest canonical angle between the learned subspace and the "
      "true one by N c \u221A(2 log T / T) / \u03B3. The text of the paper concludes a sample "
      "complexity of \u00D5(\u03B6\u00B2) for an error \u03B6, which would ask for fewer "
      "measurements the smaller the error: a misprint. Solved for T, the bound gives "
      "\u00D5(1/\u03B6\u00B2). "
      "The measured sine changes as the number of measurements to the power {}.",
      slope_words(log_log_slope(steps, sines))));
}

/// One log of a real robot.
Section slam_run_section(const SlamRun& run, const FigureGroup* figures, bool is_of_paper) {
  Section section = path_section(figures, slam_run_group(run), "Range-only SLAM: " + title_of(run));
  section.interest = Interest::kMost;
  if (run.windows)
    section.blocks.emplace_back(plain(fmt::format(
        "Ranges come one at a time: windows of {:.3g} s bring them to common times. Of the lengths "
        "that "
        "give ranges at the most times it is the one that best predicts ranges held out, without "
        "the ground truth.",
        run.windows->chosen_s)));
  if (auto landmarks = slam_landmark_table(run)) {
    landmarks->secondary = is_of_paper;  // Else it is what was asked for.
    section.blocks.emplace_back(*std::move(landmarks));
  }
  add_remarks(run, section);
  return section;
}

const FigureGroup* group_of(const StudyFigures& figures, const std::string& id) {
  const auto found = std::ranges::find(figures.groups, id, &FigureGroup::id);
  return found == figures.groups.end() ? nullptr : &*found;
}

std::optional<Section> histories_section(const SlamReportInput& input) {
  if (!input.study.histories) return std::nullopt;
  const FigureGroup* figures = group_of(input.figures, kSlamHistories);
  Section section = figures != nullptr
                        ? figures_section(*figures)
                        : Section{kSlamHistories, "Range-only SLAM: mapping without a path", {}};
  section.interest = Interest::kFew;
  section.blocks.emplace_back(slam_history_table(*input.study.histories));
  return section;
}

std::optional<Section> space_section(const SlamReportInput& input) {
  if (!input.study.space) return std::nullopt;
  const FigureGroup* figures = group_of(input.figures, kSlamSpace);
  Section section = figures != nullptr
                        ? figures_section(*figures)
                        : Section{kSlamSpace, "Range-only SLAM: landmarks in space", {}};
  section.blocks.emplace_back(slam_space_table(*input.study.space));
  return section;
}

std::optional<Section> cost_section(const SlamReportInput& input) {
  const FigureGroup* figures = group_of(input.figures, kSlamCost);
  auto seconds = slam_seconds_table(input.study, input.timings.methods);
  if (figures == nullptr && !seconds) return std::nullopt;
  Section section =
      figures != nullptr
          ? figures_section(*figures)
          : Section{kSlamCost,
                    "Range-only SLAM: cost",
                    {plain("Seconds differ from one start of the program to the next.")}};
  section.interest = Interest::kFew;
  if (is_of_paper(input.study))
    section.blocks.emplace_back(plain(
        "The paper states O((2N)\u00B2 T) for its factorisation, and \u201Cusually taking less "
        "than a second to run\u201D, in Matlab on a 2.66 GHz Core i7."));
  if (seconds) section.blocks.emplace_back(*std::move(seconds));
  return section;
}

std::string subtitle(const SlamStudy& study) {
  const auto real = std::ranges::count(study.runs, false, &SlamRun::simulated);
  std::vector<std::string> parts;
  if (is_of_paper(study)) parts.push_back(study.experiment.name);
  if (real > 0) parts.push_back(counted(real, "recorded drive"));
  if (std::ssize(study.runs) > real || !study.convergence.empty())
    parts.push_back(fmt::format("simulation with seed {}", study.experiment.seed));
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// The title of a section in a report on this paper alone: without the words that distinguish
/// papers. That of a run is its name, as it is written elsewhere.
std::string alone(const Section& section) {
  constexpr std::string_view kPrefix = "Range-only SLAM: ";
  if (!section.title.starts_with(kPrefix)) return section.title;
  std::string title = section.title.substr(kPrefix.size());
  return section.id.starts_with(kSlamRun) ? title : capitalised(std::move(title));
}

void add_statuses(const std::string& where, const std::string& id,
                  const std::vector<Status>& statuses, StatusList& list) {
  for (const Status& status : statuses) {
    const auto same = [&](const StatusList::Item& item) {
      return item.code == name(status.code) && item.where == where;
    };
    auto item = std::ranges::find_if(list.items, same);
    if (item == list.items.end()) {
      list.items.push_back({std::string(name(status.code)),
                            std::string(meaning(status.code)),
                            where,
                            0,
                            1,
                            status.code == StatusCode::kFailed,
                            {}});
      item = list.items.end() - 1;
    }
    item->count = 1;
    item->locations.push_back({id, status_text(status)});
  }
}

/// Of all records of the study, those without a map first.
StatusList status_list(const SlamStudy& study) {
  StatusList list;
  for (const SlamRun& run : study.runs)
    for (const SlamRecord& record : run.records)
      add_statuses(fmt::format("{}, {}", title_of(run), info(record.method).label),
                   record_id(run, record), record.estimate.statuses, list);
  if (study.histories)
    for (const RangeHistoryMap& map : study.histories->maps)
      add_statuses(fmt::format("{}, {}", map.squared ? "squared ranges" : "ranges",
                               map.setting ? label(*map.setting) : "spectral"),
                   "histories", map.statuses, list);
  if (study.space)
    for (const SpaceRecord& record : study.space->records)
      add_statuses(fmt::format("in space, {}",
                               record.knows_landmarks ? "landmarks known" : "no landmark known"),
                   "space", record.estimate.statuses, list);
  std::ranges::stable_partition(list.items, &StatusList::Item::failed);
  return list;
}

constexpr std::size_t kMostRuns = 3;  ///< Shown by their numbers before anything else.

/// The methods that a report compares first.
constexpr std::array kFirstMethods = {SlamMethod::kRefined, SlamMethod::kSpectral,
                                      SlamMethod::kDeadReckoning};

/// The first of these that has an error.
const SlamMethod* shown_method(const SlamRun& run) {
  return std::ranges::find_if(kFirstMethods, [&](SlamMethod one) {
    const TrajectoryError* error = error_of(run, one);
    return error != nullptr && std::isfinite(error->mean_m);
  });
}

/// A method's mean error.
struct MethodError {
  SlamMethod method;
  double mean_m;
};

/// Of all methods that need no known landmark and are aligned as the shown one, the least first.
std::vector<MethodError> comparable_errors(const SlamRun& run) {
  std::vector<MethodError> errors;
  const SlamMethod* shown = shown_method(run);
  if (shown == kFirstMethods.end()) return errors;
  for (const SlamRecord& record : run.records) {
    const TrajectoryError* error = error_of(run, record.method);
    if (!info(record.method).knows_landmarks && error != nullptr &&
        error->alignment == error_of(run, *shown)->alignment && std::isfinite(error->mean_m))
      errors.push_back({record.method, error->mean_m});
  }
  std::ranges::stable_sort(errors, {}, &MethodError::mean_m);
  return errors;
}

/// "refined (from odometry) 0.190 m; refined (scale free) 0.230 m; spectral (4-D) 0.420 m": the
/// estimates of least error, those that tie together; empty of one alone.
std::string best_estimates(const SlamRun& run) {
  constexpr std::size_t kMost = 3;
  std::vector<std::pair<std::string, std::vector<std::string>>> by_error;
  const std::vector<MethodError> errors = comparable_errors(run);
  for (const auto& [method, mean_m] : errors) {
    const std::string text = error_text(mean_m);
    if (by_error.empty() || by_error.back().first != text) {
      if (by_error.size() == kMost) break;
      by_error.emplace_back(text, std::vector<std::string>());
    }
    by_error.back().second.push_back(bracketed(info(method).label));
  }
  if (errors.size() < 2) return "";
  std::vector<std::string> words;
  for (const auto& [error, methods] : by_error)
    words.push_back(fmt::format("{} {}", listed(methods, methods.size()), error));
  return fmt::format("{}", fmt::join(words, "; "));
}

/// Why the figures of a drive show another estimate than that of least error; empty if they do not.
std::string why_not_best(const SlamRun& run) {
  const std::vector<MethodError> errors = comparable_errors(run);
  if (!run.figure.empty() || errors.empty()) return "";  // The paper's figures show its methods.
  const SlamMethod shown = *shown_method(run);
  if (error_text(errors.front().mean_m) == error_text(error_of(run, shown)->mean_m)) return "";
  return fmt::format(" Its figures show {}, which was chosen without the ground truth.",
                     bracketed(info(shown).label));
}

/// Which estimate of each recorded drive is the best, and by how much; empty if there is no choice.
std::string best_of_drives(const SlamStudy& study) {
  std::string text;
  std::size_t drives = 0;
  for (const SlamRun& run : study.runs) {
    if (run.simulated || drives == kMostRuns) continue;
    ++drives;
    if (const std::string best = best_estimates(run); !best.empty())
      text += fmt::format(" {}: {}.{}", title_of(run), best, why_not_best(run));
  }
  return text;
}

/// The table of the errors of all methods on recorded data.
std::string error_table_id(const SlamStudy& study) {
  return is_of_paper(study) ? "table-plaza" : "slam-errors";
}

/// "0.19 m" of the refined map or else of the spectral one, with what it compares with: the method
/// of least error if that is another one, and the other ones; each with its alignment.
std::optional<Highlights::Item> error_number(const SlamRun& run) {
  const SlamMethod* method = shown_method(run);
  if (method == kFirstMethods.end()) return std::nullopt;
  std::vector<std::string> details;
  for (const SlamMethod* other = method + 1; other != kFirstMethods.end(); ++other)
    if (const TrajectoryError* error = error_of(run, *other);
        error != nullptr && std::isfinite(error->mean_m))
      details.push_back(fmt::format("{} {} ({})", info(*other).label, error_text(error->mean_m),
                                    alignment_words(error->alignment)));
  std::ranges::reverse(details);  // Dead reckoning, which every reader knows, first.
  const std::string shown = error_text(error_of(run, *method)->mean_m);
  const std::string aligned = alignment_words(error_of(run, *method)->alignment);
  const std::vector<MethodError> errors = comparable_errors(run);
  if (!errors.empty() && error_text(errors.front().mean_m) != shown)
    if (const auto& [least, least_m] = errors.front();
        std::ranges::find(kFirstMethods, least) == kFirstMethods.end())
      details.insert(details.begin(), fmt::format("least: {} {} ({})", info(least).label,
                                                  error_text(least_m), aligned));
  details.insert(details.begin(), fmt::format("{} ({})", info(*method).label, aligned));
  if (const auto length = length_m(run.log)) details.push_back("over " + length_text(*length));
  return Highlights::Item{"mean position error, " + title_of(run), shown,
                          fmt::format("{}", fmt::join(details, "; ")), "slam-accuracy"};
}

void add_run_numbers(const SlamStudy& study, Highlights& numbers) {
  for (const SlamRun& run : study.runs) {
    if (run.simulated || numbers.items.size() == kMostRuns) continue;
    if (auto number = error_number(run)) {
      number->table = error_table_id(study);
      numbers.items.push_back(*std::move(number));
    } else {
      numbers.items.push_back({"landmarks mapped, " + title_of(run),
                               fmt::format("{}", run.log.landmarks.size()),
                               "no error: there is no true path", "slam-accuracy"});
    }
  }
}

void add_slope(const SlamStudy& study, Highlights& numbers) {
  if (study.convergence.empty()) return;
  const ConvergenceCurve& curve = study.convergence.front();
  const double slope = convergence_slope(curve);
  if (!std::isfinite(slope)) return;
  numbers.items.push_back(
      {"power of the measurements in the model error", slope_words(slope),
       fmt::format("theory: \u22121/2; {}{}", slope_basis(curve), brief_variant_words(study)),
       kSlamSimulation});
}

/// "the logs of Plaza 1 and Plaza 2 are missing"; empty if none is.
std::string missing_words(const SlamStudy& study) {
  const std::vector<std::string> titles = missing_titles(study);
  if (titles.empty()) return "";
  return titles.size() == 1 ? fmt::format("the log of {} is missing", titles.front())
                            : fmt::format("the logs of {} are missing", listed(titles, 4));
}

/// What the page lacks without the logs that are missing.
std::string lacks_words(const SlamStudy& study) {
  const bool has_drives = std::ranges::count(study.runs, false, &SlamRun::simulated) > 0;
  return is_of_paper(study) && !has_drives ? "the half of the paper on real data"
                                           : "their part of the results";
}

/// All warnings and failures of records, and where they occurred.
std::vector<std::string> warnings_of(const SlamStudy& study) {
  std::vector<std::string> codes;
  const StatusList list = status_list(study);
  for (const StatusList::Item& item : list.items)
    codes.push_back(fmt::format("{} ({})", item.code, item.where));
  return codes;
}

/// What the numbers of this study stand beside.
std::string compared_words(const SlamStudy& study) {
  std::vector<std::string> others;
  for (const auto& [method, words] :
       {std::pair{SlamMethod::kDeadReckoning, "dead reckoning"},
        std::pair{SlamMethod::kSpectral, is_of_paper(study) ? "the paper\u2019s own spectral method"
                                                            : "the spectral method"},
        std::pair{SlamMethod::kEkf, "an extended Kalman filter"}})
    if (std::ranges::any_of(study.runs, [&](const SlamRun& run) {
          return !run.simulated && record_of(run, method) != nullptr;
        }))
      others.emplace_back(words);
  if (!study.convergence.empty()) others.emplace_back("theory");
  if (study.histories) others.emplace_back("the mapping methods");
  return listed(others, others.size());
}

/// Whether no run has a ground truth, be it of its path or of its landmarks.
bool lacks_ground_truth(const SlamStudy& study) {
  return std::ranges::none_of(study.runs, [](const SlamRun& run) {
    return run.log.ground_truth || run.log.true_landmarks;
  });
}

/// The same, and what is missing for more.
Paragraph compared_with(const SlamStudy& study) {
  const std::string others = compared_words(study);
  if (is_of_paper(study)) return plain(fmt::format(": {}; the paper prints no errors.", others));
  if (study.convergence.empty() && lacks_ground_truth(study))
    return plain(fmt::format(": nothing; the {} no ground truth.",
                             study.runs.size() == 1 ? "log has" : "logs have"));
  return plain(fmt::format(": the ground truth{}.", others.empty() ? "" : ", " + others));
}

/// "Positions of landmarks and the path of a robot …: 2 recorded drives", and which estimates are
/// the best.
Paragraph what_was_done(const SlamStudy& study) {
  const auto real = std::ranges::count(study.runs, false, &SlamRun::simulated);
  std::vector<std::string> extent;
  if (real > 0) extent.push_back(counted(real, "recorded drive"));
  if (std::ssize(study.runs) > real)
    extent.push_back(counted(std::ssize(study.runs) - real, "simulated drive"));
  if (!study.convergence.empty())
    extent.push_back(counted(std::ssize(study.convergence), "convergence simulation"));
  Paragraph done =
      plain(fmt::format("Positions of landmarks and the path of a robot from ranges, and "
                        "odometry where there is any: {}.",
                        listed(extent, 4)));
  if (std::string best = best_of_drives(study); !best.empty()) {
    done.phrases.push_back(phrase(" "));
    done.phrases.push_back(strong("Best by mean position error"));
    done.phrases.push_back(phrase("." + best));
  }
  return done;
}

}  // namespace

Section slam_summary_section(const SlamStudy& study) {
  Section section{"slam-summary", "Range-only SLAM: summary", {}};
  for (const std::string& missing : missing_logs(study))
    section.blocks.emplace_back(
        Callout{Callout::Tone::kWarning, "Data missing", Paragraph{{{missing, Emphasis::kData}}}});
  BulletList findings;
  for (const SlamRun& run : study.runs)
    if (!run.simulated) add_run(run, findings);
  add_convergence(study, findings);
  for (const SlamRun& run : study.runs)
    if (run.simulated) add_run(run, findings);
  if (is_of_paper(study)) add_remarks_on_paper(findings);
  section.blocks.emplace_back(plain(
      "Path of a robot and positions of landmarks from ranges, and odometry where there is any. "
      "Squared ranges factor into landmarks and positions; least squares refines both."));
  section.blocks.emplace_back(std::move(findings));
  return section;
}

std::optional<Section> slam_accuracy_section(const SlamStudy& study) {
  const RunList runs = runs_of(study, false);
  if (runs.empty()) return std::nullopt;
  Section section{"slam-accuracy", "Range-only SLAM: methods", {}, "", Interest::kMost};
  Table errors =
      slam_error_table(error_table_id(study),
                       is_of_paper(study) ? "Methods on the Plaza data sets" : "Methods", runs);
  if (is_of_paper(study))
    errors.notes.emplace_back(
        "Published: the paper\u2019s text prints no errors of these methods, so no column holds "
        "any.");
  section.blocks.emplace_back(std::move(errors));
  section.blocks.emplace_back(slam_drive_table(runs));
  if (auto alignments = slam_alignment_table(runs)) fold(*std::move(alignments), section);
  return section;
}

std::optional<Section> slam_simulation_section(const SlamStudy& study, const FigureGroup* figures) {
  const RunList runs = runs_of(study, true);
  if (runs.empty() && study.convergence.empty()) return std::nullopt;
  Section section = section_of(figures, kSlamSimulation, "Range-only SLAM: simulation");
  if (!study.convergence.empty() && is_of_paper(study)) {
    section.blocks.emplace_back(plain(
        "The paper gives neither the noise nor the size of the area of its Fig. 1: those used "
        "here are choices of the experiment, listed under provenance."));
    section.blocks.emplace_back(bound_words(study.convergence.front()));
  }
  if (!runs.empty())
    section.blocks.emplace_back(
        slam_error_table("slam-errors-simulation", "Methods on the simulated example", runs));
  if (!study.convergence.empty())
    section.blocks.emplace_back(slam_convergence_table(study.convergence));
  for (const SlamRun* run : runs) add_remarks(*run, section);
  return section;
}

std::vector<Section> slam_sections(const SlamReportInput& input) {
  const SlamStudy& study = input.study;
  std::vector<Section> sections;
  for (const SlamRun& run : study.runs) {
    if (!run.fit) continue;
    std::vector<FigureBlock> figures;
    if (const FigureGroup* group = group_of(input.figures, slam_fit_group(run)))
      for (const Figure& figure : group->figures) figures.push_back(figure_block(figure));
    sections.push_back(fit_section(*run.fit, figures, slam_fit_group(run),
                                   "Range-only SLAM: do the data fit the map? " + title_of(run)));
  }
  sections.push_back(slam_summary_section(study));
  if (auto accuracy = slam_accuracy_section(study)) sections.push_back(*std::move(accuracy));
  for (const SlamRun& run : study.runs)
    if (!run.simulated)
      sections.push_back(
          slam_run_section(run, group_of(input.figures, slam_run_group(run)), is_of_paper(study)));
  if (auto simulation = slam_simulation_section(study, group_of(input.figures, kSlamSimulation)))
    sections.push_back(*std::move(simulation));
  if (auto histories = histories_section(input)) sections.push_back(*std::move(histories));
  if (auto space = space_section(input)) sections.push_back(*std::move(space));
  if (auto cost = cost_section(input)) sections.push_back(*std::move(cost));
  sections.push_back(slam_statuses_section(study));
  sections.push_back(slam_provenance_section(input));
  return sections;
}

Section slam_provenance_section(const SlamReportInput& input) {
  Section section{"slam-provenance", "Range-only SLAM: provenance", {}, "", Interest::kFew};
  section.blocks.emplace_back(
      plain("Every number here comes from the study\u2019s records; this command makes them and "
            "this report again, to the byte (seconds aside):"));
  section.blocks.emplace_back(KeyValues{{{"Command", {input.command, Emphasis::kCode}}}});
  KeyValues facts;
  const SlamExperiment& experiment = input.study.experiment;
  facts.items.push_back({"Study", {experiment.name, Emphasis::kData}});
  facts.items.push_back({"Seed", {fmt::format("{}", experiment.seed), Emphasis::kData}});
  for (const auto& [key, value] : simulation_facts(experiment))
    facts.items.push_back({key, {value, Emphasis::kData}});
  section.blocks.emplace_back(std::move(facts));
  section.blocks.emplace_back(provenance_items(input.study.provenance));
  if (!input.sessions.empty()) fold(sessions_table("slam-sessions", input.sessions), section);
  return section;
}

Report slam_report(const SlamReportInput& input) {
  Report report;
  const SlamExperiment& experiment = input.study.experiment;
  report.title = experiment.title.empty() ? experiment.name : experiment.title;
  report.subtitle = subtitle(input.study);
  report.sections = slam_sections(input);
  for (Section& section : report.sections) section.title = alone(section);
  report.opening = slam_opening(input.study, input.figures);
  report.date = date_of(input.sessions);
  report.footer = fmt::format("Made by mapproof {} ({}).", input.study.provenance.version,
                              input.study.provenance.commit);
  return report;
}

Section slam_statuses_section(const SlamStudy& study) {
  Section section{"slam-warnings", "Range-only SLAM: warnings and failures", {}};
  BulletList missing;
  for (const std::string& text : missing_logs(study)) missing.items.push_back(plain(text));
  StatusList list = status_list(study);
  if (missing.items.empty() && list.items.empty()) section.blocks.emplace_back(plain("None."));
  if (!missing.items.empty()) section.blocks.emplace_back(std::move(missing));
  if (!list.items.empty()) section.blocks.emplace_back(std::move(list));
  return section;
}

Opening slam_opening(const SlamStudy& study, const StudyFigures& figures) {
  Opening opening;
  if (study.runs.empty() && study.convergence.empty()) return opening;
  add_run_numbers(study, opening.numbers);
  add_slope(study, opening.numbers);
  opening.warnings = warnings_of(study);
  const std::vector<std::string>& warnings = opening.warnings;
  const std::string missing = missing_words(study);
  const std::size_t count = missing_titles(study).size() + warnings.size();
  std::vector<std::string> details;
  if (!missing.empty()) details.push_back(missing);
  if (!warnings.empty()) details.emplace_back("each listed with its reason");
  opening.numbers.items.push_back(
      {count == 1 ? "warning or failure" : "warnings and failures", fmt::format("{}", count),
       details.empty() ? "none" : fmt::format("{}", fmt::join(details, "; ")), "slam-warnings",
       count > 0});
  opening.findings.push_back(what_was_done(study));
  opening.compared_with = compared_with(study);
  for (const SlamRun& run : study.runs)
    if (run.fit)
      opening.findings.push_back({{strong(title_of(run)), phrase(": " + verdict_text(*run.fit))}});
  std::vector<std::string> wrong;
  if (!missing.empty())
    wrong.push_back(fmt::format("{}, and so is {}", missing, lacks_words(study)));
  if (!warnings.empty()) wrong.push_back(listed(warnings, 3));
  if (!wrong.empty()) opening.wrong = plain(fmt::format(": {}.", fmt::join(wrong, "; ")));
  std::vector<std::string> ids = {"fig-2b", "fig-2c"};
  for (const SlamRun& run : study.runs)
    if (!run.simulated) ids.push_back(path_figure_id(run));
  ids.emplace_back("fig-1b");
  for (const FigureGroup& group : figures.groups)
    if (!group.scenes.empty()) ids.push_back(group.scenes.front().id);
  ids.emplace_back("fig-1a");
  // Small, the tests of the fit would be a few thin lines; a sentence says how they came out.
  for (const FigureGroup& group : figures.groups)
    if (!group.figures.empty() && !group.id.starts_with(kSlamFit))
      ids.push_back(group.figures.front().id);
  choose_figures(ids, figures, opening);
  return opening;
}

}  // namespace mapproof
