#include "render/plot/short_names.hpp"

#include <array>
#include <string_view>
#include <utility>

namespace mapproof {
namespace {

constexpr double kNarrow = 40.0;  // em; a column of a journal has some 30, a page some 60.

constexpr std::array<std::pair<std::string_view, std::string_view>, 8> kShort = {{
    {"SMACOF, equal weights", "SMACOF"},
    {"SMACOF, kNN weights", "SMACOF kNN"},
    {"KPCA, Gaussian", "KPCA Gauss"},
    {"KPCA, polynomial", "KPCA poly"},
    {"Pairwise-complete", "Pairwise"},
    {"PCA with missing data", "PCA"},
    {", incremental", ", incr."},
    {", from scratch", ", scratch"},
}};

}  // namespace

std::string short_name(const std::string& label) {
  std::string text = label;
  for (const auto& [name, shorter] : kShort)
    if (const std::size_t at = text.find(name); at != std::string::npos)
      text.replace(at, name.size(), shorter);
  return text;
}

std::string label_in(const Theme& theme, const std::string& label) {
  return theme.width_pt < kNarrow * theme.font_pt ? short_name(label) : label;
}

}  // namespace mapproof
