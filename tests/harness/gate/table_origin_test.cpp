#include "harness/gate/table_origin.h"

#include "core/base/error.h"
#include "tests/temporary_folder.h"

#include <gtest/gtest.h>

namespace hybray {
namespace {

class TableOriginTest : public ::testing::Test {
 protected:
  std::optional<TableOrigin> with(const std::string& manifest) {
    folder_.write("manifest.json", manifest);
    return find_origin(folder_ / "t.csv");
  }
  std::string problem(const std::string& manifest) {
    return test::message_of<InputError>([&] { with(manifest); }).substr(folder_.path().string().size() + 1);
  }
  const test::TemporaryFolder folder_;
};

TEST_F(TableOriginTest, ReadsTheManifestBesideTheTable) {
  EXPECT_FALSE(find_origin(folder_ / "t.csv").has_value());
  const auto origin = with(R"({"config": {"file": "t.json", "experiment": "toy"}, "run": {"points": 3}})");
  ASSERT_TRUE(origin.has_value());
  EXPECT_EQ(origin->experiment, "toy");
  EXPECT_EQ(origin->config, "t.json");
  EXPECT_EQ(origin->points, 3);
}

TEST_F(TableOriginTest, IgnoresTheManifestOfAnotherTable) {
  EXPECT_FALSE(with(R"({"config": {"file": "other.json", "experiment": "toy"}})").has_value());
}

TEST_F(TableOriginTest, RefusesADamagedManifest) {
  EXPECT_EQ(problem("{"),
            "manifest.json:1:2: this is not JSON: syntax error while parsing object key - unexpected "
            "end of input; expected string literal");
  EXPECT_EQ(
      problem("{\"config\": {\"file\": \"t.json\"}}"),
      "manifest.json:1:12 (/config): this is no manifest: found null at /config/experiment; expected text");
  EXPECT_EQ(problem("[]"),
            "manifest.json:1:1: this is no manifest: found null at /config/experiment; expected text");
  EXPECT_EQ(problem(R"({"config": {"file": "../t.json", "experiment": "toy"}})"),
            "manifest.json:1:21 (/config/file): this is no manifest: the config's name has a folder in it");
}

}  // namespace
}  // namespace hybray
