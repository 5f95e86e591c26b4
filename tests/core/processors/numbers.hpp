#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace mapproof::test {

/// How far a number may be from that of another kind of processor, of the largest of its block:
/// 1e-6; 1e-4 for semidefinite embeddings, which end at a relative gap.
double across_processors(const std::string& block);

/// Blocks of numbers of one size by name: the coordinates of one map, the errors of one path. NaN
/// where there is none.
using Numbers = std::map<std::string, std::vector<double>>;

/// What core computes of inputs that are the same on every processor: a simulated run with its
/// scores, maps of the observations in tests/data/reference by every method, semidefinite
/// embeddings by both solvers, and paths and maps of a range log by every range-only method. What
/// rounding decides is left out: scores of maps in which landmarks coincide (LEM of few steps),
/// maps whose null space has a dimension too many (HLLE).
Numbers numbers();

/// As JSON, every double as it is.
std::string text_of(const Numbers& numbers);

/// What text_of() gave. @throws IoError.
Numbers read_numbers(const std::filesystem::path& file);

/// By block of either side, the largest difference of two numbers over the largest of the block's.
/// Infinite where the block is on one side alone, has another size or other gaps.
std::map<std::string, double> differences(const Numbers& first, const Numbers& second);

}  // namespace mapproof::test
