#include "harness/sweep/manifest.h"

#include "tests/harness/support/toy_run.h"

#include <nlohmann/json.hpp>

namespace hybray {
namespace {

class ManifestTest : public test::ToyRunTest {};

TEST_F(ManifestTest, SaysWhatMadeTheTable) {
  run(R"({"experiment": "toy", "title": "T", "seed": 4, "parameters": {"loud": true}, "sweep": {"count": [1, 2]}})");
  RunState state;
  state.points = 2;
  state.done = 2;
  state.sessions = {{1.7e9, 1.25}, {1.7e9 + 5, 0.5}};
  const auto manifest = nlohmann::json::parse(
      manifest_text(config_, sweep_, {{"loud=true"}, {}, true, 2, Shard{1, 3}}, row_origin(true, 2), state));
  EXPECT_EQ(manifest["config"]["file"], "c.json") << "without its folder";
  EXPECT_EQ(manifest["config"]["experiment"], "toy");
  EXPECT_EQ(manifest["config"]["seed"], 4);
  EXPECT_EQ(manifest["config"]["parameters"]["loud"], true);
  EXPECT_EQ(manifest["config"]["parameters"]["length"], 0.5) << "defaults are written out";
  EXPECT_EQ(manifest["config"]["sweep"]["count"], (nlohmann::json{1, 2}));
  EXPECT_EQ(manifest["config"]["set"], nlohmann::json{"loud=true"});
  EXPECT_EQ(manifest["shard"], (nlohmann::json{{"index", 1}, {"count", 3}}));
  EXPECT_EQ(manifest["points"], (nlohmann::json{sweep_.points[0].id, sweep_.points[1].id}));
  EXPECT_EQ(manifest["run"]["points"], 2);
  EXPECT_EQ(manifest["run"]["points_done"], 2);
  EXPECT_EQ(manifest["run"]["complete"], true);
  EXPECT_EQ(manifest["run"]["threads"], 2);
  EXPECT_EQ(manifest["run"]["wall_time_s"], 1.75);
  EXPECT_TRUE(manifest["program"]["git_commit"] == "unknown" ||
              manifest["program"]["git_commit"].get<std::string>().size() == 40);
  EXPECT_TRUE(manifest["program"]["libraries"]["Embree"].get<std::string>().find('.') != std::string::npos);
  EXPECT_NE(manifest["machine"]["cpu"], "");
}

TEST_F(ManifestTest, IsReadBackAsFarAsResumingNeedsIt) {
  run(R"({"experiment": "toy", "parameters": {"count": 1}})");
  RunState state;
  state.table = "c.csv";
  state.content_hash = 255;
  state.fresh = true;
  state.sessions = {{1.7e9, 1.25}, {1.7e9 + 5, {}}};
  const RowOrigin origin = row_origin(true, 3);
  folder_.write("m.json", manifest_text(config_, sweep_, {}, origin, state));
  const auto manifest = read_manifest(folder_ / "m.json");
  ASSERT_TRUE(manifest.has_value());
  EXPECT_EQ(manifest->table, "c.csv");
  EXPECT_EQ(manifest->content_hash, "00000000000000ff");
  EXPECT_EQ(manifest->origin, origin);
  EXPECT_TRUE(manifest->fresh);
  ASSERT_EQ(manifest->sessions.size(), 2u);
  EXPECT_EQ(manifest->sessions[0].wall_time_s, 1.25);
  EXPECT_EQ(manifest->sessions[1].start_unix_s, 1.7e9 + 5);
  EXPECT_FALSE(manifest->sessions[1].wall_time_s.has_value());
}

TEST_F(ManifestTest, TakesNothingElseForAManifest) {
  EXPECT_FALSE(read_manifest(folder_ / "absent.json"));
  for (const char* text : {"", "{", "[]", "7", R"({"table": 1})", R"({"table": {"file": 3}})"})
    EXPECT_FALSE(read_manifest(folder_.write("m.json", text))) << text;
}

}  // namespace
}  // namespace hybray
