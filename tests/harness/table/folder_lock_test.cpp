#include "harness/table/folder_lock.h"

#include "core/base/error.h"
#include "tests/temporary_folder.h"

#include <csignal>
#include <string>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace hybray {
namespace {

TEST(FolderLock, RefusesASecondHolderAndNamesTheFirst) {
  const test::TemporaryFolder folder;
  const FolderLock first(folder.path());
  EXPECT_EQ(test::message_of<InputError>([&] { FolderLock second(folder.path()); }),
            folder.path().string() + ": another run (process " + std::to_string(getpid()) +
                ") is writing to this folder");
}

TEST(FolderLock, IsFreeAgainAfterwardsAndLeavesNothing) {
  const test::TemporaryFolder folder;
  { const FolderLock lock(folder.path()); }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  const FolderLock again(folder.path());
}

TEST(FolderLock, GoesWithWhoeverItIsMovedTo) {
  const test::TemporaryFolder folder;
  FolderLock first(folder.path());
  const FolderLock second(std::move(first));
  EXPECT_THROW(FolderLock(folder.path()), InputError);
}

TEST(FolderLock, EndsWithAKilledHolder) {
  const test::TemporaryFolder folder;
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    const FolderLock lock(folder.path());
    if (write(ready[1], "r", 1) != 1) _exit(1);
    while (true) pause();
  }
  char byte = 0;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  EXPECT_THROW(FolderLock(folder.path()), InputError);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / ".hybray.lock")) << "it was killed while it held the lock";
  const FolderLock lock(folder.path());
  close(ready[0]);
  close(ready[1]);
}

TEST(FolderLock, SaysWhereItCannotBeMade) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(test::message_of<InputError>([&] { FolderLock lock(folder / "absent"); }),
            (folder / "absent/.hybray.lock").string() + ": cannot be made: No such file or directory");
}

}  // namespace
}  // namespace hybray
