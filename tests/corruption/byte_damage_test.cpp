#include "conformance/streams.hpp"
#include "judge.hpp"
#include "repair.hpp"

#include <cstdlib>
#include <gtest/gtest.h>
#include <iostream>
#include <set>

namespace tvg::corruption {
namespace {

/// TVG_EXHAUSTIVE=1 takes every conformance stream and every value of every byte; it takes minutes.
bool exhaustive() {
  return std::getenv("TVG_EXHAUSTIVE") != nullptr;
}

std::vector<std::string_view> damaged_streams() {
  if (!exhaustive())
    return {"metadata",         "step",           "hybrid_time", "gops",       "two_meshes",
            "meshes_again",     "pyramid_hybrid", "lossless",    "basis",      "basis_hybrid",
            "unknown_chunk",    "levels",         "lods@1",      "lods_basis", "lods_basis@1",
            "attributes_shape", "shape",          "animated"};
  std::vector<std::string_view> names;
  for (const auto& stream : conformance::conformance_streams()) names.push_back(stream.name);
  return names;
}

#ifdef __SANITIZE_ADDRESS__
constexpr bool kSlow = true;
#else
constexpr bool kSlow = false;
#endif

/// What the byte at this place is changed by, with exclusive or: all of four, or one of them under
/// sanitizers.
std::vector<std::uint8_t> changes_at(std::size_t place) {
  const std::vector<std::uint8_t> some = {0x01, 0x10, 0x80, 0xFF};
  if (!exhaustive()) return kSlow ? std::vector{some[place % some.size()]} : some;
  std::vector<std::uint8_t> all;
  for (int change = 1; change < 256; ++change) all.push_back(static_cast<std::uint8_t>(change));
  return all;
}

/// What a decoder may hold: what the stream declares, and the bytes it was given.
std::size_t allowed_memory(const Original& original) {
  return static_cast<std::size_t>(original.declared_memory) + 4 * original.stream.size();
}

TEST(ByteDamage, EveryTruncationIsReportedAndWhatCameBeforeItIsExact) {
  Tally tally;
  for (const std::string_view name : damaged_streams()) {
    const Original original = make_original(name);
    for (std::size_t size = 0; size < original.stream.size(); ++size) {
      // In a buffer of its own, so that sanitizers see a read past its end.
      const std::vector<std::uint8_t> cut(original.stream.data(), original.stream.data() + size);
      const Verdict verdict = judge(original, cut, size % 3 == 0 ? 7 : cut.size() + 1);
      tally.add(original, verdict);
      ASSERT_TRUE(verdict.error) << name << " cut to " << size << " bytes";
      ASSERT_TRUE(verdict.wrong.empty()) << name << " cut to " << size << " bytes";
      ASSERT_LE(verdict.memory, allowed_memory(original)) << name << " cut to " << size << " bytes";
    }
  }
  std::cout << "truncations: " << tally.text() << '\n';
}

TEST(ByteDamage, NoChangeOfAByteIsSilent) {
  Tally tally;
  for (const std::string_view name : damaged_streams()) {
    const Original original = make_original(name);
    std::vector<std::uint8_t> damaged = original.stream;
    for (std::size_t i = 0; i < damaged.size(); ++i) {
      for (const std::uint8_t change : changes_at(i)) {
        damaged[i] ^= change;
        const Verdict verdict = judge(original, damaged);
        damaged[i] ^= change;
        tally.add(original, verdict);
        ASSERT_FALSE(verdict.called_valid()) << name << ", byte " << i << " ^ " << +change;
        ASSERT_LE(verdict.memory, allowed_memory(original)) << name << ", byte " << i << " ^ " << +change;
      }
    }
  }
  EXPECT_EQ(tally.called_valid, 0u);
  std::cout << "changed bytes: " << tally.text() << '\n';
}

/// With checksums made to fit, only the digest is left to tell that a frame is wrong.
TEST(ByteDamage, AWrongFrameBehindFittingChecksumsIsReportedByTheDigest) {
  Tally tally;
  for (const std::string_view name : damaged_streams()) {
    const Original original = make_original(name);
    for (const ChunkExtent& chunk : find_chunks(original.stream)) {
      for (std::size_t k = 1; k + 1 < chunk.packets.size(); ++k) {
        for (std::size_t i = chunk.packets[k].begin + 1; i + 4 < chunk.packets[k].end(); ++i) {
          for (const std::uint8_t change : changes_at(i)) {
            std::vector<std::uint8_t> damaged = original.stream;
            damaged[i] ^= change;
            repair_checksums(damaged);
            const Verdict verdict = judge(original, damaged);
            tally.add(original, verdict);
            for (const std::uint64_t frame : verdict.wrong) {
              ASSERT_TRUE(verdict.reported(frame))
                  << name << ", byte " << i << " ^ " << +change << ": frame " << frame;
            }
          }
        }
      }
    }
  }
  EXPECT_EQ(tally.called_valid, 0u);
  std::cout << "changed residuals, checksums repaired: " << tally.text() << '\n';
}

/// A forged stream may decode to anything, but not to more than it declares.
TEST(ByteDamage, BehindFittingChecksumsNothingTakesMoreMemoryThanDeclared) {
  Tally tally;
  for (const std::string_view name : damaged_streams()) {
    const Original original = make_original(name);
    const std::size_t head_end = find_chunks(original.stream).front().whole.end();
    for (std::size_t i = head_end; i < original.stream.size(); ++i) {
      for (const std::uint8_t change : changes_at(i)) {
        std::vector<std::uint8_t> damaged = original.stream;
        damaged[i] ^= change;
        repair_checksums(damaged);
        const Verdict verdict = judge(original, damaged);
        tally.add(original, verdict);
        ASSERT_LE(verdict.memory, allowed_memory(original)) << name << ", byte " << i << " ^ " << +change;
      }
    }
  }
  std::cout << "forged streams: " << tally.cases << " cases, at most " << tally.most_memory << " bytes\n";
}

TEST(ByteDamage, AFailedAllocationIsAnErrorLikeAnother) {
  for (const std::string_view name :
       {"hybrid_time", "two_meshes", "metadata", "basis_and_elp", "lods_basis@1"}) {
    const Original original = make_original(name);
    const std::size_t peak = judge(original, original.stream).memory;
    std::set<ErrorCode> errors;
    for (std::size_t cap = 0; cap < peak; cap += 1 + peak / 500) {
      const Verdict verdict = judge(original, original.stream, 64, cap);
      ASSERT_TRUE(verdict.wrong.empty()) << name << ", " << cap << " bytes";
      if (verdict.error) errors.insert(*verdict.error);
    }
    EXPECT_EQ(errors, std::set<ErrorCode>{ErrorCode::kOutOfMemory}) << name;
  }
}

}  // namespace
}  // namespace tvg::corruption
