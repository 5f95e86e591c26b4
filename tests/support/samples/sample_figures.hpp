#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "core/model/map_record.hpp"
#include "render/figures/curves/error_curve.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

/// For GoogleTest's messages.
inline void PrintTo(const Figure& figure, std::ostream* out) { *out << figure.id; }

}  // namespace mapproof

namespace mapproof::test {

/// A map of `landmarks` in a 2.5 m room: errors are normal with `error_m`, all from `seed`.
MapRecord sample_map(int landmarks, double error_m, std::uint64_t seed);

/// `count` falling error curves with bands.
ErrorCurveSpec sample_curves(std::size_t count, std::uint64_t seed);

/// Names that have broken something somewhere.
std::vector<std::string> hostile_names();

/// Every kind of figure, with tame data and with data that is hard to draw. Ids tell which.
std::vector<Figure> sample_figures();

}  // namespace mapproof::test
