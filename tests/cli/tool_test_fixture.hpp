#pragma once
#include "corpus/corpus.hpp"
#include "corpus/write_cache.hpp"
#include "tests/importers/io_toolbox.hpp"

#include <cstdlib>
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <sys/wait.h>
#include <vector>

namespace tvg::cli::testing {

/// How a shell command ended and what it printed.
struct Outcome {
  int status = 0;  ///< as $? gives it
  std::string out;
  std::string err;
};

/// A folder of a user who types commands in it: `hand.obj` and `hand.pc2` are there, `tvg` is in the PATH.
class ToolTest : public ::testing::Test {
 protected:
  static constexpr std::uint32_t kFrames = 12;

  ToolTest() {
    hand_ = corpus::find_corpus_entry("hand")->make({400, kFrames}).sequence;
    corpus::write_obj(folder_.path("hand.obj"), hand_);
    corpus::write_pc2(folder_.path("hand.pc2"), hand_);
  }

  Outcome run(const std::string& command) const {
    const std::string tool_folder = std::filesystem::path(TVG_TOOL).parent_path().string();
    const std::string line = "cd '" + folder_.path("") + "' && PATH='" + tool_folder + "':$PATH && { " +
                             command + "\n} >'" + printed_.path("out") + "' 2>'" + printed_.path("err") +
                             "' </dev/null";
    const int status = std::system(("/bin/bash -c \"" + escaped(line) + "\"").c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), printed_.read("out"),
            printed_.read("err")};
  }

  /// Runs what must succeed.
  Outcome good(const std::string& command) const {
    Outcome result = run(command);
    EXPECT_EQ(result.status, 0) << command << "\n" << result.err;
    return result;
  }

  /// Runs what must end with `status` and say `words`.
  void expect_failure(const std::string& command, int status, const std::string& words) const {
    const Outcome result = run(command);
    EXPECT_EQ(result.status, status) << command << "\n" << result.err;
    EXPECT_THAT(result.err, ::testing::HasSubstr(words)) << command;
    EXPECT_THAT(result.err, ::testing::Not(::testing::HasSubstr("terminate called"))) << command;
  }

  nlohmann::json json(const std::string& command) const {
    const Outcome result = run(command);
    nlohmann::json parsed = nlohmann::json::parse(result.out, nullptr, false);
    EXPECT_FALSE(parsed.is_discarded()) << command << "\n" << result.out << result.err;
    return parsed;
  }

  /// The commands that `tvg help` lists.
  std::vector<std::string> listed_commands() const {
    const std::string help = good("tvg help").out;
    std::istringstream lines(help.substr(help.find("Subcommands:")));
    std::vector<std::string> commands;
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line) && line.rfind("  ", 0) == 0) {
      if (line[2] != ' ') commands.push_back(line.substr(2, line.find(' ', 2) - 2));
    }
    return commands;
  }

  /// Chunks of a type in a stream: offset and bytes of each.
  std::vector<std::pair<std::size_t, std::size_t>> chunks(const std::string& stream,
                                                          const std::string& type) const {
    std::vector<std::pair<std::size_t, std::size_t>> found;
    const nlohmann::json info = json("tvg info --json " + stream);
    for (const nlohmann::json& chunk : info["chunks"]) {
      if (chunk["type"] == type) found.emplace_back(chunk["offset"], chunk["bytes"]);
    }
    return found;
  }

  void flip_byte(const std::string& name, std::size_t offset) const {
    std::string bytes = folder_.read(name);
    bytes.at(offset) = static_cast<char>(bytes[offset] ^ 0x55);
    folder_.write(name, bytes);
  }

  TemporaryFolder folder_;
  TemporaryFolder printed_;
  Sequence hand_;

 private:
  /// For use inside double quotes of a shell.
  static std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
      if (c == '"' || c == '\\' || c == '$' || c == '`') result += '\\';
      result += c;
    }
    return result;
  }
};

}  // namespace tvg::cli::testing
