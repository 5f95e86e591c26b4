#include "core/model/study.hpp"

#include <fmt/format.h>

namespace mapproof {

std::string slug(const RunId& run) {
  return fmt::format("layout-{}-pose-{}", run.layout, run.pose);
}

}  // namespace mapproof
