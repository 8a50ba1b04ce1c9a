/// Kinds of cases: what is damaged, what is done with it, and how that has to end.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tests/fuzz/mutator.h"

namespace fuzz {

struct Samples;

/// How one case has ended.
struct Verdict {
  bool accepted = false;
  std::string fault;  ///< what must not be; empty: nothing
};

/// Where a case works.
struct Place {
  std::filesystem::path directory;  ///< empty at the beginning of each case; kept if it ends badly
  std::filesystem::path outside;    ///< for what is not of the case, like a cache
  const Samples& samples;
  std::filesystem::path program;  ///< millstress
  double seconds_of_core;         ///< that a program may take

  std::filesystem::path operator/(const std::string& name) const { return directory / name; }
};

struct Kind {
  std::string name;
  int per_thousand = 0;  ///< of the cases of a draw of all kinds
  std::function<Verdict(Mutator&, const Place&)> run;
};

/// Their shares sum up to 1000.
const std::vector<Kind>& kinds();

Verdict scene_case(Mutator&, const Place&);          ///< scenes of every machine: reader, load stage, summary
Verdict name_case(Mutator&, const Place&);           ///< the same with names that files find hard to carry
Verdict table_case(Mutator&, const Place&);          ///< CSV files of loads
Verdict step_text_case(Mutator&, const Place&);      ///< the check before OpenCASCADE
Verdict msh_text_case(Mutator&, const Place&);       ///< the check before gmsh
Verdict step_case(Mutator&, const Place&);           ///< the whole import
Verdict msh_case(Mutator&, const Place&);            ///< the same
Verdict responses_case(Mutator&, const Place&);      ///< unit_responses.h5
Verdict results_case(Mutator&, const Place&);        ///< a result directory, looked at and reported
Verdict program_case(Mutator&, const Place&);        ///< the program on a damaged scene or table
Verdict program_again_case(Mutator&, const Place&);  ///< the program on damaged results of an earlier run

}  // namespace fuzz
