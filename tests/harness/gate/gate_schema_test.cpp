#include "harness/gate/gate_schema.h"

#include "harness/config/schema.h"
#include "tests/harness/gate/gate_fixture.h"

namespace hybray {
namespace {

using Json = nlohmann::ordered_json;

class GateSchemaTest : public test::GateFixture {
 protected:
  bool is_accepted(const std::string& gate) {
    const std::string document = "{\"gates\": [" + gate + "]}";
    return schema_violations(gate_file_schema({&experiment_, 1}), Json::parse(document)).empty();
  }
};

TEST_F(GateSchemaTest, AcceptsGoodGates) {
  EXPECT_TRUE(is_accepted(R"({"name": "n", "column": "alpha", "min": 0, "max": 1, "reason": "r",
    "where": {"scene": "a", "size": [1, 2], "items": 3}, "expected_failure": "e"})"));
  EXPECT_TRUE(is_accepted(R"({"column": "*", "baseline": "unchanged"})"));
  EXPECT_TRUE(is_accepted(R"({"column": "good", "baseline": "unchanged"})"));
  EXPECT_TRUE(is_accepted(
      R"({"column": "drift", "baseline": {"worse_by_at_most": 0.1, "relative": true, "better": "lower"}})"));
}

// Where the schema's own words would have to do, ours come first.
TEST_F(GateSchemaTest, RejectsOnlyWhatTheCheckRejectsToo) {
  for (const char* broken : {
           R"(5)",
           R"({"min": 0})",
           R"({"column": "alpha"})",
           R"({"column": "t_ms", "max": 1})",
           R"({"column": "scene", "max": 1})",
           R"({"column": "alpha", "min": "0"})",
           R"({"column": "alpha", "min": 0, "extra": 1})",
           R"({"column": "alpha", "min": 0, "name": ""})",
           R"({"column": "alpha", "min": 0, "where": {"loss": 1}})",
           R"({"column": "alpha", "min": 0, "where": {"scene": []}})",
           R"({"column": "alpha", "min": 0, "where": {"scene": null}})",
           R"({"column": "alpha", "baseline": "same"})",
           R"({"column": "alpha", "baseline": {}})",
           R"({"column": "alpha", "baseline": {"worse_by_at_most": -1}})",
           R"({"column": "alpha", "baseline": {"worse_by_at_most": 1, "differs_by_at_most": 1}})",
           R"({"column": "alpha", "baseline": {"worse_by_at_most": 1, "better": "up"}})",
       }) {
    EXPECT_FALSE(is_accepted(broken)) << broken;
    EXPECT_THROW(gates("[" + std::string(broken) + "]"), InputError) << broken;
  }
}

TEST_F(GateSchemaTest, IsPartOfTheSchemaOfConfigs) {
  EXPECT_EQ(config_schema(experiment_)["properties"]["gates"], gates_schema({&experiment_, 1}));
}

TEST(CheckedInGateSchema, IsWhatTheDeclarationsSay) {
  EXPECT_EQ(test::content_of(HYBRAY_PROJECT_DIR "/configs/schema/gates.schema.json"),
            gate_file_schema_text(experiments()))
      << "make it anew: hybray describe --gate-schema > configs/schema/gates.schema.json";
}

}  // namespace
}  // namespace hybray
