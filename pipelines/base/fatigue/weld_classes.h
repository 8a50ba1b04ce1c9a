/// FAT classes of weld toes in steel.
///
/// Source: Hobbacher, IIW-1823-07 (2008): classes of nominal stress 3.2, of structural hot-spot stress table
/// 3.3-1, exponents of wall thickness table 3.5-1. The constants of weld_fatigue.h are those of these tables.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace pipelines {

/// A weld detail with its class of structural hot-spot stress.
struct WeldType {
  const char* name;
  double fat_Pa;
  double thickness_exponent;  ///< n, as welded
};

/// "load-carrying" (fillet welds of cruciform, T and lap joints through which the load goes, 90),
/// "non-load-carrying" (transverse attachments, 100), "butt" (100), "full penetration" (K-butt welds of
/// cruciform and T joints, 100). The thickness exponent is 0.2 of "butt" and 0.3 of the others.
const std::vector<WeldType>& weld_types();

/// The type of that name; null: none.
const WeldType* weld_type(const std::string& name);

/// Thickness exponent of the type of that name; of another name 0.3, the largest of the table.
double thickness_exponent_of(const std::string& name);

/// Reference radii of effective notches in steel [m]: IIW's, and that of plates thinner than 5 mm.
constexpr double notch_radius_m = 1e-3, notch_radius_of_thin_plates_m = 0.05e-3;

/// The name of an effective notch where types of welds stand.
inline constexpr const char* effective_notch = "effective notch";

/// FAT class of effective notch stress in steel, principal stress: 225 MPa with the radius of 1 mm (Fricke,
/// IIW-Doc. XIII-2240r2-08, table 1), 630 MPa with 0.05 mm (Sonsino et al., Int. J. Fatigue 34 (2012) 2).
/// No thickness factor goes with it: the model has the size.
double fat_of_notch_Pa(double radius_m);

/// Whether it is one of IIW's classes of direct stress in steel, 36 to 160 MPa.
bool is_fat_class(double fat_Pa);

/// "FAT 36, 40, ... 160", for messages.
std::string fat_classes_text();

/// "FAT 90", also without the blank or in small letters, in Pa; nothing: the text is none of such.
std::optional<double> fat_of_text(const std::string& text);

}  // namespace pipelines
