#include "harness/config/json_source.h"

#include "core/base/error.h"
#include "tests/temporary_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace hybray {
namespace {

std::string problem(const std::string& text) {
  return test::message_of<InputError>([&] { JsonSource(text, "c.json"); });
}

TEST(JsonSource, KnowsWhereEveryValueAndKeyStands) {
  const JsonSource source(
      "{\n  \"a\": [1, \"x,:]\\\"y\", {\"b/c~\" : -2.5e3}],\n\t\"d\":{},\"e\": [[], true\n,null]}", "c.json");
  EXPECT_EQ(source.place(""), "c.json:1:1");
  EXPECT_EQ(source.key_place("/a"), "c.json:2:3 (/a)");
  EXPECT_EQ(source.place("/a"), "c.json:2:8 (/a)");
  EXPECT_EQ(source.place("/a/0"), "c.json:2:9 (/a/0)");
  EXPECT_EQ(source.place("/a/1"), "c.json:2:12 (/a/1)");
  EXPECT_EQ(source.place("/a/2"), "c.json:2:23 (/a/2)");
  EXPECT_EQ(source.key_place("/a/2/b~1c~0"), "c.json:2:24 (/a/2/b~1c~0)");
  EXPECT_EQ(source.place("/a/2/b~1c~0"), "c.json:2:33 (/a/2/b~1c~0)");
  EXPECT_EQ(source.key_place("/d"), "c.json:3:2 (/d)");
  EXPECT_EQ(source.place("/d"), "c.json:3:6 (/d)");
  EXPECT_EQ(source.place("/e/0"), "c.json:3:15 (/e/0)");
  EXPECT_EQ(source.place("/e/1"), "c.json:3:19 (/e/1)");
  EXPECT_EQ(source.place("/e/2"), "c.json:4:2 (/e/2)");
}

TEST(JsonSource, GivesThePlaceOfTheParentForAValueThatIsNotThere) {
  const JsonSource source("{\n \"a\": {}}", "c.json");
  EXPECT_EQ(source.place("/a/b/c"), "c.json:2:7 (/a)");
}

TEST(JsonSource, KeepsTheOrderOfKeys) {
  const JsonSource source(R"({"z": 1, "a": 2})", "c.json");
  EXPECT_EQ(source.root().begin().key(), "z");
}

TEST(JsonSource, SkipsAByteOrderMark) {
  EXPECT_EQ(JsonSource("\xef\xbb\xbf{\"a\":1}", "c.json").place("/a"), "c.json:1:9 (/a)");
}

TEST(JsonSource, NamesLineAndColumnOfASyntaxError) {
  EXPECT_EQ(problem("{\n  \"a\": 1,\n  \"b\" 2\n}"),
            "c.json:3:7: this is not JSON: syntax error while parsing object separator - unexpected number "
            "literal; expected ':'");
  EXPECT_TRUE(problem("{\"a\": [1, 2").starts_with("c.json:1:12: this is not JSON: syntax error"))
      << problem("{\"a\": [1, 2");
  EXPECT_EQ(problem(""), "c.json:1:1: this is not JSON: the file is empty");
  EXPECT_TRUE(problem("{} x").starts_with("c.json:1:4: this is not JSON")) << problem("{} x");
  EXPECT_EQ(problem("[\n 1e999]"), "c.json:2:2: this is not JSON: number overflow parsing '1e999'");
}

TEST(JsonSource, RefusesAKeyThatStandsTwice) {
  EXPECT_EQ(problem("{\"p\": {\n \"a\": 1,\n \"b\": {\"a\": 3},\n \"a\": 2}}"),
            "c.json:4:2 (/p/a): the key \"a\" stands twice in this object; its first place is c.json:2:2");
}

TEST(JsonSource, RefusesNestingThatWouldExhaustTheStack) {
  const std::string deep = std::string(100000, '[') + std::string(100000, ']');
  EXPECT_EQ(problem(deep), "c.json:1:65: objects and lists are nested more than 64 deep here");
}

}  // namespace
}  // namespace hybray
