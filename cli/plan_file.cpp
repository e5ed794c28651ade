#define XXH_INLINE_ALL
#include "cli/plan_file.hpp"

#include "tool/atomic_file.hpp"
#include "tool/tool_error.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>
#include <xxhash.h>

namespace tvg::cli {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr int kPlanVersion = 1;
/// Options whose values are names of files.
constexpr std::array kFileOptions = {"input", "--skeleton", "--weights"};
/// What each machine says for itself, and what is of the plan alone.
constexpr std::array kNotOfParts = {"--threads", "--quiet", "--output", "--parts",
                                    "--force",   "--json",  "--help"};

template <class Names>
bool is_among(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string folder_of(const std::string& path) {
  const std::string folder = fs::path(path).parent_path().string();
  return folder.empty() || folder == "/" ? folder : folder + "/";
}

/// "hand" of "hand.plan.json", as its files are called.
std::string stem_of(const std::string& plan_path) {
  fs::path name = fs::path(plan_path).filename().replace_extension();
  if (name.extension() == ".plan") name.replace_extension();
  return name.string();
}

Json json_of(const BoundingBox& box) {
  return {{"low", box.low()}, {"high", box.high()}};
}

BoundingBox box_of(const Json& value) {
  BoundingBox box;
  for (const char* const corner : {"low", "high"}) {
    const auto at = value.at(corner).get<std::array<double, 3>>();
    box.extend(at[0], at[1], at[2]);
  }
  return box;
}

Json json_of(const EncodePlan& plan) {
  Json value = {{"frames", plan.frames},
                {"frames_at_once", plan.frames_at_once},
                {"box", nullptr},
                {"vertices", plan.vertices},
                {"faces", plan.faces},
                {"property_bytes", plan.property_bytes},
                {"animated_frame_bytes", plan.animated_frame_bytes},
                {"meshes", plan.meshes},
                {"mesh_returns", plan.mesh_returns},
                {"stretches", Json::array()}};
  if (plan.box) value["box"] = json_of(*plan.box);
  for (const SourceStretch& stretch : plan.stretches) {
    value["stretches"].push_back({{"first_frame", stretch.first_frame},
                                  {"frames", stretch.frames},
                                  {"vertices", stretch.vertices},
                                  {"mesh", stretch.mesh_hash},
                                  {"shaped_by", stretch.shaped_by}});
  }
  return value;
}

EncodePlan encode_plan_of(const Json& value) {
  EncodePlan plan;
  plan.frames = value.at("frames");
  plan.frames_at_once = value.at("frames_at_once");
  if (!value.at("box").is_null()) plan.box = box_of(value.at("box"));
  plan.vertices = value.at("vertices");
  plan.faces = value.at("faces");
  plan.property_bytes = value.at("property_bytes");
  plan.animated_frame_bytes = value.at("animated_frame_bytes");
  plan.meshes = value.at("meshes");
  plan.mesh_returns = value.at("mesh_returns");
  for (const Json& stretch : value.at("stretches")) {
    plan.stretches.push_back({stretch.at("first_frame"), stretch.at("frames"), stretch.at("vertices"),
                              stretch.at("mesh"), stretch.at("shaped_by")});
  }
  return plan;
}

Json json_of(const MeshLevels& levels) {
  Json coarse = Json::array();
  for (const CoarseMesh& mesh : levels.coarse)
    coarse.push_back({{"levels", mesh.levels}, {"faces", mesh.faces}});
  return {{"level", levels.level}, {"coarse", std::move(coarse)}};
}

std::shared_ptr<const MeshLevels> levels_of(const Json& value) {
  if (value.is_null()) return nullptr;
  auto levels = std::make_shared<MeshLevels>();
  levels->level = value.at("level").get<std::vector<std::uint8_t>>();
  for (const Json& mesh : value.at("coarse"))
    levels->coarse.push_back({mesh.at("levels"), mesh.at("faces").get<std::vector<Face>>()});
  return levels;
}

/// All that parts depend on.
Json content_of(const PlanFile& plan) {
  Json value = {{"tvg_plan", kPlanVersion}, {"options", plan.options}, {"source", json_of(plan.plan)},
                {"levels", nullptr},        {"parts", Json::array()},  {"output", plan.output}};
  if (plan.levels) value["levels"] = json_of(*plan.levels);
  for (const PlanFile::Part& part : plan.parts) {
    value["parts"].push_back(
        {{"first_frame", part.frames.first}, {"last_frame", part.frames.last}, {"file", part.file}});
  }
  return value;
}

std::string dumped(const Json& value, int indent) {
  return value.dump(indent, ' ', false, Json::error_handler_t::replace);
}

[[noreturn]] void fail_plan(const std::string& path, const std::string& what) {
  throw ToolError(ExitStatus::kInvalidInput,
                  fmt::format("{}: {}; tvg plan writes what is right here", path, what));
}

}  // namespace

std::string PlanFile::path_of(const std::string& file) const {
  return fs::path(file).is_absolute() ? file : folder + file;
}

std::string PlanFile::id() const {
  const std::string text = dumped(content_of(*this), -1);
  return fmt::format("{:016x}", XXH64(text.data(), text.size(), 0));
}

std::string PlanFile::name_of_part(std::size_t number) const {
  const FrameRange& frames = parts[number - 1].frames;
  return fmt::format("part {} of {} (frames {}-{})", number, parts.size(), frames.first, frames.last);
}

std::string option_name(const CLI::Option& option) {
  return option.get_lnames().empty() ? option.get_name() : "--" + option.get_lnames()[0];
}

std::map<std::string, std::vector<std::string>> typed_options(const CLI::App& command,
                                                              const std::string& plan_path) {
  std::map<std::string, std::vector<std::string>> typed;
  const fs::path folder = fs::absolute(plan_path).parent_path();
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option_name(*option);
    if (option->count() == 0 || is_among(kNotOfParts, name)) continue;
    std::vector<std::string> values =
        option->get_type_size() == 0 ? std::vector<std::string>() : option->results();
    if (is_among(kFileOptions, name)) {
      for (std::string& value : values) {
        if (!fs::path(value).is_absolute()) value = fs::absolute(value).lexically_relative(folder).string();
      }
    }
    typed.emplace(name, std::move(values));
  }
  return typed;
}

EncodeArguments arguments_of(const PlanFile& plan) {
  EncodeArguments arguments;
  CLI::App command;
  add_encode_options(command, arguments);
  std::vector<std::string> words, inputs;
  for (const auto& [name, values] : plan.options) {
    const bool is_file = is_among(kFileOptions, name);
    if (values.empty()) words.push_back(name);
    for (const std::string& value : values) {
      const std::string here = is_file ? plan.path_of(value) : value;
      if (name == "input")
        inputs.push_back(here);
      else
        words.push_back(name + "=" + here);
    }
  }
  words.emplace_back("--");
  words.insert(words.end(), inputs.begin(), inputs.end());
  std::reverse(words.begin(), words.end());  // as CLI11 takes them
  try {
    command.parse(words);
  } catch (const CLI::ParseError& error) {
    throw ToolError(ExitStatus::kInvalidInput, fmt::format("the options of the plan: {}", error.what()));
  }
  return arguments;
}

void name_outputs(PlanFile& plan, const std::string& plan_path, const std::vector<FrameRange>& parts) {
  const std::string stem = stem_of(plan_path);
  const std::size_t digits = std::to_string(parts.size()).size();
  plan.folder = folder_of(plan_path);
  plan.output = stem + ".tvg";
  for (std::size_t i = 0; i < parts.size(); ++i) {
    plan.parts.push_back(
        {parts[i], fmt::format("{}.part-{:0{}}-of-{}.tvg", stem, i + 1, digits, parts.size())});
  }
}

void write_plan(const PlanFile& plan, const std::string& path) {
  AtomicFile file(path);
  file.write(dumped(content_of(plan), plan.levels ? -1 : 1) + "\n");
  file.finish();
}

PlanFile read_plan(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw ToolError(ExitStatus::kIo,
                    fmt::format("cannot open {}: {}", path, std::generic_category().message(errno)));
  }
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (file.bad()) throw ToolError(ExitStatus::kIo, fmt::format("cannot read {}", path));
  PlanFile plan;
  plan.folder = folder_of(path);
  try {
    const Json value = Json::parse(text);
    if (value.at("tvg_plan") != kPlanVersion) fail_plan(path, "it is a plan of another version");
    plan.options = value.at("options").get<decltype(plan.options)>();
    plan.plan = encode_plan_of(value.at("source"));
    plan.levels = levels_of(value.at("levels"));
    for (const Json& part : value.at("parts"))
      plan.parts.push_back({{part.at("first_frame"), part.at("last_frame")}, part.at("file")});
    plan.output = value.at("output");
  } catch (const Json::exception& error) {
    fail_plan(path, fmt::format("this is no plan ({})", error.what()));
  }
  if (plan.parts.empty()) fail_plan(path, "the plan has no parts");
  return plan;
}

}  // namespace tvg::cli
