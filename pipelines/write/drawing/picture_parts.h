/// What all pictures are made of: words, cameras, the axes' triad, the file. Pointers that are returned
/// belong to the window or renderer they were added to.
#pragma once

#include <filesystem>
#include <string>

#include "pipelines/write/drawing/picture_surface.h"

class vtkRenderWindow;
class vtkRenderer;
class vtkTextActor;
class vtkTextProperty;

namespace pipelines {

/// Dark grey sans serif of this size in pixels.
void plain(vtkTextProperty* text, int size);

/// @param x, y  of the lower left corner, in shares of the viewport
vtkTextActor* add_text(vtkRenderer* renderer, const std::string& words, int size, double x, double y);

/// Thin lines that lie on a surface and stay in front of it.
void add_lines(vtkRenderer* renderer, vtkPolyData* lines, double grey, double opacity);

/// A white part of the window; places in shares of it.
vtkRenderer* add_renderer(vtkRenderWindow* window, double left, double bottom, double right, double top);

/// A parallel camera that shows the frame and what lies up to its half depth in front of its centre, and all
/// behind.
void look(vtkRenderer* renderer, const View& view, const Frame& frame, double width_over_height,
          double all_depth);

/// The directions of x, y and z as the camera of `like` sees them.
void add_triad(vtkRenderer* renderer, vtkRenderer* like);

/// Draws the window into a file that is written whole or not at all.
/// @throws FileError naming the file if it cannot be written
void write_png(vtkRenderWindow* window, const std::filesystem::path& png);

}  // namespace pipelines
