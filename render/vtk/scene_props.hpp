#pragma once

#include <vtkProp.h>
#include <vtkSmartPointer.h>

#include <vector>

#include "render/scene/baked_light.hpp"
#include "render/scene/scene.hpp"
#include "render/scene/scene_request.hpp"

namespace mapproof {

using Props = std::vector<vtkSmartPointer<vtkProp>>;

/// What the colours of a part depend on.
struct Paint {
  const SceneRequest& request;
  Point3 eye;        ///< Where the view is seen from.
  KeptLight* light;  ///< Computed light, for what is lit and opaque; null: VTK's lights.
  std::size_t part = 0;  ///< Index of the part in its scene.
};

/// The VTK props of a part, in the colours of the request; none for an empty part.
Props props_of(const Part& part, const Paint& paint);

/// The shadow on the floor, to be drawn over all that is flat and opaque.
vtkSmartPointer<vtkProp> shadow_prop(KeptLight& light, Colour background);

}  // namespace mapproof
