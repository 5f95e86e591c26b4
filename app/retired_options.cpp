#include "app/retired_options.hpp"

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/retired_names.hpp"

namespace mapproof {

void refuse_retired_options(std::span<char* const> words) {
  for (const std::string_view word : words) {
    if (word == "--") return;
    const std::string_view name = word.substr(0, word.find('='));
    if (const std::string_view now = replacement_of(NameKind::kOption, name); !now.empty())
      throw InvalidInput(fmt::format("{}: this option is now called {}", name, now));
  }
}

}  // namespace mapproof
