
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <tvg/decoder.hpp>
#include <tvg/join.hpp>
#include <tvg/relay.hpp>

// Streams of another writer than the encoder, each of which breaks one rule of the specification that a byte
// can break (corpus/conformance/negative).
namespace tvg {
namespace {

const std::filesystem::path kFolder = std::filesystem::path(TVG_CONFORMANCE_FOLDER) / "negative";

struct Negative {
  std::string name, error, section;
  std::uint64_t frames = 0;  ///< that can be trusted
};

std::vector<Negative> negatives() {
  std::ifstream file(kFolder / "negative.txt");
  std::vector<Negative> list;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line.front() == '#') continue;
    Negative entry;
    std::istringstream(line) >> entry.name >> entry.error >> entry.section >> entry.frames;
    for (char& letter : entry.error) letter = static_cast<char>(std::tolower(letter));
    list.push_back(entry);
  }
  return list;
}

std::vector<std::uint8_t> bytes_of(const Negative& stream) {
  std::ifstream file(kFolder / (stream.name + ".tvg"), std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// What a decoder makes of a stream.
struct Verdict {
  std::optional<Error> error;  ///< the first
  std::uint64_t frames = 0;    ///< given out and not taken back
};

void take_damage(const Damage& damage, std::vector<bool>& trusted, Verdict& verdict) {
  if (!verdict.error) verdict.error = damage.error;
  for (std::uint64_t f = damage.first_frame;
       f < damage.first_frame + damage.frame_count && f < trusted.size(); ++f)
    trusted[static_cast<std::size_t>(f)] = false;
}

/// Decodes a stream that comes in pieces of so many bytes.
Verdict decode(std::span<const std::uint8_t> stream, std::size_t piece) {
  DecoderLimits limits;
  limits.packet_bytes = 1u << 28;
  Decoder decoder(limits);
  Verdict verdict;
  std::vector<bool> trusted(64);
  for (;;) {
    switch (decoder.poll()) {
      case Decoder::Event::kNeedBytes:
        if (stream.empty()) decoder.finish();
        decoder.push(stream.first(std::min(piece, stream.size())));
        stream = stream.subspan(std::min(piece, stream.size()));
        break;
      case Decoder::Event::kFrame:
        trusted.at(static_cast<std::size_t>(decoder.frame_number())) = true;
        break;
      case Decoder::Event::kDamage:
        take_damage(decoder.damage(), trusted, verdict);
        break;
      case Decoder::Event::kError:
        if (!verdict.error) verdict.error = decoder.error();
        [[fallthrough]];
      case Decoder::Event::kEnd:
        verdict.frames = static_cast<std::uint64_t>(std::count(trusted.begin(), trusted.end(), true));
        return verdict;
      default:
        break;
    }
  }
}

/// Whether a decoder may name another section: what is wrong with a varint it tells with what that stands in,
/// with the coded sections of a mesh with the section; and behind an index outside its lattice, or a
/// coefficient out of range, a packet or a group no longer ends where it should.
bool may_be_told_otherwise(const std::string& expected, const std::string& section) {
  static const std::set<std::string> kCoded = {"§5.3", "§5.7", "§5.7.7", "§5.8", "§5.9"};
  return expected == "§2.2" || section == "§5.1" || section == "§5.2" ||
         (expected == "§6.1" && kCoded.contains(section)) || (expected == "§5.7" && section == "§5.7.7") ||
         ((expected == "§7.5" || expected == "§7.8.2") && section == "§6.1");
}

TEST(NegativeStreams, AreAsManyAsTheListSays) {
  EXPECT_GT(negatives().size(), 200u);
  const std::filesystem::directory_iterator files(kFolder);
  EXPECT_EQ(std::count_if(begin(files), end(files),
                          [](const auto& file) { return file.path().extension() == ".tvg"; }),
            static_cast<std::ptrdiff_t>(negatives().size()));
}

TEST(NegativeStreams, AreRefusedWithTheRuleTheyBreakAndNoFrameMoreIsLost) {
  for (const Negative& expected : negatives()) {
    const std::vector<std::uint8_t> stream = bytes_of(expected);
    for (const std::size_t piece : {std::size_t{1}, std::size_t{1} << 16}) {
      const Verdict verdict = decode(stream, piece);
      ASSERT_TRUE(verdict.error) << expected.name;
      EXPECT_EQ(error_name(verdict.error->code), expected.error)
          << expected.name << ": " << verdict.error->describe();
      const std::string section = verdict.error->section;
      if (!may_be_told_otherwise(expected.section, section)) {
        EXPECT_EQ(section, expected.section) << expected.name << ": " << verdict.error->describe();
      }
      EXPECT_EQ(verdict.frames, expected.frames) << expected.name << ": " << verdict.error->describe();
    }
  }
}

/// What join() makes of a stream, where it takes it.
std::optional<std::vector<std::uint8_t>> joined(std::span<const std::uint8_t> stream) {
  std::vector<JoinInput> inputs(1);
  inputs[0].read = [&stream](std::span<std::uint8_t> bytes) -> Result<std::size_t> {
    const std::size_t count = std::min(bytes.size(), stream.size());
    std::copy_n(stream.begin(), count, bytes.begin());
    stream = stream.subspan(count);
    return count;
  };
  std::vector<std::uint8_t> result;
  const Result<JoinReport> report =
      join(std::move(inputs), {}, [&result](std::span<const std::uint8_t> bytes) {
        result.insert(result.end(), bytes.begin(), bytes.end());
        return Status();
      });
  return report ? std::optional(result) : std::nullopt;
}

/// The same of a splitter and an assembler.
std::optional<std::vector<std::uint8_t>> relayed(std::span<const std::uint8_t> stream) {
  std::vector<std::uint8_t> result;
  StreamAssembler assembler([&result](std::span<const std::uint8_t> bytes) {
    result.insert(result.end(), bytes.begin(), bytes.end());
    return Status();
  });
  StreamSplitter splitter;
  if (!splitter.push(stream).ok()) return std::nullopt;
  StreamLimits limits;
  for (;;) {
    const Result<std::optional<StreamPart>> part = splitter.next();
    if (!part) return std::nullopt;
    if (!*part) break;
    const StreamPart& piece = **part;
    Status status;
    if (piece.kind == StreamPart::Kind::kHead) status = assembler.begin(piece.limits, {});
    if (piece.kind == StreamPart::Kind::kMesh) status = assembler.write_mesh(piece.chunk);
    if (piece.kind == StreamPart::Kind::kPlan) status = assembler.write_plan(piece.chunk);
    if (piece.kind == StreamPart::Kind::kGop) status = assembler.write_gop(piece.chunk, piece.frame_count);
    if (piece.kind == StreamPart::Kind::kEnd) status = assembler.end();
    if (!status.ok()) return std::nullopt;
  }
  return splitter.finish().ok() ? std::optional(result) : std::nullopt;
}

TEST(NegativeStreams, AreNotMadeGoodByWhoPassesThemOn) {
  std::size_t refused = 0;
  for (const Negative& negative : negatives()) {
    const std::vector<std::uint8_t> stream = bytes_of(negative);
    for (const auto& passed_on : {joined(stream), relayed(stream)}) {
      if (!passed_on) {
        ++refused;
      } else {  // only decoding tells, and it still does
        EXPECT_TRUE(decode(*passed_on, 1u << 16).error) << negative.name;
      }
    }
  }
  EXPECT_GT(2 * refused, negatives().size()) << "many faults are seen without decoding";
}

}  // namespace
}  // namespace tvg
