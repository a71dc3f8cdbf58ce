// What a shell offers after sourcing the script, asked of a real shell.
#include "harness/cli/commands.h"
#include "tests/harness/support/child_process.h"
#include "tests/temporary_folder.h"

#include <algorithm>
#include <sstream>

#include <gtest/gtest.h>

namespace hybray {
namespace {

using Words = std::vector<std::string>;

class CompletionTest : public ::testing::Test {
 protected:
  // What bash offers for the last of `words`.
  Words offered(const Words& words) {
    std::string array;
    for (const std::string& word : words) array += "'" + word + "' ";
    const std::string script = "source <(\"$1\" completion bash); COMP_WORDS=(" + array +
                               "); COMP_CWORD=" + std::to_string(words.size() - 1) +
                               "; _hybray; printf '%s\\n' \"${COMPREPLY[@]}\"";
    test::ProcessOptions options;
    options.folder = folder_.path().string();
    options.environment = {{"HYBRAY_ROOT", HYBRAY_PROJECT_DIR}, {"HYBRAY_SCENE_PATH", ""}};
    const test::Outcome outcome =
        test::run_process({"/bin/bash", "-c", script, "bash", HYBRAY_PROGRAM}, options);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    Words lines;
    std::istringstream in(outcome.out);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
  }
  static bool has(const Words& words, const std::string& word) {
    return std::find(words.begin(), words.end(), word) != words.end();
  }

  test::TemporaryFolder folder_;
};

TEST_F(CompletionTest, CommandsAreOfferedByTheirBeginning) {
  EXPECT_EQ(offered({HYBRAY_PROGRAM, "desc"}), Words{"describe"});
  EXPECT_TRUE(has(offered({HYBRAY_PROGRAM, ""}), "run"));
  EXPECT_TRUE(has(offered({HYBRAY_PROGRAM, "scene", "re"}), "render"));
}

TEST_F(CompletionTest, OptionsAreThoseOfTheCommand) {
  EXPECT_TRUE(has(offered({HYBRAY_PROGRAM, "run", "--no"}), "--no-timing"));
  EXPECT_FALSE(has(offered({HYBRAY_PROGRAM, "describe", "--"}), "--no-timing"));
}

TEST_F(CompletionTest, ValuesAreFilesScenesAndExperiments) {
  folder_.write("my.json", "{}");
  EXPECT_EQ(offered({HYBRAY_PROGRAM, "run", "my"}), Words{"my.json"});
  EXPECT_EQ(offered({HYBRAY_PROGRAM, "describe", "caus"}), Words{"caustics"});
  EXPECT_EQ(offered({HYBRAY_PROGRAM, "scene", "info", "glass_b"}), Words{"glass_ball"});
}

TEST_F(CompletionTest, TheOtherShellsGetAScriptAndAnUnknownOneIsAMistake) {
  for (const char* shell : {"zsh", "fish"}) {
    const test::Outcome outcome = test::run_process({HYBRAY_PROGRAM, "completion", shell});
    EXPECT_EQ(outcome.exit_code, kOk);
    EXPECT_NE(outcome.out.find("--no-timing") == std::string::npos ? outcome.out.find("-l no-timing") : 0,
              std::string::npos);
  }
  EXPECT_EQ(test::run_process({HYBRAY_PROGRAM, "completion", "csh"}).exit_code, kUsage);
}

}  // namespace
}  // namespace hybray
