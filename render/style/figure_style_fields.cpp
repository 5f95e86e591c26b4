#include "render/style/figure_style_fields.hpp"

#include "core/base/files/files.hpp"
#include "core/json/record_reader.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kLargestStyle = std::size_t{1} << 20;  // Bytes.

}  // namespace

FigureStyle read_figure_style(const std::filesystem::path& file) {
  FigureStyle style = figure_style_from_json(read_file(file, kLargestStyle), file.string());
  if (!style.font.empty()) style.font = (file.parent_path() / style.font).string();
  return style;
}

FigureStyle figure_style_from_json(std::string_view text, const std::string& source) {
  return from_json_text<FigureStyle>(text, source);
}

}  // namespace mapproof
