#include "tests/fuzz/kinds/cases.h"

namespace fuzz {

// Shares by what a case costs: imports start gmsh, programs load a hundred libraries.
const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {{"scene", 345, scene_case},
                                        {"name", 30, name_case},
                                        {"table", 130, table_case},
                                        {"step-text", 80, step_text_case},
                                        {"msh-text", 100, msh_text_case},
                                        {"step", 15, step_case},
                                        {"msh", 20, msh_case},
                                        {"responses", 170, responses_case},
                                        {"results", 70, results_case},
                                        {"program", 30, program_case},
                                        {"program-again", 10, program_again_case}};
  return all;
}

}  // namespace fuzz
