#include "reports/sections/certainty_section.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/words.hpp"
#include "core/statistics/intervals.hpp"
#include "render/figures/maps/map_ellipses.hpp"
#include "reports/model/format.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

using Eigen::Index;

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
    const double turn = ellipse ? ellipse->turn_rad * 180.0 / std::numbers::pi : kNaN;
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

}  // namespace

Section certainty_section(const MapRecord& record, const MapCertainty& certainty) {
  if (std::ssize(certainty.covariances) != record.estimate.rows())
    throw InvalidInput("the ellipses of a map need one covariance per landmark");
  std::vector<std::optional<Ellipse>> ellipses;
  std::vector<double> axes;
  for (Index i = 0; i < record.estimate.rows(); ++i) {
    ellipses.push_back(confidence_ellipse(certainty, i));
    if (ellipses.back() && !is_anchor(record, i)) axes.push_back(ellipses.back()->a);
  }
  Section section{"certainty", "Uncertainty of each landmark", {}};
  section.blocks.emplace_back(plain(ellipse_words(certainty)));
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

}  // namespace mapproof
