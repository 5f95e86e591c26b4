#pragma once

#include <vector>

#include "render/base/geometry.hpp"
#include "render/plot/figure.hpp"
#include "render/scene/projection.hpp"
#include "render/scene/scene.hpp"

namespace mapproof {

/// The axes of a view as they stand in its picture: lines, ticks and texts that cover each other
/// nowhere. Ticks become fewer until their labels are apart; where two axes meet, the label of the
/// second is left out if it has no room.
class RuleLayers {
 public:
  /// @param em  Height of a tick's label in the units of the picture (see Projection).
  RuleLayers(const Projection& project, double em) : project_(project), em_(em) {}

  /// The layers of one more axis; none if it is seen end on or from behind the eye.
  std::vector<Layer> add(const Rule& rule);

 private:
  struct Text {
    Point at;
    std::string text;
    Box box;
  };

  Text text_at(Point at, Point outward, double ems, Align align, const std::string& text) const;
  std::vector<Text> tick_labels(const Rule& rule, Point outward, Align align,
                                std::vector<Point>& feet) const;
  bool is_free(const Box& box) const;

  const Projection& project_;
  double em_;
  std::vector<Box> taken_;
};

}  // namespace mapproof
