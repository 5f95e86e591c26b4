#pragma once

#include <vector>

#include <vtkProp.h>
#include <vtkSmartPointer.h>

#include "render/scene/scene.hpp"
#include "render/scene/scene_request.hpp"

namespace mapproof {

/// The VTK props of a part, in the colours of the request; none for an empty part.
std::vector<vtkSmartPointer<vtkProp>> props_of(const Part& part, const SceneRequest& request);

}  // namespace mapproof
