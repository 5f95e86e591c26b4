#include "core/base/text/unit_text.hpp"

namespace mapproof {
namespace {

constexpr std::string_view kNoBreakSpace = "\u00A0";

}  // namespace

std::string with_unit(std::string_view number, std::string_view unit) {
  std::string text(number);
  if (!unit.empty() && unit != "\u00B0") text += kNoBreakSpace;
  return text.append(unit);
}

std::string with_plain_spaces(std::string text) {
  for (std::size_t at = text.find(kNoBreakSpace); at != std::string::npos;
       at = text.find(kNoBreakSpace, at))
    text.replace(at, kNoBreakSpace.size(), " ");
  return text;
}

}  // namespace mapproof
