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

/// Whether it is one of IIW's classes of direct stress in steel, 36 to 160 MPa.
bool is_fat_class(double fat_Pa);

/// "FAT 36, 40, ... 160", for messages.
std::string fat_classes_text();

/// "FAT 90", also without the blank or in small letters, in Pa; nothing: the text is none of such.
std::optional<double> fat_of_text(const std::string& text);

}  // namespace pipelines
