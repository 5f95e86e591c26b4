#pragma once

#include "render/plot/figure.hpp"
#include "render/scene/scene.hpp"
#include "render/theme/theme.hpp"

namespace mapproof {

/// What stands over and around a scene's images: title, notes, legend, axes with ticks, labels
/// where they cover no solid; one panel per view, each with a ImageLayer whose source is the view.
/// The panels' axes are those of Projection.
/// @param theme  The distance of ticks' labels from their axis follows from its type size.
/// @throws InvalidInput if the scene cannot be drawn (see `problem`).
Figure scene_figure(const Scene& scene, const Theme& theme);

}  // namespace mapproof
