#include "harness/cache/cache_folder.h"

#include "tests/temporary_folder.h"

#include <cstdlib>
#include <optional>

#include <gtest/gtest.h>

namespace hybray {
namespace {

// Sets a variable for the life of a test.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    setenv(name, value.c_str(), 1);
  }
  ~Variable() {
    if (old_)
      setenv(name_, old_->c_str(), 1);
    else
      unsetenv(name_);
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> old_;
};

TEST(CacheFolder, IsThatOfTheUserAndMakesNothing) {
  const test::TemporaryFolder folder;
  const Variable home("HOME", (folder / "home").string()), xdg("XDG_CACHE_HOME", (folder / "xdg").string());
  EXPECT_EQ(default_cache_folder("/project"), folder / "xdg/hybray");
  {
    const Variable unset("XDG_CACHE_HOME", "");
    EXPECT_EQ(default_cache_folder("/project"), folder / "home/.cache/hybray");
    const Variable relative("XDG_CACHE_HOME", "relative/path");
    EXPECT_EQ(default_cache_folder("/project"), folder / "home/.cache/hybray");
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(CacheFolder, IsInTheProjectWhereTheUsersCannotBeWrittenTo) {
  const test::TemporaryFolder folder;
  folder.write("file", "");
  const Variable xdg("XDG_CACHE_HOME", (folder / "file").string());
  EXPECT_EQ(default_cache_folder("/project"), "/project/results/cache");
  const Variable none("XDG_CACHE_HOME", ""), no_home("HOME", "");
  EXPECT_EQ(default_cache_folder("/project"), "/project/results/cache");
}

}  // namespace
}  // namespace hybray
