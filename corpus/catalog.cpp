#include <array>
#include <bit>

#define XXH_INLINE_ALL
#include "corpus/corpus.hpp"

#include <xxhash.h>

namespace tvg::corpus {
namespace {

CorpusSequence hand(const SequenceSize& size) {
  SkinnedSequence made = make_hand(size);
  return {std::move(made.sequence), std::move(made.joints)};
}
CorpusSequence face(const SequenceSize& size) {
  return {make_face(size), std::nullopt};
}
CorpusSequence cloth(const SequenceSize& size) {
  return {make_cloth(size), std::nullopt};
}
CorpusSequence toy(const SequenceSize& size) {
  return {make_toy(size), std::nullopt};
}
CorpusSequence soup(const SequenceSize& size) {
  return {make_soup(size).sequence, std::nullopt};
}

constexpr std::array<CorpusEntry, 5> kEntries = {{
    {"hand", "articulated hand with a skeleton: one closed surface, smooth skinning", hand},
    {"face", "mask that speaks and blinks: only small regions move", face},
    {"cloth", "flag in the wind: one open surface with wrinkles", cloth},
    {"toy", "machine of 36 components that move rigidly", toy},
    {"soup", "non-manifold, isolated, duplicate and degenerate elements", soup},
}};

/// Hashes 32-bit words as little-endian bytes, whatever the machine's own order.
class WordHash {
 public:
  WordHash() { XXH64_reset(&state_, 0); }

  void add(std::span<const std::uint32_t> words) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(words.size() * 4);
    for (const std::uint32_t word : words) {
      for (const int shift : {0, 8, 16, 24}) bytes.push_back(static_cast<std::uint8_t>(word >> shift));
    }
    XXH64_update(&state_, bytes.data(), bytes.size());
  }
  std::uint64_t digest() const { return XXH64_digest(&state_); }

 private:
  XXH64_state_t state_;
};

}  // namespace

std::span<const CorpusEntry> corpus_entries() {
  return kEntries;
}

const CorpusEntry* find_corpus_entry(std::string_view name) {
  for (const CorpusEntry& entry : kEntries) {
    if (entry.name == name) return &entry;
  }
  return nullptr;
}

std::optional<SequenceSize> named_size(std::string_view name) {
  if (name == "small") return SequenceSize{400, 12};
  if (name == "demo") return SequenceSize{6000, 90};
  if (name == "large") return SequenceSize{100000, 60};
  return std::nullopt;
}

std::uint64_t frames_digest(const Sequence& sequence) {
  WordHash hash;
  std::vector<std::uint32_t> words;
  for (const FramePositions& frame : sequence.frames) {
    words.clear();
    for (const float value : frame) words.push_back(std::bit_cast<std::uint32_t>(value));
    hash.add(words);
  }
  return hash.digest();
}

std::uint64_t faces_digest(const Mesh& mesh) {
  WordHash hash;
  for (const Face& face : mesh.faces) hash.add(face);
  return hash.digest();
}

}  // namespace tvg::corpus
