/// The script beside the results, run by ParaView itself.
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <algorithm>
#include <cstdlib>
#include <regex>
#include <set>

#include "tests/cases/program/small_shaft.h"
#include "tests/unit/pipelines/examples/tools.h"

using namespace cases;

namespace {

int run_small_shaft(const results_test::Directory& directory) {
  write(directory / "shaft.toml", small_shaft({{"pull", "middle.fx", "300 N", 1}}));
  return millstress(directory.path, "run shaft.toml --set results.snapshots=2 --method solid -o out")
      .exit_code;
}

}  // namespace

// Debian's ParaView cannot be installed beside the VTK that the program is built with, so the names are
// looked up without it. Turns red: a field that is renamed in the files or in the script alone.
TEST(ParaView, FindsTheFieldsThatItsScriptNames) {
  const results_test::Directory directory;
  ASSERT_EQ(run_small_shaft(directory), 0);
  const auto script = results_test::bytes(directory / "out/paraview_view.py");
  const auto files = results_test::bytes(directory / "out/shaft/envelope.vtu") +
                     results_test::bytes(directory / "out/shaft/cycle_000.vtu");
  const std::regex field("\"([^\"\\n]* \\[[A-Za-z]+\\]|left_out)\"");
  std::set<std::string> names;
  for (std::sregex_iterator at(script.begin(), script.end(), field), end; at != end; ++at)
    names.insert((*at)[1]);
  EXPECT_GE(names.size(), 3U) << "stress, displacement, what is left out";
  for (const auto& name : names) EXPECT_NE(files.find("Name=\"" + name + '"'), std::string::npos) << name;
}

// Turns red: a name that ParaView does not know, a field that is not in the file, a body that is not found.
TEST(ParaView, ShowsARunByTheScriptBesideIt) {
  SKIP_WITHOUT("pvpython");
  SKIP_WITHOUT("xvfb-run");  // Debian's pvpython draws on an X display alone
  const results_test::Directory directory;
  ASSERT_EQ(run_small_shaft(directory), 0);
  const auto command = "cd '" + directory.path.string() +
                       "' && xvfb-run -a -s '-screen 0 1700x1100x24 -noreset' pvpython out/paraview_view.py "
                       "shown.png > told 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0) << results_test::bytes(directory / "told");
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName((directory / "shown.png").c_str());
  reader->Update();
  auto* image = reader->GetOutput();
  const int* size = image->GetDimensions();
  int n_coloured = 0;
  for (int y = 0; y < size[1]; ++y)
    for (int x = 0; x < size[0]; ++x) {
      const auto* rgb = static_cast<unsigned char*>(image->GetScalarPointer(x, y, 0));
      n_coloured += std::max({rgb[0], rgb[1], rgb[2]}) - std::min({rgb[0], rgb[1], rgb[2]}) > 60;
    }
  EXPECT_GT(n_coloured, size[0] * size[1] / 200) << "the shaft in its colours";
}
