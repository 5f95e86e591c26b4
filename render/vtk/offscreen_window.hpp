#pragma once

#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>

namespace mapproof {

/// A window without a screen, with a current context (see GlContext).
/// @throws std::runtime_error, in one line, if no context can be made.
vtkSmartPointer<vtkRenderWindow> make_window();

}  // namespace mapproof
