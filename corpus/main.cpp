#include "corpus/corpus.hpp"
#include "corpus/write_cache.hpp"
#include "tool/tool_error.hpp"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

// tvg_corpus: writes the project's own sequences as OBJ + PC2 (+ skeleton).
namespace tvg::corpus {
namespace {

using cli::ExitStatus;
using cli::ToolError;

struct Arguments {
  std::string name;
  std::string folder = ".";
  std::string size = "demo";
  std::uint32_t frames = 0;  ///< 0: as many as the size has by default
  bool list = false;
  bool manifest = false;
};

SequenceSize parse_size(const std::string& text) {
  if (const auto named = named_size(text)) return *named;
  SequenceSize size;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), size.vertices);
  if (error != std::errc{} || end != text.data() + text.size() || size.vertices < 100 ||
      size.vertices > 1000000) {
    throw ToolError(ExitStatus::kUsage,
                    "--size " + text + ": give small, demo, large or 100 to 1000000 vertices");
  }
  return size;
}

void print_list() {
  for (const CorpusEntry& entry : corpus_entries()) {
    std::printf("%-6.*s  %.*s\n", static_cast<int>(entry.name.size()), entry.name.data(),
                static_cast<int>(entry.description.size()), entry.description.data());
  }
}

/// The table of manifest.md.
void print_manifest() {
  for (const char* size_name : {"small", "demo"}) {
    for (const CorpusEntry& entry : corpus_entries()) {
      const Sequence sequence = entry.make(*named_size(size_name)).sequence;
      std::printf("| %.*s | %s | %u | %zu | %zu | %016llx | %016llx |\n", static_cast<int>(entry.name.size()),
                  entry.name.data(), size_name, sequence.mesh.vertex_count, sequence.mesh.faces.size(),
                  sequence.frames.size(), static_cast<unsigned long long>(frames_digest(sequence)),
                  static_cast<unsigned long long>(faces_digest(sequence.mesh)));
    }
  }
}

void make(const Arguments& arguments) {
  const CorpusEntry* entry = find_corpus_entry(arguments.name);
  if (entry == nullptr) {
    throw ToolError(ExitStatus::kUsage,
                    "'" + arguments.name + "' is no sequence; tvg_corpus --list shows them all");
  }
  SequenceSize size = parse_size(arguments.size);
  if (arguments.frames != 0) size.frames = arguments.frames;
  std::error_code failure;
  std::filesystem::create_directories(arguments.folder, failure);
  if (failure) throw ToolError(ExitStatus::kIo, arguments.folder + ": cannot be made: " + failure.message());

  const CorpusSequence made = entry->make(size);
  const std::string stem = (std::filesystem::path(arguments.folder) / arguments.name).string();
  write_obj(stem + ".obj", made.sequence);
  write_pc2(stem + ".pc2", made.sequence);
  if (made.joints) write_skeleton(stem + ".skeleton.json", *made.joints);
  std::printf("%s.obj, .pc2%s: %u vertices, %zu faces, %u frames\n", stem.c_str(),
              made.joints ? ", .skeleton.json" : "", made.sequence.mesh.vertex_count,
              made.sequence.mesh.faces.size(), size.frames);
}

int run(int argc, char** argv) {
  CLI::App app("Makes the project's own animated meshes: the same bits on every machine.", "tvg_corpus");
  Arguments arguments;
  app.add_option("sequence", arguments.name, "Which one (see --list)");
  app.add_option("-o,--output", arguments.folder, "Folder to write into; made if missing")
      ->capture_default_str();
  app.add_option("--size", arguments.size, "small, demo, large or a number of vertices")
      ->capture_default_str();
  app.add_option("--frames", arguments.frames, "Number of frames, at 30 per second")
      ->check(CLI::Range(1U, 10000U));
  app.add_flag("--list", arguments.list, "Name the sequences and stop");
  app.add_flag("--manifest", arguments.manifest, "Print the digests of manifest.md and stop");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitStatus::kUsage);
  }
  if (arguments.list) {
    print_list();
  } else if (arguments.manifest) {
    print_manifest();
  } else if (arguments.name.empty()) {
    throw ToolError(ExitStatus::kUsage, "name a sequence, as in: tvg_corpus hand -o out");
  } else {
    make(arguments);
  }
  return 0;
}

}  // namespace
}  // namespace tvg::corpus

int main(int argc, char** argv) {
  try {
    return tvg::corpus::run(argc, argv);
  } catch (const tvg::cli::ToolError& error) {
    std::fprintf(stderr, "tvg_corpus: %s\n", error.what());
    return static_cast<int>(error.status());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tvg_corpus: %s\n", error.what());
    return static_cast<int>(tvg::cli::ExitStatus::kOther);
  }
}
