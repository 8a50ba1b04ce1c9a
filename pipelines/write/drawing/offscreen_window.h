/// A VTK render window without a display.
#pragma once

#include <memory>

class vtkRenderWindow;

namespace pipelines {

/// A window on a surfaceless EGL context (Mesa). Debian's VTK has windows for X11 only, and without DISPLAY
/// these end the process; this one needs neither a display nor a graphics card.
/// @return null if the machine has no such context or one older than OpenGL 3.2, or this process too little
///   memory for its shaders' compiler, which would abort
std::shared_ptr<vtkRenderWindow> make_offscreen_window();

}  // namespace pipelines
