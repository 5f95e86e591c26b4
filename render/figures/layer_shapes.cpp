#include "render/figures/layer_shapes.hpp"

#include <cmath>

#include "core/base/not_finite.hpp"

namespace mapproof {

void end_outline(Area& area) { add_corner(area, {kNaN, kNaN}); }

void add_box(Area& area, const Range& x, const Range& y) {
  add_corner(area, {x.low, y.low});
  add_corner(area, {x.high, y.low});
  add_corner(area, {x.high, y.high});
  add_corner(area, {x.low, y.high});
  end_outline(area);
}

void add_disc(Ellipses& discs, Point centre, double radius) {
  discs.x.push_back(centre.x);
  discs.y.push_back(centre.y);
  discs.a.push_back(radius);
  discs.b.push_back(radius);
  discs.rotation_rad.push_back(0.0);
}

void add_label(PointLabels& labels, Point at, const std::string& text) {
  labels.x.push_back(at.x);
  labels.y.push_back(at.y);
  labels.text.push_back(text);
}

void add_text(Texts& texts, Point at, const std::string& text) {
  texts.x.push_back(at.x);
  texts.y.push_back(at.y);
  texts.text.push_back(text);
}

}  // namespace mapproof
