// Logs of ranges in every format, and folders of MRCLAM.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/records/ranges/range_logs.hpp"
#include "tests/fuzz/properties.hpp"
#include "tests/fuzz/target.hpp"

namespace mapproof::fuzz {
namespace {

std::string text_of(const RangeLog& log) {
  std::string text = fmt::format("{} {}", log.landmarks, log.remarks);
  for (const RangeMeasurement& range : log.ranges)
    text += fmt::format("\n{} {} {}", range.time_s, range.landmark, range.range_m);
  for (const Motion& motion : log.odometry)
    text += fmt::format("\n{} {} {} {}", motion.time_s, motion.distance_m,
                        motion.heading_change_rad, motion.sideways_m);
  if (log.ground_truth)
    text += fmt::format("\n{}", fmt::join(log.ground_truth->positions_m.reshaped().eval(), " "));
  if (log.true_landmarks)
    text += fmt::format("\n{}", fmt::join(log.true_landmarks->reshaped().eval(), " "));
  return text;
}

/// The first bytes determine the format: a corpus each, and one reader. What a log is recognized by
/// is read twice of one input in eight.
void read(std::string_view bytes) {
  const bool asks = bytes.size() % 8 == 0;
  read_in_any_way(bytes, [&](ByteSource& source) {
    if (asks) is_range_log(source);
    return text_of(read_range_log(source));
  });
}

const Added kCsv({.name = "ranges-csv", .run = read});
const Added kText({.name = "ranges-text", .run = read, .seeds = {"foreign"}});
const Added kPyfg({.name = "ranges-pyfg", .run = read});
// matio holds tables packed and unpacked, and as what it was asked for.
const Added kMat({.name = "ranges-mat", .run = read, .memory = std::size_t{128} << 20});

}  // namespace
}  // namespace mapproof::fuzz
