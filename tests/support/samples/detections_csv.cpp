#include "tests/support/samples/detections_csv.hpp"

#include <fmt/format.h>

namespace mapproof::test {

std::string detections_csv(const DetectionLog& log, double unit) {
  std::string text = "step,landmark,range,bearing\n";
  for (const Detection& seen : log.detections)
    text +=
        fmt::format("{},{},{},{}\n", seen.step, log.names[static_cast<std::size_t>(seen.landmark)],
                    seen.range_m, unit * seen.bearing_rad);
  return text;
}

}  // namespace mapproof::test
