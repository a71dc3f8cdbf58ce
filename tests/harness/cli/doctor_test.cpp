#include "harness/cli/commands.h"
#include "tests/harness/support/child_process.h"
#include "tests/temporary_folder.h"

#include <gtest/gtest.h>

namespace hybray {
namespace {

test::Outcome doctor(const std::string& root) {
  test::ProcessOptions options;
  options.environment = {{"HYBRAY_ROOT", root}, {"HYBRAY_SCENE_PATH", ""}};
  return test::run_process({HYBRAY_PROGRAM, "doctor"}, options);
}

TEST(Doctor, NamesWhatTheProgramRunsOnAndTheScenesItFinds) {
  const test::Outcome outcome = doctor(HYBRAY_PROJECT_DIR);
  EXPECT_EQ(outcome.exit_code, kOk) << outcome.out;
  EXPECT_EQ(outcome.err, "");
  for (const char* word : {"Embree", "threads", "frequency", "memory", "results", "glass_ball", "python"})
    EXPECT_NE(outcome.out.find(word), std::string::npos) << word;
  // The sources of sponza are in no folder that this run was told of.
  EXPECT_NE(outcome.out.find("scripts/fetch_scenes.py"), std::string::npos);
}

TEST(Doctor, SaysWhichSceneIsBrokenAndFails) {
  test::TemporaryFolder folder;
  folder.write("scenes/torn.json", "{");
  folder.write("configs/none", "");
  const test::Outcome outcome = doctor(folder.path().string());
  EXPECT_EQ(outcome.exit_code, kUsage);
  EXPECT_NE(outcome.out.find("missing  scene          torn: "), std::string::npos) << outcome.out;
}

}  // namespace
}  // namespace hybray
