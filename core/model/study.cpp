#include "core/model/study.hpp"

#include <fmt/format.h>

namespace mapproof {

std::string slug(const RunId& run) {
  return fmt::format("layout-{}-pose-{}", run.layout, run.pose);
}

std::string record_id(const RunId& run, Sensor sensor, const MethodSetting& setting, int step) {
  return fmt::format("{}/{}/{}/{}", slug(run), name(sensor), slug(setting), step);
}

}  // namespace mapproof
