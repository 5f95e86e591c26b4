#include "render/plot/figure_json.hpp"

#include "core/base/errors.hpp"
#include "core/json/record_reader.hpp"
#include "core/json/record_writer.hpp"
#include "render/plot/figure_fields.hpp"

namespace mapproof {

std::string figure_to_json(const Figure& figure) { return to_json_text(figure); }

Figure figure_from_json(std::string_view text, const std::string& path) {
  Figure figure = from_json_text<Figure>(text, path);
  if (const std::string what = problem(figure); !what.empty()) throw IoError(path, "/" + what);
  return figure;
}

}  // namespace mapproof
