#include "meshes/checks/affordable.h"

#include <unistd.h>

#include <sstream>

#include "meshes/values/refused.h"

namespace meshes {

double machine_memory_bytes() {
  return double(::sysconf(_SC_PHYS_PAGES)) * double(::sysconf(_SC_PAGE_SIZE));
}

void require_affordable(double n_cells, double bytes_per_cell, const std::string& control,
                        const std::string& remedy) {
  const double wanted = n_cells * bytes_per_cell, there = machine_memory_bytes();
  if (wanted <= there) return;
  std::ostringstream text;
  text.precision(2);
  text << "asks for about " << n_cells << " cells, which take " << 1e-9 * wanted
       << " GB of memory before anything is solved; this machine has " << 1e-9 * there << " GB: " << remedy;
  throw TooManyCells(control, text.str());
}

}  // namespace meshes
