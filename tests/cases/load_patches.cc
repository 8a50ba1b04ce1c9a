#include "tests/cases/program.h"
#include "tests/cases/stepped_shaft.h"

using namespace cases;

namespace {

/// The stepped shaft with that contact on all its seats.
std::string with_contact(const std::string& half_angle) {
  std::string text = stepped_shaft();
  for (const std::string port : {"left", "gear", "right"})
    text += "[shaft.pressure." + port + "]\nhalf_angle = \"" + half_angle + " deg\"\nharmonics = 4\n";
  return text;
}

nlohmann::json peak_of(const fs::path& directory, const std::string& half_angle) {
  write(directory / (half_angle + ".toml"), with_contact(half_angle));
  const auto run = millstress(directory, "run " + half_angle + ".toml -o " + half_angle);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return run.exit_code == 0 ? summary(directory / half_angle)["bodies"]["shaft"]["peak_von_mises"]
                            : nlohmann::json();
}

}  // namespace

// The entry is one superposition; runs with the other contacts in the scene solve everything anew. A pattern
// of 80 degrees has all harmonics, so nothing is estimated: both agree to the rounding of 1e5 unknowns.
TEST(LoadPatches, EntryIsTheDifferenceOfRunsWithOtherContacts) {
  const results_test::Directory directory;
  const auto here = peak_of(directory.path, "80"), narrow = peak_of(directory.path, "60"),
             wide = peak_of(directory.path, "100");
  ASSERT_FALSE(here.is_null() || narrow.is_null() || wide.is_null());
  const double peak = here["value"].get<double>();
  const double wanted =
      std::max(std::abs(narrow["value"].get<double>() - peak), std::abs(wide["value"].get<double>() - peak));
  EXPECT_GT(wanted, 1e-4 * peak);  // else the comparison shows nothing
  const double entry = here["error"]["load_patches"].get<double>();
  EXPECT_NEAR(entry, wanted, 1e-8 * peak);
  EXPECT_EQ(here["error"]["methods"]["load_patches"].get<std::string>(),
            "seat pressure over half angles 25 % narrower and wider");
  // A model error: no finer mesh mends it.
  EXPECT_NEAR(here["error"]["total"].get<double>() - here["error"]["numerical"].get<double>(), entry,
              1e-12 * peak);
}
