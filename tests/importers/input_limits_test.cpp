#include "encoder/importers/input_file.hpp"
#include "encoder/importers/mesh_file.hpp"
#include "encoder/importers/open_source.hpp"
#include "encoder/importers/scene_summary.hpp"
#include "encoder/importers/trial.hpp"
#include "io_toolbox.hpp"

#include <csignal>
#include <gmock/gmock.h>
#include <new>
#include <sys/stat.h>
#include <thread>

namespace tvg::cli::testing {
namespace {

using ::testing::HasSubstr;

constexpr std::uint64_t kMebibyte = std::uint64_t{1} << 20;

TEST(Trial, SaysHowItEnded) {
  EXPECT_EQ(run_trial([] {}, {}), TrialResult::kFine);
  EXPECT_EQ(run_trial([] { throw std::runtime_error("told later"); }, {}), TrialResult::kFine);
  EXPECT_EQ(run_trial([] { std::raise(SIGSEGV); }, {}), TrialResult::kCrashed);
  EXPECT_EQ(run_trial([] { std::raise(SIGXCPU); }, {}), TrialResult::kTooLong);
}

TEST(Trial, EndsWhatComputesTooLong) {
  const auto spin = [] {
    volatile bool going = true;
    while (going) {
    }
  };
  EXPECT_EQ(run_trial(spin, {1, 60}), TrialResult::kTooLong);
}

TEST(Trial, EndsWhatWaitsTooLong) {
  EXPECT_EQ(run_trial([] { std::this_thread::sleep_for(std::chrono::minutes(5)); }, {60, 1}),
            TrialResult::kTooLong);
}

TEST(Trial, EndsWhatAsksForTooMuchMemory) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the sanitizer's address space cannot be limited";
#else
  const auto take = [](std::uint64_t bytes) {
    return [bytes] {
      try {
        ::operator delete(::operator new(bytes));
      } catch (const std::bad_alloc&) {
        // As libraries do that go on with what they have.
      }
    };
  };
  EXPECT_EQ(run_trial(take(100 * kMebibyte), {60, 60, 200 * kMebibyte}), TrialResult::kFine);
  EXPECT_EQ(run_trial(take(300 * kMebibyte), {60, 60, 200 * kMebibyte}), TrialResult::kTooMuchMemory);
#endif
}

class InputLimits : public ::testing::Test {
 protected:
  /// A pipe that gives `bytes` bytes to one reader.
  std::string pipe(const std::string& name, std::size_t bytes) {
    const std::string path = folder_.path(name);
    EXPECT_EQ(mkfifo(path.c_str(), 0600), 0);
    writer_ = std::thread([path, bytes] { std::ofstream(path) << std::string(bytes, 'x'); });
    return path;
  }
  ~InputLimits() override {
    if (writer_.joinable()) writer_.join();
  }

  TemporaryFolder folder_;
  std::thread writer_;
};

TEST_F(InputLimits, APipeIsReadUpToItsBound) {
  std::string bytes;
  read_file(pipe("fits", 5000), bytes, 5000);
  EXPECT_EQ(bytes, std::string(5000, 'x'));
  writer_.join();
  const ToolError error = thrown_by([&] { read_file(pipe("more", 5001), bytes, 5000); });
  EXPECT_EQ(error.status(), ExitStatus::kInvalidInput);
  EXPECT_THAT(error.what(), HasSubstr("goes on after byte 5000"));
  EXPECT_THAT(error.what(), HasSubstr("copy it to one"));
}

TEST_F(InputLimits, ARegularFileHasNoBoundButItsSize) {
  std::string bytes;
  read_file(folder_.write("large", std::string(3000, 'x')), bytes, 10);
  EXPECT_EQ(bytes.size(), 3000U);
}

TEST_F(InputLimits, ADeviceWithoutAnEndIsRefused) {
  if (!std::filesystem::exists("/dev/zero")) GTEST_SKIP() << "there is no /dev/zero here";
  std::string bytes;
  EXPECT_THAT(thrown_by([&] { read_file("/dev/zero", bytes, kMebibyte); }).what(),
              HasSubstr("goes on after byte 1048576"));
}

TEST_F(InputLimits, ASceneIsARegularFile) {
  const std::string path = folder_.path("scene.gltf");
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);  // without a writer: opening it would wait for ever
  for (const auto& action : std::vector<std::function<void()>>{[&] { open_source({{path}}); },
                                                               [&] { summarize_scene(path, 30); }}) {
    const ToolError error = thrown_by(action);
    EXPECT_EQ(error.status(), ExitStatus::kIo);
    EXPECT_THAT(error.what(), HasSubstr("copy it to a regular file"));
  }
}

std::string glb(std::uint32_t size, std::uint32_t chunk_size, std::string_view json) {
  ByteString bytes(false);
  bytes.text("glTF").add(std::uint32_t{2}).add(size).add(chunk_size).text("JSON").text(json);
  return bytes.bytes();
}

TEST_F(InputLimits, SizesInABinarySceneAreCheckedBeforeTheyAreTrusted) {
  const auto message = [this](const std::string& bytes) {
    const std::string path = folder_.write("scene.glb", bytes);
    return std::string(thrown_by([&] { open_source({{path}}); }).what());
  };
  EXPECT_THAT(message(glb(0xffffffff, 0xffffffff, "{}")), HasSubstr("ends at byte 22; its header promises"));
  EXPECT_THAT(message(glb(22, 0xffffffff, "{}")),
              HasSubstr("byte 12: a chunk of 4294967295 bytes is promised where 2 are left"));
  EXPECT_THAT(message(glb(32, 4, "{  }") + glb(0, 0, "").substr(0, 8)), HasSubstr("byte 24: a chunk of"));
}

TEST(PlyHeader, HasAMostOfElementsAndProperties) {
  const auto message = [](const std::string& lines) {
    MeshFile mesh;
    return std::string(thrown_by([&] {
                         parse_ply("big.ply", "ply\nformat ascii 1.0\n" + lines + "end_header\n", mesh);
                       }).what());
  };
  std::string properties = "element vertex 3\n";
  for (int i = 0; i < 100000; ++i) properties += "property float p" + std::to_string(i) + "\n";
  EXPECT_THAT(message(properties), HasSubstr("line 4100: more than 4096 properties"));
  std::string elements;
  for (int i = 0; i < 100000; ++i) elements += "element e" + std::to_string(i) + " 1\nproperty float x\n";
  EXPECT_THAT(message(elements), HasSubstr("more than 256 elements"));
  std::string few;
  for (int i = 0; i < 200; ++i) {
    few += "element e" + std::to_string(i) + " 1\n";
    for (int k = 0; k < 21; ++k) few += "property float p" + std::to_string(k) + "\n";
  }
  EXPECT_THAT(message(few), HasSubstr("more than 4096 properties"));
  EXPECT_THAT(message("element v 1\nproperty float x\nproperty float x\n"),
              HasSubstr("a second property 'x'"));
}

}  // namespace
}  // namespace tvg::cli::testing
