#include "cli/commands.hpp"
#include "tool/progress.hpp"
#include "tool/stream_reader.hpp"
#include "tool/tool_error.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tvg::cli {

namespace {

struct VerifyArguments {
  std::string input;
  bool json = false;
  bool quiet = false;
};

struct Finding {
  Error error;
  std::optional<std::uint64_t> frames_lost;  ///< nothing where nobody can know how many
};

/// What a stream is found to be.
struct Verdict {
  std::vector<Finding> findings;
  std::uint64_t frames = 0;  ///< decoded
  std::uint64_t lost = 0;    ///< frames, those of unknown number left out
  std::uint32_t lods = 0;    ///< the most coarser meshes that a mesh has

  bool losses_known() const {
    return std::all_of(findings.begin(), findings.end(),
                       [](const Finding& finding) { return finding.frames_lost.has_value(); });
  }
};

nlohmann::json to_json(const Finding& finding) {
  const Error& error = finding.error;
  nlohmann::json json = {{"code", static_cast<int>(error.code)},
                         {"name", error_name(error.code)},
                         {"message", error.message},
                         {"section", error.section},
                         {"frames_lost", nullptr},
                         {"offset", nullptr},
                         {"frame", nullptr}};
  if (finding.frames_lost) json["frames_lost"] = *finding.frames_lost;
  if (error.byte_offset) json["offset"] = *error.byte_offset;
  if (error.frame) json["frame"] = *error.frame;
  return json;
}

Verdict read_all(StreamReader& reader, bool quiet) {
  const Decoder& decoder = reader.decoder();
  Verdict verdict;
  ProgressBar bar("verifying", quiet);
  for (;;) {
    switch (reader.next()) {
      case Decoder::Event::kMesh:
        verdict.lods = std::max(verdict.lods, decoder.lod_count());
        break;
      case Decoder::Event::kFrame:
        bar.update(++verdict.frames, std::nullopt);
        break;
      case Decoder::Event::kDamage: {
        const Damage& damage = decoder.damage();
        verdict.lost += damage.frame_count;
        verdict.findings.push_back(
            {damage.error, damage.count_known ? std::optional(damage.frame_count) : std::nullopt});
        break;
      }
      case Decoder::Event::kError:
        verdict.findings.push_back({decoder.error(), 0});
        return verdict;
      case Decoder::Event::kEnd:
        return verdict;
      default:
        break;
    }
  }
}

/// Decodes every coarser mesh of a stream that is fine as a whole. Of a pipe there is nothing left to read.
void read_lods(const StreamReader& whole, const std::string& path, bool quiet, Verdict& verdict) {
  if (!whole.size()) return;
  for (std::uint32_t lod = 1; lod <= verdict.lods && verdict.findings.empty(); ++lod) {
    StreamReader reader(path);
    reader.use_lod(lod);
    Verdict coarse = read_all(reader, quiet);
    for (Finding& finding : coarse.findings) {
      finding.error.message = fmt::format("lod {}: {}", lod, finding.error.message);
      verdict.findings.push_back(std::move(finding));
    }
    if (verdict.findings.empty() && coarse.frames != verdict.frames) {
      const std::string message =
          fmt::format("lod {} has {} frames and the whole {}", lod, coarse.frames, verdict.frames);
      verdict.findings.push_back({Error{ErrorCode::kMalformed, message, {}, {}, "§5.6"}, 0});
    }
  }
}

void print_json(const std::string& name, const Verdict& verdict) {
  nlohmann::json json = {{"file", name},
                         {"valid", verdict.findings.empty()},
                         {"frames", verdict.frames},
                         {"frames_lost", verdict.lost},
                         {"losses_known", verdict.losses_known()},
                         {"findings", nlohmann::json::array()}};
  for (const Finding& finding : verdict.findings) json["findings"].push_back(to_json(finding));
  fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

std::string lost_text(std::optional<std::uint64_t> frames) {
  if (!frames) return "an unknown number of frames lost: ";
  return *frames > 0 ? fmt::format("{} frames lost: ", *frames) : "";
}

void run_verify(const VerifyArguments& arguments) {
  StreamReader reader(arguments.input);
  Verdict verdict = read_all(reader, arguments.quiet);
  read_lods(reader, arguments.input, arguments.quiet, verdict);
  const std::vector<Finding>& findings = verdict.findings;
  if (arguments.json) {
    print_json(reader.name(), verdict);
  } else {
    for (std::size_t i = 0; i < findings.size(); ++i) {
      fmt::print("{}. {}{}\n", i + 1, lost_text(findings[i].frames_lost), findings[i].error.describe());
    }
    if (findings.empty() && !arguments.quiet) {
      fmt::print("{}: valid, {} frames decode to what was encoded\n", reader.name(), verdict.frames);
    }
  }
  if (!findings.empty()) {
    const std::string lost = verdict.losses_known() ? fmt::format("{}", verdict.lost)
                             : verdict.lost > 0     ? fmt::format("at least {}", verdict.lost)
                                                    : "an unknown number";
    throw ToolError(ExitStatus::kInvalidInput,
                    fmt::format("{}: {} {}, {} frames decoded, {} lost", reader.name(), findings.size(),
                                findings.size() == 1 ? "finding" : "findings", verdict.frames, lost));
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
