#pragma once

#include <vector>

#include <vtkProp.h>
#include <vtkSmartPointer.h>

#include "render/scene/scene.hpp"
#include "render/scene/scene_request.hpp"

namespace mapproof {

/// What VTK draws for a part, in the request's colours; nothing for an empty one.
std::vector<vtkSmartPointer<vtkProp>> props_of(const Part& part, const SceneRequest& request);

}  // namespace mapproof
