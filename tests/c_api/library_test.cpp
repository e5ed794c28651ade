#include "c_api_toolbox.hpp"

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

// The shared library and the examples as they are built.
namespace tvg::test {
namespace {

/// What a shell command prints.
std::string output_of(const std::string& command) {
  std::string text;
  FILE* const pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return text;
  std::array<char, 4096> piece;
  for (std::size_t count; (count = std::fread(piece.data(), 1, piece.size(), pipe)) > 0;) {
    text.append(piece.data(), count);
  }
  EXPECT_EQ(::pclose(pipe), 0) << command;
  return text;
}

TEST(SharedLibrary, ExportsTheFunctionsOfItsHeadersAndNothingElse) {
  std::string text;
  for (const char* name : {"tvg.h", "tvg_encoder.h", "tvg_basis.h", "tvg_measure.h", "tvg_properties.h"}) {
    std::ifstream header(std::string(TVG_C_HEADERS) + name);
    ASSERT_TRUE(header) << name;
    text.append(std::istreambuf_iterator<char>(header), {});
  }
  const std::regex declaration("\nTVG_API [a-z][a-z0-9_ ]*[ *]+(tvg_[a-z_]+)\\(");
  std::set<std::string> declared;
  for (std::sregex_iterator i(text.begin(), text.end(), declaration), end; i != end; ++i)
    declared.insert((*i)[1]);
  ASSERT_GT(declared.size(), 20u);

  std::set<std::string> exported;
  std::istringstream lines(output_of("nm -D --defined-only " TVG_SHARED_LIBRARY));
  for (std::string address, kind, name; lines >> address >> kind >> name;) exported.insert(name);
  EXPECT_EQ(exported, declared);
}

class ExampleTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(path_, std::ios::binary)
        .write(reinterpret_cast<const char*>(stream_.data()), static_cast<std::streamsize>(stream_.size()));
  }
  void TearDown() override { std::filesystem::remove(path_); }

  const Stream stream_ = hybrid_stream();
  const std::string path_ = ::testing::TempDir() + "tvg_example_" +
                            ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".tvg";
};

TEST_F(ExampleTest, PrintFramesPrintsALineForEveryFrame) {
  const std::string text = output_of(TVG_EXAMPLES "/print_frames < " + path_);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 13) << text;
  EXPECT_NE(text.find("\nframe 11: "), std::string::npos) << text;
}

TEST_F(ExampleTest, DecodeToMemoryFindsTheSameFrameAgain) {
  const std::string text = output_of(TVG_EXAMPLES "/decode_to_memory " + path_ + " 7");
  EXPECT_EQ(text, "12 frames at 25 frames per second\nframe 7 again: the same\n");
}

TEST_F(ExampleTest, WhatEncodeWaveWritesPrintFramesPrints) {
  const std::string text = output_of(TVG_EXAMPLES "/encode_wave | " TVG_EXAMPLES "/print_frames");
  EXPECT_NE(text.find("mesh: 1089 vertices, 2048 faces\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\nattribute 'uv': 1089 values of 2 numbers\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\nframe 59: "), std::string::npos) << text;
}

TEST(Examples, AreShort) {
  for (const char* name : {"encode_wave.c", "print_frames.c", "decode_to_memory.cpp"}) {
    std::ifstream file(std::string(TVG_EXAMPLE_SOURCES "/") + name);
    ASSERT_TRUE(file) << name;
    const auto lines = std::count(std::istreambuf_iterator<char>(file), {}, '\n');
    EXPECT_TRUE(lines > 30 && lines < 100) << name << ": " << lines;
  }
}

}  // namespace
}  // namespace tvg::test
