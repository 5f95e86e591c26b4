#include "core/model/external_method.hpp"

#include <array>

namespace mapproof {

std::string_view name(ExternalInput input) {
  constexpr std::array<std::string_view, 3> kNames = {"distances", "features", "history"};
  return kNames[static_cast<std::size_t>(input)];
}

Method method_of(const ExternalMethod& method) {
  return external_method({.name = method.name,
                          .label = method.label,
                          .source = method.source,
                          .symbol = method.symbol});
}

}  // namespace mapproof
