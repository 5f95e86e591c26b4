#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "core/model/slam/slam_study.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

struct RefinementStartsSpec {
  std::string id;  ///< [a-z][a-z0-9-]*.
  std::string title;
  std::span<const RefinementStart> starts;
  std::string record_id;
};

/// How many starts of the refinement end at which final cost: a row with a bar per cost, the least
/// uppermost, with the mean position error there if there is ground truth; costs within 1 % of the
/// least of them are one, and the tenth row has all beyond. A bar has a part for starts from the
/// spectral answer, from odometry and from random landmarks. Starts without a result are counted in
/// a note.
Figure refinement_starts_figure(const RefinementStartsSpec& spec);

/// How many starts end within 1 % of the least cost, and at how many different costs all do.
struct StartEnds {
  std::size_t at_least = 0;
  std::size_t different = 0;
};
StartEnds start_ends(std::span<const RefinementStart> starts);

/// How many starts of one kind end within 1 % of the least cost of all, and how many there are.
struct StartCount {
  int reached = 0;
  int of = 0;
};
StartCount starts_at_optimum(std::span<const RefinementStart> starts, SlamMethod method);

}  // namespace mapproof
