#include "harness/table/files.h"

#include "core/base/error.h"
#include "tests/temporary_folder.h"

#include <csignal>
#include <ctime>

#include <gtest/gtest.h>
#include <sys/resource.h>

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

TEST(Files, ProvesThatSoManyBytesFitIntoAnOutputFolder) {
  const test::TemporaryFolder folder;
  make_writable_folder(folder / "a", 100000);
  EXPECT_TRUE(std::filesystem::is_empty(folder / "a"));
  rlimit old = {};
  getrlimit(RLIMIT_FSIZE, &old);
  const rlimit limit{50000, old.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &limit);
  const std::string message =
      test::message_of<InputError>([&] { make_writable_folder(folder / "a", 100000); });
  setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(message,
            (folder / "a").string() +
                ": the output folder cannot be written to: File too large (about 100000 bytes are needed)");
  EXPECT_TRUE(std::filesystem::is_empty(folder / "a"));
}

TEST(Files, RemovesWhatAKilledProgramHadBegunToWriteAndNothingElse) {
  const test::TemporaryFolder folder;
  for (const char* name :
       {"t.csv.4711.tmp", "manifest.json.1.tmp", "t.csv", "my.tmp", "4711.tmp", "x.47a.tmp"})
    folder.write(name, "x");
  remove_unfinished_files(folder.path());
  for (const char* name : {"t.csv", "my.tmp", "4711.tmp", "x.47a.tmp"})
    EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
  for (const char* name : {"t.csv.4711.tmp", "manifest.json.1.tmp"})
    EXPECT_FALSE(std::filesystem::exists(folder / name)) << name;
}

TEST(Files, KnowsWhenAFileWasLastWritten) {
  const test::TemporaryFolder folder;
  const double before = static_cast<double>(time(nullptr));
  EXPECT_GE(modified_unix_s(folder.write("f", "x")), before - 1);  // file systems round their clocks
  EXPECT_LE(modified_unix_s(folder / "f"), before + 60);
  EXPECT_EQ(modified_unix_s(folder / "absent"), 0);
}

TEST(Files, RefusesAnOutputFolderBelowARegularFile) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("file", "old");
  EXPECT_EQ(test::message_of<InputError>([&] { make_writable_folder(file / "out"); }),
            (file / "out").string() + ": the output folder cannot be written to: Not a directory");
}

}  // namespace
}  // namespace hybray
