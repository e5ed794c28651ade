#include "tool/atomic_file.hpp"

#include "tests/importers/io_toolbox.hpp"

#include <csignal>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>

namespace tvg::cli {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(AtomicFile, AppearsOnlyWhenFinished) {
  const TemporaryFolder folder;
  {
    AtomicFile file(folder.path("a.bin"));
    file.write("half");
    EXPECT_THAT(folder.names(), ElementsAre(HasSubstr("a.bin.tmp")));
    EXPECT_EQ(file.size(), 4U);
    file.finish();
    EXPECT_THAT(folder.names(), ElementsAre("a.bin"));
  }
  EXPECT_EQ(folder.read("a.bin"), "half");
}

TEST(AtomicFile, LeavesTheOldFileAndNoOtherWhereItIsNotFinished) {
  const TemporaryFolder folder;
  folder.write("a.bin", "old");
  { AtomicFile(folder.path("a.bin")).write(std::string(1 << 20, 'x')); }
  EXPECT_THAT(folder.names(), ElementsAre("a.bin"));
  EXPECT_EQ(folder.read("a.bin"), "old");
  { AtomicFile(folder.path("b.bin")).write("x"); }
  EXPECT_THAT(folder.names(), ElementsAre("a.bin"));
}

TEST(AtomicFile, ReplacesTheTargetOfALinkAndKeepsItsPermissions) {
  const TemporaryFolder folder;
  folder.write("sub/real.bin", "old");
  std::filesystem::create_symlink("sub/real.bin", folder.path("link.bin"));
  ASSERT_EQ(chmod(folder.path("sub/real.bin").c_str(), 0640), 0);
  AtomicFile file(folder.path("link.bin"));
  file.write("new");
  file.finish();
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path("link.bin")));
  EXPECT_EQ(folder.read("sub/real.bin"), "new");
  struct stat status {};
  ASSERT_EQ(stat(folder.path("sub/real.bin").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777U, 0640U);
}

TEST(AtomicFile, OverwritesAndMovesTailsBothWays) {
  const TemporaryFolder folder;
  std::string expected;
  for (int i = 0; i < 300'000; ++i) expected += static_cast<char>('a' + i % 23);
  AtomicFile file(folder.path("a.bin"));
  file.write("HEAD");
  file.write(expected);
  file.move_tail(4, 9);
  file.overwrite(0, "123456789", 9);
  EXPECT_EQ(file.size(), expected.size() + 9);
  file.move_tail(9, 2);
  file.write("end");
  file.finish();
  EXPECT_EQ(folder.read("a.bin"), "12" + expected + "end");
}

TEST(AtomicFile, ReportsFailuresWithTheName) {
  const TemporaryFolder folder;
  const ToolError missing = thrown_by([&] { AtomicFile(folder.path("none/a.bin")); });
  EXPECT_EQ(missing.status(), ExitStatus::kIo);
  EXPECT_THAT(missing.what(), HasSubstr("none/a.bin: No such file or directory"));
  const ToolError is_folder = thrown_by([&] { AtomicFile(folder.path("")); });
  EXPECT_THAT(is_folder.what(), HasSubstr("it is a folder"));
}

TEST(AtomicFile, ReportsAFullDisk) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  AtomicFile file("/dev/full");
  EXPECT_FALSE(file.seekable());
  file.write("x");
  const ToolError full = thrown_by([&] { file.finish(); });
  EXPECT_EQ(full.status(), ExitStatus::kIo);
  EXPECT_THAT(full.what(), HasSubstr("cannot write /dev/full: No space left on device"));
}

/// Makes files in two threads until a signal ends the process.
[[noreturn]] void make_files_for_ever(const std::string& folder) {
  remove_temporary_files_on_signals();
  const auto make = [&folder](int thread) {
    for (;;) AtomicFile(folder + "/" + std::to_string(thread)).write("x");
  };
  std::thread other(make, 1);
  make(0);
  std::abort();
}

TEST(AtomicFile, ASignalAtAnyMomentLeavesNoTemporaryFile) {
  const TemporaryFolder folder;
  for (int round = 0; round < 40; ++round) {
    const pid_t child = fork();
    if (child == 0) make_files_for_ever(folder.path(""));
    std::this_thread::sleep_for(std::chrono::microseconds(5000 + 137 * round));
    kill(child, SIGTERM);
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM);
  }
  EXPECT_THAT(folder.names(), IsEmpty());
}

}  // namespace
}  // namespace tvg::cli
