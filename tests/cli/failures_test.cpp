#include "tool_test_fixture.hpp"

#include <thread>

namespace tvg::cli::testing {
namespace {

using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(ToolTest, UsageErrorsShowWhatIsRight) {
  const std::string encode = "tvg encode hand.obj hand.pc2 -o no.tvg ";
  expect_failure("tvg", 1, "encode");
  expect_failure("tvg encoed", 1, "encoed");
  expect_failure("tvg encode - <hand.pc2", 1, "--output");
  expect_failure(encode + "--bits 11:13", 1, "13:11");
  expect_failure(encode + "--bits x", 1, "13:11");
  expect_failure(encode + "--bits 25", 1, "1 to 24");
  expect_failure(encode + "--step 0.01:0.03", 1, "0.01:0.04");
  expect_failure(encode + "--step -1", 1, "0.01:0.04");
  expect_failure(encode + "--step 1e-12", 1, "a step of at least");
  expect_failure(encode + "--bits 13:11 --important 0.35", 1, "35%");
  expect_failure(encode + "--bits 11 --important 35%", 1, "13:11");
  expect_failure(encode + "--predictor magic", 1, "elp");
  expect_failure(encode + "--mode magic", 1, "elp");
  expect_failure(encode + "--gop 0", 1, "65536");
  expect_failure(encode + "--frames 5-2", 1, "0-49");
  expect_failure(encode + "--frames all", 1, "0-49");
  expect_failure(encode + "--meta nonsense", 1, "KEY=VALUE");
  expect_failure("tvg compare hand.pc2 hand.pc2", 1, "--mesh");
  expect_failure("tvg encode hand.pc2 -o no.tvg", 1, "hand.obj");
  expect_failure("tvg encode hand.obj hand.pc2 -o no.tvg --important-above 1 --bits 9", 1, "13:11");
  EXPECT_FALSE(std::filesystem::exists(folder_.path("no.tvg")));
}

TEST_F(ToolTest, MissingInputsAreIoErrors) {
  expect_failure("tvg encode gone.obj hand.pc2 -o no.tvg", 2, "gone.obj");
  expect_failure("tvg encode hand.obj gone.pc2 -o no.tvg", 2, "gone.pc2");
  for (const std::string command :
       {"tvg decode gone.tvg -o no.pc2", "tvg info gone.tvg", "tvg verify gone.tvg",
        "tvg compare gone.tvg gone.tvg", "tvg join gone.tvg -o no.tvg"}) {
    expect_failure(command, 2, "gone.tvg");
  }
}

TEST_F(ToolTest, ForeignFilesAreNamedAndRefused) {
  folder_.write("empty.tvg", "");
  folder_.write("image.tvg", std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16));
  for (const std::string command :
       {"tvg decode % -o no.pc2", "tvg info %", "tvg verify %", "tvg compare % %", "tvg join % -o no.tvg"}) {
    for (const auto& [file, words] : {std::pair<std::string, std::string>("empty.tvg", "empty"),
                                      {"image.tvg", "not a TVG stream"},
                                      {"hand.obj", "not a TVG stream"}}) {
      if (file == "hand.obj" && command.find("compare") != std::string::npos)
        continue;  // a mesh can be compared
      std::string line = command;
      for (std::size_t at; (at = line.find('%')) != std::string::npos;) line.replace(at, 1, file);
      const Outcome result = run(line);
      EXPECT_EQ(result.status, 3) << line;
      EXPECT_THAT(result.out + result.err, HasSubstr(words)) << line;
      EXPECT_THAT(result.err, HasSubstr(file)) << line;
    }
  }
  folder_.write("image.obj", std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16));
  expect_failure("tvg encode image.obj hand.pc2 -o no.tvg", 3, "PNG");
  EXPECT_FALSE(std::filesystem::exists(folder_.path("no.tvg")));
}

TEST_F(ToolTest, EveryFileIsNamedOnce) {
  std::string bytes = folder_.read("hand.pc2");
  bytes.replace(32 + 12 * 5, 4, "\xff\xff\xff\xff");
  folder_.write("nan.pc2", bytes);
  folder_.write("cut.pc2", bytes.substr(0, bytes.size() - 100));
  for (const std::string file : {"nan.pc2", "cut.pc2"}) {
    const Outcome result = run("tvg encode hand.obj " + file + " -o no.tvg");
    EXPECT_EQ(result.status, 3);
    EXPECT_THAT(result.err, HasSubstr(file));
    EXPECT_EQ(result.err.find(file), result.err.rfind(file)) << result.err;
    EXPECT_THAT(result.err, HasSubstr("frame")) << result.err;
    EXPECT_THAT(result.err, Not(HasSubstr("[invalid-input"))) << result.err;
    EXPECT_EQ(run("tvg encode hand.obj " + file + " -o no.tvg --live --fps 1000").err, result.err);
    EXPECT_EQ(run("tvg measure hand.obj " + file).err, result.err);
  }
  const Outcome piped = run("head -c 9999 hand.pc2 | tvg encode hand.obj - -o no.tvg");
  EXPECT_EQ(piped.status, 3);
  EXPECT_THAT(piped.err, HasSubstr("tvg: standard input ends at byte 9999 inside frame"));
}

TEST_F(ToolTest, EveryCutOfAStreamIsRefusedAndLeavesNothing) {
  good("tvg encode hand.obj hand.pc2 -o hand.tvg --gop 5");
  const std::string whole = folder_.read("hand.tvg");
  const std::vector<std::string> before = folder_.names();
  for (const std::size_t size : {std::size_t{1}, std::size_t{8}, std::size_t{30}, whole.size() / 2,
                                 whole.size() - 28, whole.size() - 1}) {
    folder_.write("hand.tvg", whole.substr(0, size));
    expect_failure("tvg decode hand.tvg -o no.pc2", 3, "hand.tvg");
    expect_failure("tvg join hand.tvg -o no.tvg", 3, "hand.tvg");
    expect_failure("tvg verify hand.tvg", 3, "hand.tvg");
    EXPECT_EQ(folder_.names(), before) << size;
  }
}

TEST_F(ToolTest, InfoOfACutFileNamesTheByteAtWhichItEnds) {
  good("tvg encode hand.obj hand.pc2 -o hand.tvg --bits 20 --gop 6");
  const std::string whole = folder_.read("hand.tvg");
  for (const std::size_t size :
       {std::size_t{100}, whole.size() / 3, 2 * whole.size() / 3, whole.size() - 1}) {
    folder_.write("cut.tvg", whole.substr(0, size));
    const std::string place = "byte " + std::to_string(size) + ",";
    expect_failure("tvg info cut.tvg", 3, place);
    expect_failure("cat cut.tvg | tvg info -", 3, place);
  }
  EXPECT_EQ(run("cat hand.tvg | tvg info - | tail -n +2").out, run("tvg info hand.tvg | tail -n +2").out);
}

TEST_F(ToolTest, FailuresKeepTheOldOutputAndLeaveNoTemporaryFile) {
  folder_.write("out.tvg", "old");
  const std::string bytes = folder_.read("hand.pc2");
  expect_failure("head -c 20000 hand.pc2 | tvg encode hand.obj - -o out.tvg --gop 2", 3, "standard input");
  EXPECT_EQ(folder_.read("out.tvg"), "old");
  EXPECT_THAT(folder_.names(), Each(Not(HasSubstr("tmp"))));
}

TEST_F(ToolTest, OutputsThatCannotBeWrittenAreIoErrors) {
  good("tvg encode hand.obj hand.pc2 -o hand.tvg");
  expect_failure("tvg encode hand.obj hand.pc2 -o missing/out.tvg", 2, "missing/out.tvg");
  expect_failure("tvg decode hand.tvg -o missing/out.pc2", 2, "missing/out.pc2");
  expect_failure("mkdir -p there && tvg encode hand.obj hand.pc2 -o there", 2, "folder");
  expect_failure("tvg decode hand.tvg -o out.xyz", 1, ".pc2");
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full here";
  expect_failure("tvg encode hand.obj hand.pc2 -o /dev/full", 2, "/dev/full: No space left");
  expect_failure("tvg encode hand.obj hand.pc2 -o - >/dev/full", 2, "standard output: No space left");
  expect_failure("tvg decode hand.tvg -o - >/dev/full", 2, "No space left");
  expect_failure("tvg join hand.tvg -o /dev/full", 2, "No space left");
  expect_failure("tvg info hand.tvg >/dev/full", 2, "No space left");
  expect_failure("tvg verify hand.tvg >/dev/full", 2, "No space left");
  expect_failure("tvg compare hand.tvg hand.tvg --json >/dev/full", 2, "No space left");
}

TEST_F(ToolTest, AFolderWithoutPermissionIsAnIoError) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  good("mkdir locked && chmod 555 locked");
  expect_failure("tvg encode hand.obj hand.pc2 -o locked/out.tvg", 2, "locked/out.tvg: Permission denied");
}

TEST_F(ToolTest, AClosedPipeIsAnIoErrorAndNoCrash) {
  good("tvg encode hand.obj hand.pc2 -o hand.tvg");
  const Outcome result = run("tvg decode hand.tvg -o - | true; echo ${PIPESTATUS[0]}");
  EXPECT_THAT(result.out, ::testing::AnyOf("0\n", "2\n"));  // 0 where all fits the pipe before it is closed
  EXPECT_EQ(run("exec 3> >(true); sleep 0.2; tvg decode hand.tvg -o - >&3").status, 2);
}

TEST_F(ToolTest, AnInterruptRemovesTheTemporaryFile) {
  const Outcome result =
      run("(cat hand.pc2; exec sleep 3) | head -c 40000 >part; "
          "mkfifo feed; (cat part; exec sleep 20) >feed & feeder=$!; "
          "tvg encode hand.obj - -o out.tvg --gop 1 --threads 1 <feed & tool=$!; "
          "for i in $(seq 100); do ls out.tvg.tmp* >/dev/null 2>&1 && break; sleep 0.05; done; "
          "ls out.tvg.tmp* | wc -l; kill -TERM $tool; wait $tool; echo $?; kill $feeder");
  EXPECT_EQ(result.out, "1\n143\n") << result.err;
  EXPECT_THAT(folder_.names(), Each(Not(HasSubstr("tmp"))));
  EXPECT_FALSE(std::filesystem::exists(folder_.path("out.tvg")));
}

}  // namespace
}  // namespace tvg::cli::testing
