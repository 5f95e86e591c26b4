#include "core/base/out_of_memory.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"

namespace mapproof {
namespace {

double of_machine() {
  std::ifstream file("/proc/meminfo");
  std::string key;
  double kilobytes = 0.0;
  std::string unit;
  while (file >> key >> kilobytes && std::getline(file, unit))
    if (key == "MemAvailable:") return 1024.0 * kilobytes;
  return kInfinity;
}

double of_address_space() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kInfinity;
  std::ifstream file("/proc/self/statm");
  double pages = 0.0;
  file >> pages;
  return static_cast<double>(limit.rlim_cur) - pages * static_cast<double>(::getpagesize());
}

/// What the kernel gives back when it is asked: pages of files.
double cached_bytes(const std::filesystem::path& folder) {
  std::ifstream file(folder / "memory.stat");
  std::string key;
  double bytes = 0.0, sum = 0.0;
  while (file >> key >> bytes)
    if (key == "active_file" || key == "inactive_file") sum += bytes;
  return sum;
}

/// Of version 2 of control groups: the least of the process's group and of those it is in.
double of_control_groups() {
  std::ifstream groups("/proc/self/cgroup");
  std::string line;
  while (std::getline(groups, line) && !line.starts_with("0::")) {
  }
  if (!line.starts_with("0::/")) return kInfinity;
  const std::filesystem::path root = "/sys/fs/cgroup";
  double least = kInfinity;
  for (std::filesystem::path group = line.substr(4);; group = group.parent_path()) {
    double most = 0.0, used = 0.0;
    if (std::ifstream(root / group / "memory.max") >> most &&
        std::ifstream(root / group / "memory.current") >> used)
      least = std::min(least, most - used + cached_bytes(root / group));
    if (group.empty()) return least;
  }
}

}  // namespace

OutOfMemory::OutOfMemory(const std::string& path, const char* remark) noexcept {
  std::string words = kOutOfMemory;
  try {
    words += ": " + printable(path, words_.size() / 2) + remark;
  } catch (const std::bad_alloc&) {
    words = kOutOfMemory;  // Without the path.
  }
  words.resize(std::min(words.size(), words_.size() - 1));
  std::ranges::copy(words, words_.begin());
}

double available_memory_bytes() {
  return std::max(0.0, std::min({of_machine(), of_address_space(), of_control_groups()}));
}

}  // namespace mapproof
