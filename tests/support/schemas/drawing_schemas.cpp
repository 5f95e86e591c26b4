#include "tests/support/schemas/drawing_schemas.hpp"

#include "core/json/json_text.hpp"
#include "render/plot/figure_fields.hpp"
#include "render/scene/scene_json.hpp"
#include "render/style/figure_style_fields.hpp"
#include "tests/support/schemas/record_schema.hpp"

namespace mapproof::test {

std::map<std::string, std::string> drawing_schemas() {
  return {{"figure.schema.json", json_text(json_schema<Figure>())},
          {"scene.schema.json", json_text(json_schema<Scene>())},
          {"style.schema.json", json_text(json_schema<FigureStyle>())}};
}

}  // namespace mapproof::test
