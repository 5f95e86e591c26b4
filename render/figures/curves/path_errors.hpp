#pragma once

#include <optional>
#include <span>

#include "core/model/slam_study.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

/// Error of each position over time, one line per record, with its mean and alignment in the
/// legend; as dots what the record's own covariances make one expect. The y axis is logarithmic if
/// the errors span much.
/// @return Empty if no record has errors.
std::optional<Panel> path_error_panel(std::span<const SlamRecord* const> records);

}  // namespace mapproof
