// Runs configs of the toy experiments inside the test, in a folder of its own.
#pragma once

#include "harness/sweep/run_sweep.h"
#include "tests/harness/support/toy_experiment.h"
#include "tests/temporary_folder.h"

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace hybray::test {

class ToyRunTest : public ::testing::Test {
 protected:
  struct How {
    size_t stop_after = std::numeric_limits<size_t>::max();  // points
    bool timing = true, fresh = false;
    std::optional<Shard> shard = {};
    std::string folder = "out";
    int threads = 1;
  };

  // Runs the config as c.json and notes what happened in the members below.
  RunResult run(const std::string& text, const How& how) {
    config_ = load_config(folder_.write("c.json", text), experiments_);
    SceneCatalog catalog([](const std::string&) { return SceneState::unknown; }, {});
    sweep_ = freeze(config_, catalog);
    RunRequest request{
        config_, sweep_, sweep_.points, {{}, {}, how.timing, how.threads, how.shard, how.fresh}};
    if (how.shard) request.points = points_of_shard(*config_.experiment, sweep_, *how.shard);
    std::filesystem::create_directories(folder_ / how.folder);
    Workspace workspace({{}, folder_ / how.folder, 1, how.timing});
    computed_.clear(), failures_.clear(), remarks_.clear();
    return run_sweep(
        request, workspace,
        {[&](const auto&, const RunRecord& record) { remarks_ = record.remarks(); },
         [](size_t, const Point&) {}, [&](size_t, const Point& point) { computed_.push_back(point.id); },
         [&](size_t, const Point&, const std::string& message) { failures_.push_back(message); },
         [&] { return computed_.size() >= how.stop_after; }});
  }
  RunResult run(const std::string& text) { return run(text, How{}); }

  std::string content(const std::string& file) const { return content_of(folder_ / file); }
  bool exists(const std::string& file) const { return std::filesystem::exists(folder_ / file); }
  void rename(const std::string& from, const std::string& to) const {
    std::filesystem::rename(folder_ / from, folder_ / to);
  }
  // Names of all files in the folder, sorted.
  std::vector<std::string> files(const std::string& folder = "out") const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / folder))
      names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }

  const TemporaryFolder folder_;
  const std::vector<Experiment> experiments_ = toy_experiments();
  Config config_;
  FrozenSweep sweep_;
  std::vector<std::string> computed_, failures_, remarks_;  // ids; messages
};

}  // namespace hybray::test
