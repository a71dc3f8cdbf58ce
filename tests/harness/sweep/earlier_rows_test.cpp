#include "harness/sweep/earlier_rows.h"

#include "core/base/hash.h"
#include "tests/temporary_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace hybray {
namespace {

const std::string kHeader = "id,x\n";
const RowOrigin kOrigin = {{"program", "p"}, {"timing", "false"}};

class EarlierRowsTest : public ::testing::Test {
 protected:
  void write_manifest(const std::string& file, const std::string& hash, bool fresh = false,
                      const std::string& table = "t.csv") {
    folder_.write(
        file,
        nlohmann::json{
            {"table", {{"file", table}, {"content_hash", hash}}},
            {"row_origin", kOrigin},
            {"run", {{"fresh", fresh}, {"sessions", {{{"start_unix_s", 5.0}, {"wall_time_s", 2.0}}}}}}}
            .dump());
  }
  void write_complete(const std::string& rows) {
    folder_.write("t.csv", kHeader + rows);
    write_manifest("manifest.json", hex(hash_text(kHeader + rows)));
  }
  void write_partial(const std::string& rows, bool fresh = false) {
    folder_.write("t.csv.partial", kHeader + rows);
    write_manifest("manifest.json.partial", "", fresh);
  }
  EarlierRows find(const RowOrigin& origin = kOrigin) const {
    return find_earlier_rows(folder_.path(), "t", kHeader, origin);
  }

  const test::TemporaryFolder folder_;
};

TEST_F(EarlierRowsTest, FindsNothingInAnEmptyFolder) {
  const EarlierRows earlier = find();
  EXPECT_TRUE(earlier.lines.empty());
  EXPECT_TRUE(earlier.sessions.empty());
  EXPECT_TRUE(earlier.remarks.empty());
  EXPECT_EQ(earlier.partial, PartialRows::none);
}

TEST_F(EarlierRowsTest, PrefersTheGrowingTableAndAddsTheCompleteOne) {
  write_complete("a,1\nb,2\n");
  write_partial("b,3\nc,\"4\n\"\n");
  const EarlierRows earlier = find();
  EXPECT_EQ(earlier.lines, (TableLines{{"a", "a,1\n"}, {"b", "b,3\n"}, {"c", "c,\"4\n\"\n"}}));
  EXPECT_EQ(earlier.partial, PartialRows::taken_over);
  ASSERT_EQ(earlier.sessions.size(), 1u) << "one session made both";
  EXPECT_EQ(earlier.sessions[0].wall_time_s, 2.0);
}

TEST_F(EarlierRowsTest, LeavesTheCompleteTableAloneWhenTheGrowingOneStartedOver) {
  write_complete("a,1\n");
  write_partial("b,3\n", true);
  EXPECT_EQ(find().lines, (TableLines{{"b", "b,3\n"}}));
  EXPECT_TRUE(find().fresh);
}

TEST_F(EarlierRowsTest, NeedsAManifestThatIsOfTheTable) {
  write_complete("a,1\n");
  write_partial("b,3\n");
  write_manifest("manifest.json.partial", "", false, "u.csv");
  EXPECT_EQ(find().lines, (TableLines{{"a", "a,1\n"}}));
  EXPECT_EQ(find().partial, PartialRows::foreign);
  std::filesystem::remove(folder_ / "manifest.json");
  EXPECT_TRUE(find().lines.empty());
  EXPECT_EQ(find().remarks.size(), 2u);
}

TEST_F(EarlierRowsTest, NeedsTheSameOriginAndTheSameColumns) {
  write_complete("a,1\n");
  EXPECT_EQ(find({{"program", "q"}, {"timing", "false"}}).remarks,
            std::vector<std::string>{"the 1 rows of " + (folder_ / "t.csv").string() +
                                     " are not taken over: it was made with another: program"});
  const EarlierRows earlier = find_earlier_rows(folder_.path(), "t", "id,y\n", kOrigin);
  EXPECT_TRUE(earlier.lines.empty());
  EXPECT_TRUE(earlier.remarks.at(0).ends_with(": its columns are others"));
}

TEST_F(EarlierRowsTest, NeedsTheCompleteTableAsItWasWritten) {
  write_complete("a,1\n");
  folder_.write("t.csv", kHeader + "a,2\n");
  EXPECT_TRUE(find().lines.empty());
}

}  // namespace
}  // namespace hybray
