#pragma once

#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>

namespace mapproof {

/// A window without a screen, its context (see GlContext) made.
/// @throws std::runtime_error, in one line, if there is no context.
vtkSmartPointer<vtkRenderWindow> make_window();

}  // namespace mapproof
