#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/model/map_record.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

/// Of the triples of landmarks of a usable map, the share that is turned at most; 50 are chance.
inline constexpr double kMostTurned_percent = 25.0;

/// Whether a map shows how landmarks lie.
bool is_usable(const Score& score);

/// A figure for each world with two maps or more: maps of one subject with the same landmarks at
/// the same true positions, with the same limits, the best first, those of no use last, twelve at
/// most. The title counts the maps that it ranks.
/// @param prefix  Of the ids, which go on with "-world-1".
/// @param maps    Each with its name, "dataset1: Range, CMDS"; what is before the first ": " is the
///                subject.
std::vector<Figure> map_walls(const std::string& prefix,
                              const std::vector<std::pair<std::string, const MapRecord*>>& maps);

}  // namespace mapproof
