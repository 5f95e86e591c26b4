#include "core/model/measurement.hpp"

#include <array>
#include <cstddef>

namespace mapproof {
namespace {

constexpr std::array kOutcomeNames = {std::string_view("visible"), std::string_view("hidden"),
                               std::string_view("out_of_reach")};

}  // namespace

std::string_view name(View view) { return kOutcomeNames[static_cast<std::size_t>(view)]; }

}  // namespace mapproof
