#include "tests/cases/program/browser.h"

namespace cases {

int start_browser(const fs::path& directory, const std::string& arguments) {
  const auto command = "cd '" + directory.string() + "' && timeout 300 chromium --headless --no-sandbox " +
                       "--use-angle=swiftshader --enable-unsafe-swiftshader --hide-scrollbars " +
                       "--user-data-dir=browser --window-size=1280,800 " + arguments +
                       " > browsed 2> browser.log";
  return std::system(command.c_str());
}

std::string browse(const fs::path& directory, const std::string& arguments) {
  EXPECT_EQ(start_browser(directory, arguments), 0) << results_test::bytes(directory / "browser.log");
  return results_test::bytes(directory / "browsed");
}

std::string elements_after(const fs::path& directory, const std::string& page, int seconds) {
  return browse(directory,
                "--virtual-time-budget=" + std::to_string(1000 * seconds) + " --dump-dom '" + page + "'");
}

bool has_browser(const fs::path& directory) {
  return start_browser(directory, "--dump-dom about:blank") == 0;
}

}  // namespace cases
