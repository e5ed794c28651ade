#include "cli/commands.hpp"
#include "tool/progress.hpp"
#include "tool/stream_reader.hpp"
#include "tool/tool_error.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>

namespace tvg::cli {

namespace {

struct VerifyArguments {
  std::string input;
  bool json = false;
  bool quiet = false;
};

struct Finding {
  Error error;
  std::uint64_t frames_lost;
};

nlohmann::json to_json(const Finding& finding) {
  const Error& error = finding.error;
  nlohmann::json json = {{"code", static_cast<int>(error.code)},
                         {"name", error_name(error.code)},
                         {"message", error.message},
                         {"section", error.section},
                         {"frames_lost", finding.frames_lost},
                         {"offset", nullptr},
                         {"frame", nullptr}};
  if (error.byte_offset) json["offset"] = *error.byte_offset;
  if (error.frame) json["frame"] = *error.frame;
  return json;
}

void run_verify(const VerifyArguments& arguments) {
  StreamReader reader(arguments.input);
  const Decoder& decoder = reader.decoder();
  std::vector<Finding> findings;
  std::uint64_t frames = 0;
  std::uint64_t lost = 0;
  {
    ProgressBar bar("verifying", arguments.quiet);
    for (bool more = true; more;) {
      switch (reader.next()) {
        case Decoder::Event::kFrame:
          bar.update(++frames, std::nullopt);
          break;
        case Decoder::Event::kDamage:
          findings.push_back({decoder.damage().error, decoder.damage().frame_count});
          lost += decoder.damage().frame_count;
          break;
        case Decoder::Event::kError:
          findings.push_back({decoder.error(), 0});
          more = false;
          break;
        case Decoder::Event::kEnd:
          more = false;
          break;
        default:
          break;
      }
    }
  }
  if (arguments.json) {
    nlohmann::json json = {{"file", reader.name()},
                           {"valid", findings.empty()},
                           {"frames", frames},
                           {"frames_lost", lost},
                           {"findings", nlohmann::json::array()}};
    for (const Finding& finding : findings) json["findings"].push_back(to_json(finding));
    fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    for (std::size_t i = 0; i < findings.size(); ++i) {
      fmt::print("{}. {}{}\n", i + 1,
                 findings[i].frames_lost > 0 ? fmt::format("{} frames lost: ", findings[i].frames_lost) : "",
                 findings[i].error.describe());
    }
    if (findings.empty() && !arguments.quiet) {
      fmt::print("{}: valid, {} frames decode to what was encoded\n", reader.name(), frames);
    }
  }
  if (!findings.empty()) {
    throw ToolError(ExitStatus::kInvalidInput, fmt::format("{}: {} findings, {} frames decoded, {} lost",
                                                           reader.name(), findings.size(), frames, lost));
  }
}

}  // namespace

void add_verify_command(CLI::App& tool) {
  auto arguments = std::make_shared<VerifyArguments>();
  CLI::App& command = *tool.add_subcommand("verify", "Check every checksum of a .tvg and decode all of it");
  command.add_option("input", arguments->input, "the stream; - for standard input")->required();
  command.add_flag("--json", arguments->json, "print the findings as JSON");
  command.add_flag("-q,--quiet", arguments->quiet, "print findings only");
  command.callback([arguments] { run_verify(*arguments); });
}

}  // namespace tvg::cli
