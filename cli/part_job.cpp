#include "cli/part_job.hpp"

#include "cli/encode_job.hpp"
#include "cli/plan_file.hpp"
#include "encoder/importers/input_file.hpp"
#include "tool/atomic_file.hpp"
#include "tool/option_values.hpp"
#include "tool/progress.hpp"
#include "tool/remote_stream.hpp"
#include "tool/stream_reader.hpp"
#include "tool/tool_error.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>
#include <utility>

#include <tvg/data.hpp>
#include <tvg/parts.hpp>

namespace tvg::cli {

namespace {

/// `number` from 1 on.
PartMark mark_of(const std::string& plan_id, std::size_t number, std::size_t count) {
  return {plan_id, static_cast<std::uint32_t>(number), static_cast<std::uint32_t>(count)};
}

/// Whether the file is this very part from its first byte to its last.
bool is_there(const std::string& file, const PartMark& mark) {
  if (!std::filesystem::is_regular_file(file)) return false;
  const Result<std::optional<PartMark>> found = check_part(open_join_input(file));
  return found && *found == mark;
}

/// Which part a stream says it is, by what stands in front of its first frame.
std::optional<PartMark> mark_in(const std::string& file) {
  StreamReader reader(file);
  for (;;) {
    switch (reader.next()) {
      case Decoder::Event::kData: {
        const Result<NamedData> data = unpack_data(reader.decoder().data());
        if (data && data->name == kPartData) return part_mark(*data);
        break;
      }
      case Decoder::Event::kChunk:
      case Decoder::Event::kHead:
      case Decoder::Event::kMetadata:
        break;
      default:
        return std::nullopt;
    }
  }
}

EncodeReport encode_one(const PlanFile& plan, const EncodeArguments& arguments, const PartMark& mark,
                        const std::string& output) {
  EncodeOptions options = encode_options(arguments);
  files_of(arguments, arguments.measure.weights()).check_output(output);
  EncodeArguments without_levels = arguments;  // the plan has them
  without_levels.levels = {};
  const OpenedInput opened = open_for_encoding(without_levels, options);
  options.levels = plan.levels;
  options.data.push_back(part_data(mark));
  AtomicFile file(output);
  ProgressBar bar("encoding", arguments.quiet);
  const Result<EncodeReport> report = encode_part(
      *opened.source, options, plan.plan, plan.parts[mark.number - 1].frames,
      [&file](std::span<const std::uint8_t> bytes) {
        file.write(bytes.data(), bytes.size());
        return Status();
      },
      [&bar](std::uint64_t frames, std::optional<std::uint64_t> total) { bar.update(frames, total); });
  if (!report) throw tool_error(input_names(arguments), report.error());
  file.finish();
  bar.clear();
  if (!arguments.quiet) print_later_notes(opened);
  return *report;
}

}  // namespace

void run_parts(const PartArguments& arguments) {
  const PlanFile plan = read_plan(arguments.plan);
  const std::string plan_id = plan.id();
  const std::size_t count = plan.parts.size();
  if (arguments.part && *arguments.part > count) {
    throw ToolError(ExitStatus::kUsage, fmt::format("--part {}: {} has the parts 1 to {}", *arguments.part,
                                                    arguments.plan, count));
  }
  if (!arguments.part && !arguments.output.empty())
    throw ToolError(ExitStatus::kUsage, "--output names one file: say which --part it is for");
  EncodeArguments encoding = arguments_of(plan);
  encoding.threads = arguments.threads;
  encoding.quiet = arguments.quiet;
  const std::size_t first = arguments.part.value_or(1), last = arguments.part.value_or(count);
  for (std::size_t number = first; number <= last; ++number) {
    const std::string output =
        arguments.output.empty() ? plan.path_of(plan.parts[number - 1].file) : arguments.output;
    const std::string name = plan.name_of_part(number);
    const PartMark mark = mark_of(plan_id, number, count);
    try {
      if (!arguments.again && is_there(output, mark)) {
        if (!arguments.quiet) fmt::print(stderr, "{}: {} is there and whole\n", output, name);
        continue;
      }
      const auto begun = std::chrono::steady_clock::now();
      const EncodeReport report = encode_one(plan, encoding, mark, output);
      const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begun;
      if (arguments.json) print_encode_json(output, report, taken.count());
      if (arguments.quiet || arguments.json) continue;
      fmt::print(stderr, "{}, {:.1f} s, ", name, taken.count());
      print_encode_report(output, report);
    } catch (const ToolError& error) {
      throw ToolError(error.status(), fmt::format("{}: {}", name, error.what()));
    }
  }
}

PlannedJoin planned_join(const std::string& plan_path) {
  const PlanFile plan = read_plan(plan_path);
  PlannedJoin join{{}, plan.path_of(plan.output)};
  const std::string plan_id = plan.id();
  std::vector<std::size_t> missing;
  for (std::size_t number = 1; number <= plan.parts.size(); ++number) {
    join.inputs.push_back(plan.path_of(plan.parts[number - 1].file));
    if (!std::filesystem::exists(join.inputs.back())) missing.push_back(number);
  }
  if (!missing.empty()) {
    throw ToolError(
        ExitStatus::kInvalidInput,
        fmt::format("{0} of {1} parts are missing: {2}; tvg encode --plan {3} --part {4} makes {5}",
                    missing.size(), plan.parts.size(), fmt::join(missing, ", "), plan_path, missing.front(),
                    join.inputs[missing.front() - 1]));
  }
  for (std::size_t number = 1; number <= plan.parts.size(); ++number) {
    const std::string& file = join.inputs[number - 1];
    if (mark_in(file) != mark_of(plan_id, number, plan.parts.size())) {
      throw ToolError(
          ExitStatus::kInvalidInput,
          fmt::format("{0}: this is not {1} by {2}, but another stream, or made by a plan that was "
                      "there before; tvg encode --plan {2} --part {3} makes it",
                      file, plan.name_of_part(number), plan_path, number));
    }
  }
  return join;
}

JoinInput open_join_input(const std::string& path) {
  if (is_address(path)) {
    const std::shared_ptr<RemoteStream> remote = open_remote_stream(path);
    return {remote->name(),
            [remote, at = std::uint64_t{0}](std::span<std::uint8_t> bytes) mutable -> Result<std::size_t> {
              const std::size_t count = remote->read(at, bytes);
              at += count;
              return count;
            }};
  }
  auto file = std::make_shared<InputFile>(path);
  return {file->name(), [file](std::span<std::uint8_t> bytes) -> Result<std::size_t> {
            return file->read(bytes.data(), bytes.size());
          }};
}

}  // namespace tvg::cli
