/// Pictures of a field on a body, for the report and the result directory. Needs no display.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pipelines {

/// A place to look at, in words.
struct PictureMark {
  std::array<double, 3> at_m{};
  std::string text;  ///< what it is and how much, in lines
};

struct PictureOptions {
  int width = 1600, height = 1000;  ///< pixels
  double scale = 1;                 ///< from the field's unit to the one shown: 1e-6 for Pa to MPa
  /// Range of the colours, in the unit shown; else from 0 (or below) to the peak.
  std::optional<std::array<double, 2>> range;
  std::string excluded;  ///< field that is not 0 where the picture's has no converged value: hatched there
  std::string beyond;    ///< field of the distance from there, negative within; empty: half way between nodes
  std::string excluded_is;          ///< what is hatched, for the legend, in lines
  std::optional<PictureMark> mark;  ///< ringed and named instead of the field's peak
  std::vector<PictureMark> notes;   ///< written beside their places, whether these are seen or hidden
  std::string notes_are;            ///< what they say, for the legend
  bool edges = true;                ///< the edges of the cells, as curved as they are
  int subdivisions = 3;  ///< each face is drawn as 4^n pieces, 0 to 5; as fewer where faces are many
  double detail = 0.35;  ///< width of the detail over the largest extent of the body
};

/// Draws the surface of a VTU file coloured by a field at its nodes: the whole body, and below it (long
/// bodies) or beside it the neighbourhood of the peak, or of the place marked. Both look at the side where
/// that is. A body whose peak is inside is cut open; what stands between the eye and the neighbourhood of the
/// peak is cut away.
/// @param field  one component
/// @param title  title of the picture
/// @param unit   as shown beside the colours ("MPa")
/// @param png    written whole or not at all
/// @return false if this machine cannot draw (no EGL): nothing is written
/// @throws FileError naming the file if the VTU cannot be read, has no such field, or the picture
/// cannot be written
bool write_picture(const std::filesystem::path& vtu, const std::string& field, const std::string& title,
                   const std::string& unit, const std::filesystem::path& png,
                   const PictureOptions& options = {});

}  // namespace pipelines
