#include "app/retired_options.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

constexpr std::array kRetired = {
    RetiredOption{"--kind", "--sensor"},
    RetiredOption{"--with-kind", "--with-sensor"},
    RetiredOption{"--true-landmarks", "--ground-truth-landmarks"},
    RetiredOption{"--check-labels", "--check-ids"},
    RetiredOption{"--repair-labels", "--repair-ids"},
    RetiredOption{"--labels-unsure", "--uncertain-ids"},
};

}  // namespace

std::span<const RetiredOption> retired_options() { return kRetired; }

void refuse_retired_options(std::span<char* const> words) {
  for (const std::string_view word : words) {
    if (word == "--") return;
    const std::string_view name = word.substr(0, word.find('='));
    const auto retired = std::ranges::find(kRetired, name, &RetiredOption::name);
    if (retired != kRetired.end())
      throw InvalidInput(fmt::format("{}: this option is now called {}", name, retired->now));
  }
}

}  // namespace mapproof
