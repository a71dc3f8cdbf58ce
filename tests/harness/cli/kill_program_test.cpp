// The built program, killed at random moments and run again, against a run that nothing interrupted.
#include "harness/cli/commands.h"
#include "harness/table/csv.h"
#include "harness/table/files.h"
#include "tests/harness/support/child_process.h"
#include "tests/temporary_folder.h"

#include <chrono>
#include <cstdlib>
#include <random>

#include <gtest/gtest.h>

namespace hybray {
namespace {

constexpr int kKills = 52;

// About a hundred points of a few milliseconds each, with pictures.
const char* const kConfig = R"({"experiment": "ssrm",
  "parameters": {"scene": "sphere", "picture": true},
  "sweep": {"resolution": ["16x12", "24x18", "32x24"], "derivatives": ["plane", "difference"],
            "footprint_factor": [0.5, 1, 2, 4]}})";

class KillProgramTest : public ::testing::Test {
 protected:
  KillProgramTest() { folder_.write("k.json", kConfig); }

  test::Outcome hybray(const std::string& output, test::ProcessOptions options = {}) {
    options.folder = folder_.path().string();
    options.environment = {{"HYBRAY_ROOT", HYBRAY_PROJECT_DIR}};
    return test::run_process({HYBRAY_PROGRAM, "run", "k.json", "--no-timing", "-o", output}, options);
  }

  size_t whole_rows(const std::string& file) const {
    const std::filesystem::path path = folder_ / file;
    return std::filesystem::exists(path) ? parse_whole_rows(read_file(path)).rows.size() : 0;
  }

  // Without times every column must be the same, and every picture.
  void expect_as_uninterrupted() {
    ASSERT_EQ(test::content_of(folder_ / "out/k.csv"), test::content_of(folder_ / "whole/k.csv"));
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "whole/pictures")) {
      ASSERT_EQ(test::content_of(folder_ / "out/pictures" / entry.path().filename()),
                test::content_of(entry.path()));
    }
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out/k.csv.partial"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out/manifest.json.partial"));
  }

  const test::TemporaryFolder folder_;
};

TEST_F(KillProgramTest, EndsInTheMetricsOfAnUninterruptedRunHoweverOftenItIsKilled) {
  const char* given = std::getenv("HYBRAY_TEST_SEED");
  const unsigned seed =
      given ? static_cast<unsigned>(std::strtoul(given, nullptr, 10)) : std::random_device()();
  std::printf("HYBRAY_TEST_SEED=%u\n", seed);
  std::mt19937 random(seed);

  const auto start = std::chrono::steady_clock::now();
  ASSERT_EQ(hybray("whole").exit_code, kOk);
  const auto whole_ms = static_cast<int>(
      std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() - start)
          .count());

  int kills = 0, kills_with_rows = 0, completed = 0;
  size_t rows = 0;  // that stood whole in the growing table after the last kill
  while (kills < kKills || completed == 0) {
    test::ProcessOptions options;
    options.signal = SIGKILL;
    // At any moment from the start, or soon after a finished point: start-up takes most of a run.
    const bool from_start = random() % 2 == 0;
    if (!from_start) options.interrupt_when = "k 1/";
    const auto longest = static_cast<unsigned>(whole_ms / (from_start ? 1 : 8));
    options.interrupt_after_ms = static_cast<int>(random() % (longest + 1));
    if (kills >= kKills) options = {};
    const test::Outcome outcome = hybray("out", options);
    if (outcome.exit_code == -SIGKILL) {
      ++kills;
      const size_t now = std::max(whole_rows("out/k.csv.partial"), whole_rows("out/k.csv"));
      ASSERT_GE(now, rows) << "a finished row was lost";
      rows = now;
      kills_with_rows += rows > 0;
      continue;
    }
    ASSERT_EQ(outcome.exit_code, kOk) << outcome.err;
    ASSERT_NO_FATAL_FAILURE(expect_as_uninterrupted());
    ++completed;
    rows = 0;
    std::filesystem::remove_all(folder_ / "out");
  }
  std::printf("%d kills, %d of them with rows to take over; %d runs came to their end\n", kills,
              kills_with_rows, completed);
  EXPECT_GE(kills_with_rows, kKills / 4) << "the kills came too early to test anything";
}

}  // namespace
}  // namespace hybray
