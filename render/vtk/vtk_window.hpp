#pragma once

#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>

namespace mapproof {

/// A window without a screen, its context made: VTK's own on OSMesa where it has one (built with
/// OSMesa, or 9.4 and newer), else ours.
/// @throws std::runtime_error if there is no context.
vtkSmartPointer<vtkRenderWindow> make_window();

}  // namespace mapproof
