/// What a field of a result holds: how it stands in summary.json, and in which unit people read it.
#pragma once

#include "pipelines/base/common/constants.h"

namespace pipelines {

/// The value of a field in summary.json.
enum class Shape {
  text,
  number,    ///< null: there is none, it is not known, or infinite
  figure,    ///< {"value", "unit", ...}, a number with its SI unit beside it; null: as a number
  own_unit,  ///< a number in the unit that its row has beside it
  unit,      ///< of such numbers: in summary.json that of SI, elsewhere the one that people read
  flag,      ///< true, false; in CSV 1, 0
  position,  ///< [x, y, z]
  tensor,    ///< [xx, yy, zz, xy, yz, xz]
  moment,    ///< {"turn", "drive_angle_rad"}
  range,     ///< [least, most], an end without a value null; null: not known
  shares,    ///< a number of each effect, block ... by its name
  structure  ///< any other; it stands in summary.json alone
};

/// SI values stand in summary.json, one unit of `one` each in what people read.
struct Quantity {
  Shape shape;
  const char* suffix;  ///< end of the key in summary.json, "_Pa"
  const char* unit;    ///< unit that people read; empty: none
  double one;          ///< size of one such unit in the unit of summary.json
  const char* format;  ///< fmt's format of the number that people read
};

/// The same as {"value", "unit"} in summary.json (summary::figure), its key without a unit.
constexpr Quantity as_figure(Quantity number) {
  number.shape = Shape::figure;
  number.suffix = "";
  return number;
}

namespace quantities {

inline constexpr Quantity text{Shape::text, "", "", 1, ""};
inline constexpr Quantity flag{Shape::flag, "", "", 1, ""};
inline constexpr Quantity structure{Shape::structure, "", "", 1, ""};
inline constexpr Quantity own_unit{Shape::own_unit, "", "", 1, "{:.5g}"};
inline constexpr Quantity unit{Shape::unit, "", "", 1, ""};
inline constexpr Quantity count{Shape::number, "", "", 1, "{:.0f}"};
inline constexpr Quantity ratio{Shape::number, "", "", 1, "{:.2f}"};
inline constexpr Quantity percent{Shape::number, "", "%", 0.01, "{:.1f}"};
inline constexpr Quantity percentages{Shape::shares, "", "%", 0.01, "{:.0f}"};
inline constexpr Quantity stress{Shape::number, "_Pa", "MPa", 1e6, "{:.1f}"};
inline constexpr Quantity stress_tensor{Shape::tensor, "_Pa", "MPa", 1e6, "{:.1f}"};
inline constexpr Quantity length{Shape::number, "_m", "mm", 1e-3, "{:.1f}"};
inline constexpr Quantity position{Shape::position, "_m", "mm", 1e-3, "{:.1f}"};
inline constexpr Quantity volume{Shape::number, "_m3", "mm3", 1e-9, "{:.3g}"};
inline constexpr Quantity angle{Shape::number, "_rad", "deg", pi / 180, "{:.0f}"};
inline constexpr Quantity moment{Shape::moment, "", "deg", pi / 180, "{:.0f}"};
inline constexpr Quantity related_gradient{Shape::number, "_1_m", "1/mm", 1e3, "{:.3g}"};
inline constexpr Quantity time{Shape::number, "_s", "s", 1, "{:.4g}"};
inline constexpr Quantity hours{Shape::number, "_h", "h", 1, "{:.3g}"};
inline constexpr Quantity range_of_hours{Shape::range, "_h", "h", 1, "{:.3g}"};
inline constexpr Quantity per_hour{Shape::number, "", "1/h", 1, "{:.3g}"};
inline constexpr Quantity per_hour_by_name{Shape::shares, "", "1/h", 1, "{:.3g}"};
inline constexpr Quantity force{Shape::number, "_N", "N", 1, "{:.5g}"};
inline constexpr Quantity frequency{Shape::number, "", "Hz", 1, "{:.5g}"};
inline constexpr Quantity turning_frequency{Shape::number, "_rad_s", "Hz", 2 * pi, "{:.6g}"};
inline constexpr Quantity turning_speed{Shape::number, "_rad_s", "rpm", pi / 30, "{:.5g}"};
inline constexpr Quantity angular_speed{Shape::number, "_rad_s", "rad/s", 1, "{:.5g}"};
inline constexpr Quantity torque{Shape::number, "_Nm", "N m", 1, "{:.5g}"};

}  // namespace quantities
}  // namespace pipelines
