#include "tests/fuzz/target.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>

#include "core/base/errors.hpp"
#include "tests/fuzz/properties.hpp"

// The sanitizers' own; absent without them.
extern "C" {
__attribute__((weak)) int __sanitizer_install_malloc_and_free_hooks(void (*)(const volatile void*,
                                                                             std::size_t),
                                                                    void (*)(const volatile void*));
__attribute__((weak)) std::size_t __sanitizer_get_allocated_size(const volatile void*);
}

namespace mapproof::fuzz {
namespace {

std::vector<Target>& all_targets() {
  static std::vector<Target> all;
  return all;
}

/// Bytes on the heap since the run began, and the most at once.
std::atomic<std::int64_t> held = 0, most_held = 0;

void count_taken(const volatile void*, std::size_t bytes) {
  const std::int64_t now = held += static_cast<std::int64_t>(bytes);
  std::int64_t most = most_held;
  while (now > most && !most_held.compare_exchange_weak(most, now)) {
  }
}

void count_given_back(const volatile void* memory) {
  if (memory != nullptr) held -= static_cast<std::int64_t>(__sanitizer_get_allocated_size(memory));
}

/// The target that libFuzzer runs.
const Target& asked_target() {
  static const Target& asked = [&]() -> const Target& {
    const char* name = std::getenv("MAPPROOF_FUZZ_TARGET");
    for (const Target& target : targets())
      if (name != nullptr && target.name == name) return target;
    std::fprintf(stderr, "MAPPROOF_FUZZ_TARGET has to name one of\n");
    for (const Target& target : targets()) std::fprintf(stderr, "  %s\n", target.name.c_str());
    std::exit(2);
  }();
  return asked;
}

}  // namespace

Added::Added(Target target) { all_targets().push_back(std::move(target)); }

const std::vector<Target>& targets() {
  std::vector<Target>& all = all_targets();
  if (!std::ranges::is_sorted(all, {}, &Target::name)) std::ranges::sort(all, {}, &Target::name);
  return all;
}

void run(const Target& target, std::string_view bytes) {
  static const bool counts_memory =
      __sanitizer_install_malloc_and_free_hooks != nullptr &&
      __sanitizer_install_malloc_and_free_hooks(count_taken, count_given_back) != 0;
  held = most_held = 0;
  try {
    target.run(bytes);
  } catch (const IoError&) {
  } catch (const InvalidInput&) {
  }
  const auto stated =
      static_cast<std::int64_t>(target.memory + target.memory_per_byte * bytes.size());
  if (counts_memory && most_held > stated)
    found("more memory than stated", std::to_string(most_held) + " bytes of " +
                                         std::to_string(stated) + " for an input of " +
                                         std::to_string(bytes.size()));
}

}  // namespace mapproof::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mapproof::fuzz;
  run(asked_target(), {reinterpret_cast<const char*>(data), size});
  return 0;
}
