/// The table of machines has every machine at the place of its alternative, under the name that its scenes
/// and its load histories have.
#include <gtest/gtest.h>

#include "pipelines/scene/whole/body_reader.h"
#include "pipelines/scene/whole/machine_kind.h"
#include "tests/unit/pipelines/examples/plain_body.h"

namespace {

using pipelines::Machine;

// Two rows that are swapped would ask one machine for another's parameters.
TEST(MachineKinds, MachinesLeadToTheirKind) {
  ASSERT_EQ(pipelines::machine_kinds().size(), std::variant_size_v<Machine>);
  EXPECT_EQ(pipelines::kind_of(Machine(kinetics::VibratoryMill())).type(), "vibratory_mill");
  EXPECT_EQ(pipelines::kind_of(Machine(kinetics::PlanetaryMill())).type(), "planetary_mill");
  EXPECT_EQ(pipelines::kind_of(Machine(kinetics::DriveTrain())).type(), "drive_train");
  EXPECT_EQ(pipelines::kind_of(Machine(kinetics::LoadTable())).type(), "load_table");
}

// What a history is of is looked up by the name that kinetics gives it.
TEST(MachineKinds, HistoriesHaveTheNameOfTheirKind) {
  for (const char* name : {"vibratory_mill", "planetary_mill", "drive_train", "load_table"}) {
    const pipelines::Scene scene = plain::scene(name);
    const auto& kind = pipelines::kind_of(scene.machine);
    const auto history = kind.rehearse(scene);
    ASSERT_TRUE(history) << name;
    EXPECT_EQ(history->machine, kind.type());
    EXPECT_EQ(pipelines::find_machine_kind(history->machine), &kind);
    EXPECT_EQ(pipelines::has_samples(*history), std::string(name) == "load_table");
  }
  EXPECT_EQ(pipelines::find_machine_kind("mill"), nullptr);
}

TEST(MachineKinds, EveryBodyHasAMachine) {
  for (const auto* body : pipelines::body_readers())
    EXPECT_NE(pipelines::find_machine_kind(body->machine_type()), nullptr) << body->machine_type();
}

}  // namespace
