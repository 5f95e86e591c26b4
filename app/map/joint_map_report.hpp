#pragma once

#include <optional>

#include <nlohmann/json.hpp>

#include "app/map/joint_map.hpp"
#include "render/plot/figure.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// The joint map beside each sensor's own: weights, what speaks for which, errors where known.
Section mixed_section(const JointMapResult& mixed);

/// The same for --json.
nlohmann::ordered_json mixed_json(const JointMapResult& mixed);

/// The maps beside each other; empty if fewer than two came out.
std::optional<Figure> mixed_figure(const JointMapResult& mixed);

}  // namespace mapproof
