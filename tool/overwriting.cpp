#include "tool/overwriting.hpp"

#include "tool/tool_error.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <iostream>
#include <unistd.h>

namespace tvg::cli {

namespace {

bool may_overwrite = false;

}  // namespace

void overwrite_without_asking() {
  may_overwrite = true;
}

void confirm_overwriting(const std::string& path) {
  if (may_overwrite || isatty(STDERR_FILENO) == 0) return;
  if (isatty(STDIN_FILENO) != 0) {
    fmt::print(stderr, "{} exists; overwrite it (y/n)? ", path);
    std::string answer;
    std::getline(std::cin, answer);
    may_overwrite = answer == "y" || answer == "Y" || answer == "yes";
    if (may_overwrite) return;
  }
  throw ToolError(ExitStatus::kIo, fmt::format("{} exists and is kept; --force overwrites it", path));
}

std::string default_output(const std::string& name, const std::string& ending) {
  namespace fs = std::filesystem;
  if (name == "-" || name.empty())
    throw ToolError(ExitStatus::kUsage, "--output is required where input comes from standard input");
  // Of an address its last part, here.
  const bool is_address = name.find("://") != std::string::npos;
  std::string stem = is_address ? name.substr(name.rfind('/') + 1) : name;
  if (is_address || !fs::exists(stem))
    stem.resize(std::min(stem.find_first_of(is_address ? "?#" : "%#"), stem.size()));
  while (stem.size() > 1 && stem.back() == '/') stem.pop_back();
  fs::path path(stem);
  if (!fs::is_directory(path)) path.replace_extension();
  std::string file = path.filename().string();
  while (!file.empty() && (file.back() == '_' || file.back() == '.' || file.back() == '-')) file.pop_back();
  // A pattern may be all number (%04d/mesh.obj): then the folder gives the name.
  if (file.empty())
    return default_output(path.has_parent_path() ? path.parent_path().string() : "out", ending);
  return (path.parent_path() / (file + ending)).string();
}

}  // namespace tvg::cli
