// The cache of references as the program uses it: from run to run, damaged, killed, by two at once.
#include "harness/cli/commands.h"
#include "harness/table/csv.h"
#include "tests/harness/support/child_process.h"
#include "tests/temporary_folder.h"

#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace hybray {
namespace {

namespace fs = std::filesystem;

class CacheProgramTest : public ::testing::Test {
 protected:
  CacheProgramTest() {
    fs::create_directories(folder_ / "root/scenes");
    folder_.write("ball.json", R"({"experiment": "caustics", "parameters": {"scene": "glass_ball",
        "camera": "front", "resolution": "96x54", "map_resolution": 64, "frames": 2,
        "reference_paths": 60000, "reference_batches": 4}})");
  }

  test::Outcome execute(const std::vector<std::string>& command,
                        std::map<std::string, std::string> more = {}) {
    more.insert({{"HYBRAY_ROOT", (folder_ / "root").string()},
                 {"HYBRAY_CACHE_DIR", (folder_ / "cache").string()},
                 {"HYBRAY_CACHE_BYTES", "1GB"}});
    return test::run_process(command, {folder_.path().string(), more, ""});
  }
  test::Outcome hybray(std::vector<std::string> arguments, std::map<std::string, std::string> more = {}) {
    arguments.insert(arguments.begin(), HYBRAY_PROGRAM);
    return execute(arguments, std::move(more));
  }
  test::Outcome run(const std::string& output, std::vector<std::string> more = {},
                    std::map<std::string, std::string> environment = {}) {
    std::vector<std::string> arguments{"run", "ball.json", "--no-timing", "-q", "-o", output};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return hybray(arguments, std::move(environment));
  }
  std::string table(const std::string& output) { return test::content_of(folder_ / output / "ball.csv"); }
  nlohmann::json references(const std::string& output) {
    return nlohmann::json::parse(test::content_of(folder_ / output / "manifest.json"))["references"];
  }
  std::vector<fs::path> parts() {
    std::vector<fs::path> found;
    if (!fs::exists(folder_ / "cache")) return found;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / "cache"))
      if (entry.path().extension() == ".part") found.push_back(entry.path());
    std::sort(found.begin(), found.end());
    return found;
  }

  const test::TemporaryFolder folder_;
};

TEST_F(CacheProgramTest, AReferenceServesLaterRunsAndOtherConfigsAndTheTablesAreTheSameBytes) {
  ASSERT_EQ(run("none", {"--no-cache"}).exit_code, kOk);
  EXPECT_FALSE(fs::exists(folder_ / "cache"));
  EXPECT_EQ(references("none")["cache_enabled"], false);
  ASSERT_EQ(run("first").exit_code, kOk);
  EXPECT_EQ(references("first")["computed"], 1);
  EXPECT_EQ(references("first")["batches_computed"], 4);
  ASSERT_EQ(run("second").exit_code, kOk);
  EXPECT_EQ(references("second")["reused"], 1);
  EXPECT_EQ(references("second")["batches_computed"], 0);
  EXPECT_EQ(table("none"), table("first"));
  EXPECT_EQ(table("none"), table("second"));
  // Another config that needs the same image, and one batch more of it.
  folder_.write("depth.json", R"({"experiment": "caustics", "parameters": {"scene": "glass_ball",
      "camera": "front", "resolution": "96x54", "map_resolution": 32, "frames": 2,
      "reference_paths": 60000, "reference_batches": 5}, "sweep": {"mirror_depth": [1, 2]}})");
  ASSERT_EQ(hybray({"run", "depth.json", "--no-timing", "-q", "-o", "depth"}).exit_code, kOk);
  EXPECT_EQ(references("depth")["continued"], 1);
  EXPECT_EQ(references("depth")["batches_computed"], 1);
  EXPECT_EQ(references("depth")["batches_reused"], 4);
}

TEST_F(CacheProgramTest, WhatChangesTheImageIsAnotherReference) {
  ASSERT_EQ(run("out").exit_code, kOk);
  for (const char* change :
       {"seed=2", "near=0.06", "resolution=95x54", "camera=through", "reference_paths=60001",
        "reference_radius=1.6", "mixed=none", "lights_invisible=0"}) {
    const test::Outcome outcome = run("out", {"--set", change});
    ASSERT_EQ(outcome.exit_code, kOk) << outcome.err;
    EXPECT_EQ(references("out")["reused"], 0) << change;
    EXPECT_EQ(references("out")["continued"], 0) << change;
  }
  // The scene's content counts, not only its name.
  folder_.write("root/scenes/lamp.json", R"({"source": {"generator": "glass_ball"}})");
  ASSERT_EQ(run("out", {"--set", "scene=lamp"}).exit_code, kOk);
  folder_.write("root/scenes/lamp.json",
                R"({"source": {"generator": "glass_ball"}, "materials": {"glass": {"ior": 1.51}}})");
  ASSERT_EQ(run("out", {"--set", "scene=lamp"}).exit_code, kOk);
  EXPECT_EQ(references("out")["computed"], 1);
}

TEST_F(CacheProgramTest, DamageIsAWarningAndTheTableIsTheSame) {
  ASSERT_EQ(run("first").exit_code, kOk);
  ASSERT_EQ(parts().size(), 4u);
  fs::resize_file(parts()[2], 1000);
  EXPECT_EQ(hybray({"cache", "check"}).exit_code, kGateFailed);
  EXPECT_EQ(parts().size(), 3u);
  fs::resize_file(parts()[1], 1000);
  const test::Outcome outcome = run("second");
  EXPECT_EQ(outcome.exit_code, kOk);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_TRUE(outcome.err.starts_with("hybray: warning: the cached reference ")) << outcome.err;
  EXPECT_EQ(table("first"), table("second"));
  EXPECT_EQ(references("second")["batches_computed"], 2);
  EXPECT_EQ(hybray({"cache", "check"}).exit_code, kOk);
}

TEST_F(CacheProgramTest, ACacheThatCannotBeWrittenIsOneWarningAndTheRunGoesOn) {
  folder_.write("file", "");
  folder_.write("other.json", test::content_of(folder_ / "ball.json"));
  const test::Outcome outcome = hybray(
      {"run", "ball.json", "other.json", "--no-timing", "-q", "-o", "out", "--cache-dir", "file/cache"});
  EXPECT_EQ(outcome.exit_code, kOk);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_TRUE(outcome.err.starts_with("hybray: warning: references cannot be kept in file/cache"))
      << outcome.err;
}

TEST_F(CacheProgramTest, KilledAtAnyMomentItNeverLeavesAWrongAnswer) {
  ASSERT_EQ(run("truth", {"--no-cache"}).exit_code, kOk);
  size_t most = 0;
  for (int kill = 0; kill < 20; ++kill) {
    // A different moment each time, through the whole of a run.
    const double seconds = 0.05 + 0.05 * kill;
    execute({"/usr/bin/timeout", "-s", "KILL", std::to_string(seconds), HYBRAY_PROGRAM, "run", "ball.json",
             "--no-timing", "-q", "-o", "killed", "--set", "reference_batches=64"});
    most = std::max(most, parts().size());
    if (kill % 4 != 3) continue;
    const test::Outcome outcome = run("after" + std::to_string(kill));
    ASSERT_EQ(outcome.exit_code, kOk) << outcome.err;
    EXPECT_EQ(outcome.err, "") << "no file is damaged";
    EXPECT_EQ(table("after" + std::to_string(kill)), table("truth"));
  }
  EXPECT_GT(most, 4u) << "some were killed with batches on disk";
  EXPECT_EQ(hybray({"cache", "check"}).exit_code, kOk);
}

TEST_F(CacheProgramTest, TwoRunsAtOnceShareTheWorkAndAgree) {
  ASSERT_EQ(run("truth", {"--no-cache"}).exit_code, kOk);
  const std::string program = std::string("'") + HYBRAY_PROGRAM + "' run ball.json --no-timing -q -o ";
  const test::Outcome both =
      execute({"/bin/sh", "-c", program + "a & p=$!; " + program + "b || exit 1; wait $p"});
  ASSERT_EQ(both.exit_code, kOk) << both.err;
  EXPECT_EQ(both.err, "");
  EXPECT_EQ(table("a"), table("truth"));
  EXPECT_EQ(table("b"), table("truth"));
  EXPECT_EQ(references("a")["batches_computed"].get<int>() + references("b")["batches_computed"].get<int>(),
            4);
}

TEST_F(CacheProgramTest, ListsAndClearsWhatItHas) {
  EXPECT_EQ(hybray({"cache", "list"}).out, "");
  ASSERT_EQ(run("out").exit_code, kOk);
  ASSERT_EQ(run("out", {"--set", "reference_batches=2", "--set", "seed=2"}).exit_code, kOk);
  const std::string list = hybray({"cache", "list"}).out;
  EXPECT_EQ(std::count(list.begin(), list.end(), '\n'), 2) << list;
  EXPECT_NE(list.find("   4 batches  "), std::string::npos) << list;
  EXPECT_NE(list.find("   2 batches  "), std::string::npos) << list;
  EXPECT_NE(list.find("scene glass_ball "), std::string::npos) << list;
  const std::string oldest = list.substr(0, 16);
  const test::Outcome unknown = hybray({"cache", "clear", "xyz"});
  EXPECT_EQ(unknown.exit_code, kUsage);
  EXPECT_EQ(hybray({"cache", "clear", oldest.substr(0, 10)}).exit_code, kOk);
  EXPECT_EQ(parts().size(), 2u) << "the first run's are gone";
  EXPECT_EQ(hybray({"cache", "clear"}).exit_code, kOk);
  EXPECT_TRUE(parts().empty());
  EXPECT_EQ(hybray({"cache", "list"}).out, "");
}

TEST_F(CacheProgramTest, KeepsItsSizeAndRefusesOneThatIsNone) {
  // A batch of 96x54 pixels with mixed caustics is 187 kB: two references of two batches fit.
  for (const char* seed : {"seed=1", "seed=2", "seed=3"})
    ASSERT_EQ(run("out", {"--set", seed, "--set", "reference_batches=2", "--cache-bytes", "800KB"}).exit_code,
              kOk);
  EXPECT_EQ(parts().size(), 4u);
  ASSERT_EQ(run("out", {"--set", "seed=1"}, {{"HYBRAY_CACHE_BYTES", "0"}}).exit_code, kOk);
  EXPECT_EQ(references("out")["cache_enabled"], false);
  const test::Outcome bad = run("out", {}, {{"HYBRAY_CACHE_BYTES", "much"}});
  EXPECT_EQ(bad.exit_code, kUsage);
  EXPECT_NE(bad.err.find("--cache-bytes"), std::string::npos) << bad.err;
}

}  // namespace
}  // namespace hybray
