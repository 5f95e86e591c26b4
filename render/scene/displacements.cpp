#include "render/scene/displacements.hpp"

#include <fmt/format.h>

#include "core/base/text/words.hpp"

namespace mapproof {
namespace {

constexpr double kFarShare = 0.75;    // Of the room's side, as figures of maps have it.
constexpr double kLiftShare = 0.004;  // Above the floor, so that it does not shine through.
constexpr double kRadiusShare = 0.0035;

}  // namespace

Displacements displacements(const Points& ground_truth_m, const Points& estimate_m,
                            const Ground& ground) {
  const double side_m = ground.side();
  Displacements found;
  found.arrows.radius = kRadiusShare * side_m;
  found.arrows.arrow = true;
  const double lift = kLiftShare * side_m;
  for (Eigen::Index i = 0; i < ground_truth_m.rows(); ++i) {
    if (!ground_truth_m.row(i).allFinite()) continue;
    if (!estimate_m.row(i).allFinite()) {
      ++found.missing;
      continue;
    }
    const double reach = kFarShare * side_m;
    const double x = estimate_m(i, 0), y = estimate_m(i, 1);
    if (x < ground.low.x - reach || x > ground.high.x + reach || y < ground.low.y - reach ||
        y > ground.high.y + reach) {
      ++found.far;
      continue;
    }
    found.arrows.from.push_back(on_floor(ground_truth_m.row(i), lift));
    found.arrows.to.push_back(on_floor(estimate_m.row(i), lift));
    found.drawn.push_back(i);
    found.errors_m.push_back((estimate_m.row(i) - ground_truth_m.row(i)).norm());
  }
  return found;
}

std::string words_of_missing(const Displacements& found, const std::string& of) {
  std::string text;
  if (found.far > 0)
    text = fmt::format(
        "{} far outside the {}",
        found.far == 1 ? "1 estimate is" : fmt::format("{} estimates are", found.far), of);
  if (found.missing > 0)
    text += fmt::format(
        "{}{} no position", text.empty() ? "" : " and ",
        found.missing == 1 ? "1 landmark has" : fmt::format("{} landmarks have", found.missing));
  return text.empty() ? text : text + ".";
}

}  // namespace mapproof
