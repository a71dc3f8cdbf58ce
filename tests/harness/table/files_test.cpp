#include "harness/table/files.h"

#include "core/base/error.h"
#include "tests/temporary_folder.h"

#include <gtest/gtest.h>

namespace hybray {
namespace {

TEST(Files, ReadsWhatItWroteAndReplacesWhatWasThere) {
  const test::TemporaryFolder folder;
  const std::string content("a\0b\r\n", 5);
  replace_file(folder / "f", "something longer than the next content");
  replace_file(folder / "f", content);
  EXPECT_EQ(read_file(folder / "f"), content);
  const auto files = std::filesystem::directory_iterator(folder.path());
  EXPECT_EQ(std::distance(begin(files), end(files)), 1) << "a temporary file was left behind";
}

TEST(Files, SaysWhyAFileCannotBeRead) {
  const test::TemporaryFolder folder;
  const auto message = [&](const std::filesystem::path& file, size_t limit) {
    return test::message_of<InputError>([&] { read_file(file, limit); });
  };
  EXPECT_EQ(message(folder / "f", 9),
            (folder / "f").string() + ": cannot be read: No such file or directory");
  EXPECT_EQ(message(folder.path(), 9), folder.path().string() + ": cannot be read: it is a folder");
  EXPECT_EQ(message(folder.write("f", "ten bytes!"), 9),
            (folder / "f").string() + ": cannot be read: it is larger than 9 bytes");
}

TEST(Files, LeavesTheOldContentWhereTheNewCannotBeWritten) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("file", "old");
  EXPECT_EQ(test::message_of<RuntimeError>([&] { replace_file(file / "below", "new"); }),
            (file / "below").string() + ": cannot be written: Not a directory");
  EXPECT_EQ(read_file(file), "old");
}

TEST(Files, MakesAnOutputFolderAndLeavesNothingInIt) {
  const test::TemporaryFolder folder;
  make_writable_folder(folder / "a/b");
  EXPECT_TRUE(std::filesystem::is_empty(folder / "a/b"));
}

TEST(Files, RefusesAnOutputFolderBelowARegularFile) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("file", "old");
  EXPECT_EQ(test::message_of<InputError>([&] { make_writable_folder(file / "out"); }),
            (file / "out").string() + ": the output folder cannot be written to: Not a directory");
}

}  // namespace
}  // namespace hybray
