/// What opens a run's bodies in ParaView.
#pragma once

#include <string>

namespace pipelines {

/// Text of paraview_view.py beside this file, which reads the directory of results that it lies in.
const std::string& paraview_script();

}  // namespace pipelines
