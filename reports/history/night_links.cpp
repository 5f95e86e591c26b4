#include "reports/history/night_links.hpp"

#include <fmt/format.h>

namespace mapproof {

Phrase NightLinks::link(const std::string& path, const std::string& words) {
  words_[path] = words;
  return {path, Emphasis::kFile};
}

Phrase NightLinks::index() { return link(places_.pages + "index.html", "all nights"); }

Phrase NightLinks::trends(const std::string& study) {
  return link(fmt::format("{}trends/{}/report.html", places_.pages, study), "trends of " + study);
}

Phrase NightLinks::report(int night, const std::string& study) {
  return link(fmt::format("{}nights/{:04}/{}/report.html", places_.nights, night, study),
              fmt::format("report of night {}", night));
}

Phrase NightLinks::folder(int night) {
  return link(fmt::format("{}nights/{:04}/", places_.nights, night),
              fmt::format("folder of night {}", night));
}

}  // namespace mapproof
