#include "reports/sections/map_report.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "core/statistics/intervals.hpp"
#include "render/figures/maps/map_ellipses.hpp"
#include "render/figures/score_text.hpp"
#include "render/figures/status_text.hpp"
#include "reports/model/format.hpp"
#include "reports/sections/certificates.hpp"
#include "reports/sections/opening.hpp"
#include "reports/sections/tables/cells.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

using Eigen::Index;

constexpr const char* kPositions = "positions";  ///< Section of the landmarks.
constexpr const char* kWarnings = "warnings";

Table ellipse_table(const MapRecord& record, const std::vector<std::optional<Ellipse>>& ellipses) {
  const std::string unit = record.frame == Frame::kGroundTruth ? "m" : "";
  Table table{"ellipses",
              "95 % confidence ellipse of every landmark, the largest first",
              {{"Landmark", "", "", ""},
               {"longer", unit, "Half axis", ""},
               {"shorter", unit, "Half axis", ""},
               {"Angle", "°", "", "From the x axis to the longer axis, counter-clockwise."},
               {"Anchor", "", "", "Its true position was given."}},
              {},
              {}};
  std::vector<std::size_t> order(ellipses.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(
      order, {}, [&](std::size_t i) { return ellipses[i] ? -ellipses[i]->a : kInfinity; });
  for (const std::size_t i : order) {
    const std::optional<Ellipse>& ellipse = ellipses[i];
    const double turn = ellipse ? ellipse->rotation_rad * 180.0 / std::numbers::pi : kNaN;
    Row row;
    row.cells = {TextCell{record.names[i], Emphasis::kData},
                 NumberCell{ellipse ? ellipse->a : kNaN, 3},
                 NumberCell{ellipse ? ellipse->b : kNaN, 3}, NumberCell{turn, 0},
                 TextCell{is_anchor(record, static_cast<Index>(i)) ? "yes" : "no"}};
    row.source = record.id;
    table.rows.push_back(std::move(row));
  }
  return table;
}

using Eigen::Index;

bool placed(const Points& points, Index row) { return points.row(row).allFinite(); }

Index mapped_count(const MapRecord& record) {
  Index count = 0;
  for (Index i = 0; i < record.estimate.rows(); ++i) count += placed(record.estimate, i) ? 1 : 0;
  return count;
}

bool any_ground_truth(const MapRecord& record) {
  return record.ground_truth_m && record.ground_truth_m->array().isFinite().any();
}

/// How many landmarks that are not anchors have a true position.
Index compared_count(const MapRecord& record) {
  Index count = 0;
  for (Index i = 0; record.ground_truth_m && i < record.ground_truth_m->rows(); ++i)
    if (placed(*record.ground_truth_m, i) && !is_anchor(record, i)) ++count;
  return count;
}

std::string unit(const MapRecord& record) { return record.frame == Frame::kGroundTruth ? "m" : ""; }

/// Of the coordinates of a table.
struct Decimals {
  int of_map = 3;
  int of_ground_truth = 3;
};

Decimals decimals_of(const MapRecord& record) {
  return {.of_map = position_decimals(record.estimate),
          .of_ground_truth = record.ground_truth_m ? position_decimals(*record.ground_truth_m) : 3};
}

void add_ground_truth(const MapRecord& record, Index row, int decimals, std::vector<Cell>& cells) {
  const Points& ground_truth = *record.ground_truth_m;
  for (Index axis = 0; axis < 2; ++axis)
    cells.push_back(position_cell(ground_truth(row, axis), decimals));
  if (record.frame == Frame::kGroundTruth)
    cells.emplace_back(NumberCell{(record.estimate.row(row) - ground_truth.row(row)).norm(), 3});
}

std::vector<Column> point_columns(const MapRecord& record) {
  std::vector<Column> columns = {{"Landmark", "", "", ""},
                                 {"x", unit(record), "Map", "", false},
                                 {"y", unit(record), "Map", "", false}};
  if (!any_ground_truth(record)) return columns;
  const bool has_true_positions = compared_count(record) > 0;  // Else anchors as given alone.
  const char* group = has_true_positions ? "Ground truth" : "Given";
  columns.push_back({"x", "m", group, "", false});
  columns.push_back({"y", "m", group, "", false});
  if (record.frame == Frame::kGroundTruth)
    columns.push_back({"Error", "m", "",
                       has_true_positions ? "Distance from the true position."
                                          : "Distance from the given position."});
  return columns;
}

Row point_row(const MapRecord& record, Index row, const Decimals& decimals) {
  const auto number = static_cast<std::size_t>(row);
  Row out;
  out.cells = {TextCell{record.names[number], Emphasis::kData},
               position_cell(record.estimate(row, 0), decimals.of_map),
               position_cell(record.estimate(row, 1), decimals.of_map)};
  if (any_ground_truth(record)) add_ground_truth(record, row, decimals.of_ground_truth, out.cells);
  out.source = record.id;
  return out;
}

/// Of more landmarks than a page can list: the rows of those without a position, then of the
/// largest errors, then of landmarks whose error is not known; or the first ones.
std::vector<Index> listed_rows(const MapRecord& record) {
  constexpr Index kMostListed = 5000, kShortList = 1000;
  std::vector<Index> rows(static_cast<std::size_t>(record.estimate.rows()));
  std::iota(rows.begin(), rows.end(), Index{0});
  if (std::ssize(rows) <= kMostListed) return rows;
  if (record.frame == Frame::kGroundTruth && any_ground_truth(record)) {
    const Eigen::VectorXd errors = (record.estimate - *record.ground_truth_m).rowwise().norm();
    std::ranges::stable_sort(rows, {}, [&](Index i) {
      if (!record.estimate.row(i).allFinite()) return -kInfinity;
      return std::isnan(errors(i)) ? kInfinity : -errors(i);
    });
  }
  rows.resize(static_cast<std::size_t>(kShortList));
  return rows;
}

std::string caption_of(const MapRecord& record, const std::vector<Index>& rows) {
  const Index landmarks = record.estimate.rows();
  if (std::ssize(rows) == landmarks) return "Every landmark";
  std::string which = "The first {} of {} landmarks; map.csv lists all";
  if (record.frame == Frame::kGroundTruth && any_ground_truth(record)) {
    const bool are_known = std::ranges::all_of(rows, [&](Index i) {
      return record.ground_truth_m->row(i).allFinite() || !record.estimate.row(i).allFinite();
    });
    which = are_known ? "The {} largest errors of {} landmarks; map.csv lists all"
                      : "{} of {} landmarks, those of known errors first; map.csv lists all";
  }
  return fmt::format(fmt::runtime(which), count_text(std::ssize(rows)), count_text(landmarks));
}

Table landmarks_table(const MapRecord& record) {
  const std::vector<Index> rows = listed_rows(record);
  Table table{"landmarks", caption_of(record, rows), point_columns(record), {}, {}};
  table.columns.push_back({"Anchor", "", "", "Its true position was given."});
  const Decimals decimals = decimals_of(record);
  for (const Index i : rows) {
    table.rows.push_back(point_row(record, i, decimals));
    table.rows.back().cells.emplace_back(TextCell{is_anchor(record, i) ? "yes" : "no"});
  }
  if (record.frame == Frame::kSimilarity)
    table.notes.push_back(fmt::format(
        "{}: the map is defined up to a translation, a rotation, a scale and a reflection.",
        record.anchors.empty() ? "No anchors" : "Not aligned to the anchors"));
  if (mapped_count(record) < record.estimate.rows())
    table.notes.push_back("A dash marks a landmark that has no position in the map.");
  return table;
}

Table anchors_table(const MapRecord& record) {
  const char* caption = record.frame == Frame::kGroundTruth ? "Anchors: the map was aligned to them"
                                                            : "Anchors, as given";
  Table table{"anchors", caption, point_columns(record), {}, {}};
  const Decimals decimals = decimals_of(record);
  for (const Index row : record.anchors) table.rows.push_back(point_row(record, row, decimals));
  return table;
}

/// "mean position error over 26 landmarks, without the 4 anchors".
std::string meaning_of(const ErrorWords& error, const MapRecord& record) {
  const std::string landmarks = error.name == "MPE" ? scored_landmarks_text(record) : "";
  return fmt::format("{}{}{}{}{}", error.meaning, landmarks.empty() ? "" : " over ", landmarks,
                     error.limit.empty() ? "" : ", ", error.limit);
}

/// "map of 2.4 m by 2.5 m", against which a reader weighs its errors; empty without metres.
std::string extent_words(const MapRecord& record) {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(kInfinity), high = -low;
  for (Index i = 0; i < record.estimate.rows(); ++i) {
    if (!placed(record.estimate, i)) continue;
    const Eigen::Vector2d position = record.estimate.row(i).head<2>().transpose();
    low = low.cwiseMin(position);
    high = high.cwiseMax(position);
  }
  if (record.frame != Frame::kGroundTruth || !(low.array() <= high.array()).all()) return "";
  return fmt::format("map of {} m by {} m", significant(high.x() - low.x(), 2),
                     significant(high.y() - low.y(), 2));
}

/// The first error stands beside the size of the map.
std::string with_extent(const std::string& words, bool is_first, const MapRecord& record) {
  const std::string extent = is_first ? extent_words(record) : "";
  return extent.empty() ? words : extent + "; " + words;
}

/// How far the map puts the anchor that it misses most from where it was given.
std::optional<Highlights::Item> anchor_number(const MapRecord& record, bool is_first_error) {
  const std::optional<WorstAnchor> worst = worst_anchor(record);
  if (!worst) return std::nullopt;
  return Highlights::Item{
      "greatest distance of an anchor from its given position", error_text(worst->error_m),
      with_extent(
          fmt::format("{}, of {}", worst->name, counted(std::ssize(record.anchors), "anchor")),
          is_first_error, record),
      kPositions, worst->is_contradicted};
}

/// "the map misses the given position of anchor L10 by 0.346 m"; empty if it contradicts no anchor.
/// Which anchor is wrong, if one is, the map does not show.
std::string missed_words(const MapRecord& record) {
  const std::optional<WorstAnchor> worst = worst_anchor(record);
  if (!worst || !worst->is_contradicted) return "";
  return fmt::format("the map misses the given position of anchor {} by {}",
                     printable(worst->name, 40), error_text(worst->error_m));
}

/// Those of the command, and the anchor that the map contradicts; the map has its statuses besides.
std::vector<std::string> stated_warnings(const MapReportInput& input) {
  std::vector<std::string> warnings = input.warnings;
  if (const std::string missed = missed_words(input.record); !missed.empty())
    warnings.push_back(capitalised(missed) + ".");
  return warnings;
}

std::size_t warning_count(const MapReportInput& input) {
  return stated_warnings(input).size() + input.record.statuses.size();
}

/// How many warnings the page lists.
Highlights::Item warning_number(const MapReportInput& input) {
  const std::size_t count = warning_count(input);
  const std::string missed = missed_words(input.record);
  std::vector<std::string> details;
  if (!missed.empty()) details.push_back(missed);
  if (count > details.size()) details.emplace_back("listed with their reasons");
  return {count == 1 ? "warning or failure" : "warnings and failures", fmt::format("{}", count),
          details.empty() ? "none" : fmt::format("{}", fmt::join(details, "; ")), kWarnings,
          count > 0};
}

/// How good the map is comes first: its errors, or else whether the data fit it.
Highlights numbers_of(const MapReportInput& input) {
  const MapRecord& record = input.record;
  Highlights out;
  if (record.score)
    for (const ErrorWords& error : error_words(*record.score))
      out.items.push_back({error.name, error.value,
                           with_extent(meaning_of(error, record), out.items.empty(), record),
                           kPositions});
  auto worst = anchor_number(record, !record.score);
  const bool has_worst = worst.has_value();
  const bool is_contradicted = has_worst && worst->falls_short;
  if (is_contradicted) out.items.push_back(*worst);  // Before a fit that says nothing of it.
  if (input.fit_number) out.items.push_back(*input.fit_number);
  if (has_worst && !is_contradicted) out.items.push_back(*std::move(worst));
  out.items.push_back({"landmarks mapped",
                       fmt::format("{} of {}", mapped_count(record), record.estimate.rows()),
                       counted(record.step, "observation") + " used", kPositions});
  if (!has_worst)  // Else it says how many there are.
    out.items.push_back({"anchors", fmt::format("{}", record.anchors.size()),
                         record.frame != Frame::kGroundTruth ? "shape alone, without scale"
                         : record.anchors.empty() ? "map in metres, in a frame of its own"
                                                  : "map in metres, in their frame",
                         kPositions});
  out.items.push_back(warning_number(input));
  return out;
}

/// Name and error of the landmark that is farthest from its true position.
Paragraph worst_finding(const MapRecord& record) {
  Index worst = -1;
  double largest = -1.0;
  for (Index i = 0; i < record.estimate.rows(); ++i) {
    const double error = (record.estimate.row(i) - record.ground_truth_m->row(i)).norm();
    if (std::isfinite(error) && error > largest && !is_anchor(record, i)) {
      largest = error;
      worst = i;
    }
  }
  if (worst < 0) return {};
  return {{{record.anchors.empty() ? "Farthest from its true position is "
                                   : "Farthest from its true position, but for the anchors, is ",
            Emphasis::kPlain},
           {record.names[static_cast<std::size_t>(worst)], Emphasis::kData},
           {fmt::format(", by {}.", error_text(largest)), Emphasis::kPlain}}};
}

/// Why a map has a shape alone, and what that leaves undetermined.
std::string shape_finding(const MapRecord& record) {
  const bool scored = record.score && !score_text(*record.score).empty();
  return fmt::format(
      "{}: the map is defined up to a translation, a rotation, a scale and a reflection{}",
      record.anchors.empty() ? "No anchors were given"
                             : "The map could not be aligned to the anchors",
      scored ? "; the errors above are those that need no anchors."
             : "; no error in metres can be determined.");
}

/// By which method, from what.
Paragraph what_was_done(const MapRecord& record) {
  const std::string landmarks = counted(record.estimate.rows(), "landmark");
  return plain(
      std::holds_alternative<FromSensor>(record.origin)
          ? fmt::format("{} from {} observations of {}: {}.", method_label(record),
                        sensor_label(record), landmarks, info(setting_of(record)->method).summary)
          : fmt::format("{}, {}, of {}.", method_label(record), sensor_label(record), landmarks));
}

/// What the map is compared with: ground truth, else the anchors as they were given.
std::string compared_words(const MapRecord& record) {
  if (const Index known = compared_count(record); known > 0)
    return "the true positions of " + counted(known, "landmark") +
           (record.anchors.empty() ? "" : " that are not anchors");
  if (worst_anchor(record))
    return fmt::format("the given positions of {}; no ground truth was given",
                       counted(std::ssize(record.anchors), "anchor"));
  return "nothing; no ground truth was given";
}

/// The map, how well it fits its data, and what needs attention.
Opening opening_of(const MapReportInput& input) {
  const MapRecord& record = input.record;
  Opening opening;
  opening.numbers = numbers_of(input);
  opening.findings.push_back(what_was_done(record));
  if (!input.verdict.empty())
    opening.findings.push_back({{strong("Fit"), phrase(": " + input.verdict)}});
  opening.compared_with = plain(": " + compared_words(record) + ".");
  std::vector<std::string> wrong = input.warnings;
  for (const Status& status : record.statuses) wrong.push_back(status_text(status));
  if (!wrong.empty()) opening.wrong = plain(": " + listed(wrong, 3) + ".");
  opening.main_figure = input.figure.id;
  // The tests of the fit are a tile; small, their figure would be a few thin lines.
  for (const FigureBlock& figure : input.more_figures)
    if (opening.figure_ids.size() < kMostCandidates) opening.figure_ids.push_back(figure.id);
  return opening;
}

Section summary(const MapReportInput& input) {
  const MapRecord& record = input.record;
  Section section{"summary", "Summary", {}};
  for (const std::string& warning : input.warnings)
    section.blocks.emplace_back(Callout{Callout::Tone::kWarning, "Warning", plain(warning)});
  BulletList findings;
  findings.items.push_back(what_was_done(record));
  if (record.frame == Frame::kGroundTruth && any_ground_truth(record))
    if (Paragraph worst = worst_finding(record); !worst.phrases.empty())
      findings.items.push_back(std::move(worst));
  if (record.frame == Frame::kSimilarity) findings.items.push_back(plain(shape_finding(record)));
  if (const std::size_t count = warning_count(input); count > 0)
    findings.items.push_back(plain(fmt::format(
        "{} {} attention, listed below.", counted(count, "thing"), count == 1 ? "needs" : "need")));
  section.blocks.emplace_back(std::move(findings));
  return section;
}

Section input_section(const MapReportInput& input) {
  Section section{"input", "What was read", {}};
  KeyValues facts;
  for (const auto& [key, value] : input.facts)
    facts.items.push_back({key, {value, Emphasis::kData}});
  section.blocks.emplace_back(std::move(facts));
  if (input.remarks.empty()) {
    section.blocks.emplace_back(plain("Nothing was left out."));
    return section;
  }
  BulletList remarks;
  for (const std::string& remark : input.remarks)
    remarks.items.push_back({{{remark, Emphasis::kData}}});
  section.blocks.emplace_back(plain("Left out or changed when the input was read:"));
  section.blocks.emplace_back(std::move(remarks));
  return section;
}

Section warnings_section(const MapReportInput& input) {
  const MapRecord& record = input.record;
  Section section{kWarnings, "Warnings and failures", {}};
  if (warning_count(input) == 0) {
    section.blocks.emplace_back(plain("None."));
    return section;
  }
  BulletList stated;
  for (const std::string& warning : stated_warnings(input)) stated.items.push_back(plain(warning));
  if (!stated.items.empty()) section.blocks.emplace_back(std::move(stated));
  if (record.statuses.empty()) return section;
  StatusList list;
  for (const Status& status : record.statuses) {
    const auto same = std::ranges::find(list.items, name(status.code), &StatusList::Item::code);
    if (same != list.items.end())
      same->locations.push_back({record.id, status_text(status)});
    else
      list.items.push_back({std::string(name(status.code)),
                            std::string(meaning(status.code)),
                            method_label(record),
                            1,
                            1,
                            status.code == StatusCode::kFailed,
                            {{record.id, status_text(status)}}});
  }
  section.blocks.emplace_back(std::move(list));
  return section;
}

Section provenance(const MapReportInput& input) {
  Section section{"provenance", "Provenance", {}};
  section.blocks.emplace_back(plain("This command makes the map and this report again:"));
  section.blocks.emplace_back(KeyValues{{{"Command", {input.command, Emphasis::kCode}},
                                         {"Record", {input.record.id, Emphasis::kCode}}}});
  section.blocks.emplace_back(provenance_items(input.provenance));
  return section;
}

void require_sizes(const MapRecord& record) {
  const Index rows = record.estimate.rows();
  if (static_cast<Index>(record.names.size()) != rows ||
      (record.ground_truth_m && record.ground_truth_m->rows() != rows))
    throw InvalidInput("map_report: names, estimate and ground truth must have one length");
  for (const Index anchor : record.anchors)
    if (anchor < 0 || anchor >= rows) throw InvalidInput("map_report: an anchor is not a landmark");
}

}  // namespace

Section uncertainty_section(const MapRecord& record, const MapUncertainty& uncertainty) {
  if (std::ssize(uncertainty.covariances) != record.estimate.rows())
    throw InvalidInput("the ellipses of a map need one covariance per landmark");
  std::vector<std::optional<Ellipse>> ellipses;
  std::vector<double> axes;
  for (Index i = 0; i < record.estimate.rows(); ++i) {
    ellipses.push_back(confidence_ellipse(uncertainty, i));
    if (ellipses.back() && !is_anchor(record, i)) axes.push_back(ellipses.back()->a);
  }
  Section section{"uncertainty", "Uncertainty of each landmark", {}};
  section.blocks.emplace_back(plain(ellipse_words(uncertainty)));
  if (!axes.empty())
    section.blocks.emplace_back(plain(
        fmt::format("Half the longer axis is {}{} in the median, and {}{} at most.",
                    format_number(median(axes), 3), record.frame == Frame::kGroundTruth ? " m" : "",
                    format_number(std::ranges::max(axes), 3),
                    record.frame == Frame::kGroundTruth ? " m" : "")));
  if (record.frame == Frame::kSimilarity)
    section.blocks.emplace_back(plain(
        "The map has no anchors: maps of other steps were aligned to it by the similarity that "
        "fits best, and lengths are in its own unit."));
  section.blocks.emplace_back(ellipse_table(record, ellipses));
  return section;
}

Report map_report(const MapReportInput& input) {
  require_sizes(input.record);
  Report report;
  report.title = input.title;
  report.subtitle =
      fmt::format("{}, {}, {}", method_label(input.record), sensor_label(input.record),
                  counted(input.record.step, "observation"));
  report.opening = opening_of(input);
  if (input.fit) report.sections.push_back(*input.fit);
  report.sections.push_back(summary(input));
  report.sections.push_back({"map", "Map", {input.figure}});
  for (const FigureBlock& figure : input.more_figures)
    report.sections.back().blocks.emplace_back(figure);
  Section landmarks{kPositions, "Landmarks", {}};
  if (!input.record.anchors.empty()) landmarks.blocks.emplace_back(anchors_table(input.record));
  landmarks.blocks.emplace_back(landmarks_table(input.record));
  report.sections.push_back(std::move(landmarks));
  report.sections.insert(report.sections.end(), input.more.begin(), input.more.end());
  report.sections.push_back(input_section(input));
  if (input.record.certificate)
    report.sections.push_back(certificate_section(*input.record.certificate));
  report.sections.push_back(warnings_section(input));
  report.sections.push_back(provenance(input));
  report.footer =
      fmt::format("Made by mapproof {} ({}).", input.provenance.version, input.provenance.commit);
  return report;
}

std::string with_anchors(const std::string& verdict, const MapRecord& record) {
  const std::string missed = missed_words(record);
  if (missed.empty()) return verdict;
  return fmt::format("{} But {}, {:.0f}\u00a0% of its longer side.", verdict, missed,
                     worst_anchor(record)->share_percent);
}

std::string scored_landmarks_text(const MapRecord& record) {
  if (!record.score || !record.ground_truth_m) return "";
  const bool leaves_out = std::isfinite(record.score->mpe_m);
  if (!leaves_out && !std::isfinite(record.score->mpe_all_fitted_m)) return "";
  std::ptrdiff_t scored = 0;
  for (Index i = 0; i < record.estimate.rows(); ++i)
    if (placed(record.estimate, i) && placed(*record.ground_truth_m, i) &&
        (!leaves_out || !is_anchor(record, i)))
      ++scored;
  std::string text = counted(scored, "landmark");
  if (leaves_out && !record.anchors.empty())
    text += fmt::format(", without the {}", counted(std::ssize(record.anchors), "anchor"));
  return text;
}

}  // namespace mapproof
