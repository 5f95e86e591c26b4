#include "app/processor.hpp"

#include <sys/utsname.h>

#include <algorithm>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"

namespace mapproof {
namespace {

/// The value of the first line that begins with the key; empty if there is none.
std::string_view value_of(std::string_view text, std::string_view key) {
  constexpr std::string_view kBlank = " \t";
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    const std::size_t colon = line.find(':');
    if (!line.starts_with(key) || colon == std::string_view::npos ||
        line.substr(key.size(), colon - key.size()).find_first_not_of(kBlank) !=
            std::string_view::npos)
      continue;
    const std::size_t start = line.find_first_not_of(kBlank, colon + 1);
    return start == std::string_view::npos ? "" : line.substr(start);
  }
  return "";
}

}  // namespace

std::string processor_kind() {
  utsname system{};
  const bool is_known = ::uname(&system) == 0;
  std::string cpuinfo;
  try {
    cpuinfo = read_file("/proc/cpuinfo");
  } catch (const IoError&) {  // Not every container shows it.
    cpuinfo.clear();
  }
  return processor_kind(cpuinfo, is_known ? system.machine : "unknown");
}

std::string processor_kind(std::string_view cpuinfo, std::string_view architecture) {
  std::string name(value_of(cpuinfo, "model name"));
  const std::string_view maker = value_of(cpuinfo, "CPU implementer");
  if (name.empty() && !maker.empty())
    name = fmt::format("implementer {}, part {}", maker, value_of(cpuinfo, "CPU part"));
  return printable(fmt::format("{} ({})", name.empty() ? "unknown" : name, architecture), 200);
}

}  // namespace mapproof
