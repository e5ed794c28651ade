#include "judge.hpp"
#include "repair.hpp"

#include <functional>
#include <gtest/gtest.h>
#include <numeric>

namespace tvg::corruption {
namespace {

using Stream = std::vector<std::uint8_t>;

void append(Stream& target, const Stream& source, Extent extent) {
  const auto begin = source.begin() + static_cast<std::ptrdiff_t>(extent.begin);
  target.insert(target.end(), begin, begin + static_cast<std::ptrdiff_t>(extent.size));
}

/// The stream with a GOP's packets put down in another order; a number may come twice, or not at all.
Stream with_packets(const Stream& stream, const ChunkExtent& gop, const std::vector<std::size_t>& order) {
  Stream result(stream.begin(), stream.begin() + static_cast<std::ptrdiff_t>(gop.packets.front().begin));
  for (const std::size_t k : order) append(result, stream, gop.packets[k]);
  const std::size_t end = gop.packets.back().end();
  append(result, stream, {end, stream.size() - end});
  return result;
}

/// The stream with its chunks in another order.
Stream with_chunks(const Stream& stream, const std::vector<ChunkExtent>& chunks,
                   const std::vector<std::size_t>& order) {
  Stream result(stream.begin(), stream.begin() + 8);
  for (const std::size_t k : order) append(result, stream, chunks[k].whole);
  return result;
}

std::vector<std::size_t> counted(std::size_t count) {
  std::vector<std::size_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  return numbers;
}

/// Damages the packets of every GOP of the stream, one place at a time. `first_bad` is the number of the
/// first packet that is not where it belongs: the frames from there on to the GOP's end must be lost, no
/// others.
void damage_packets(const std::function<void(std::vector<std::size_t>&, std::size_t)>& damage,
                    std::size_t first_bad_offset) {
  for (const std::string_view name : {"gops", "hybrid_time", "pipe", "elp", "basis"}) {
    const Original original = make_original(name);
    std::uint64_t gop_begin = 0;
    for (const ChunkExtent& gop : find_chunks(original.stream)) {
      if (gop.type != 'G') continue;
      const std::uint64_t frames = gop.packets.size() - 2;
      for (std::size_t k = 0; k + 1 < gop.packets.size(); ++k) {
        std::vector<std::size_t> order = counted(gop.packets.size());
        damage(order, k);
        const Verdict verdict = judge(original, with_packets(original.stream, gop, order));
        const std::size_t first_bad = k + first_bad_offset;
        const std::uint64_t intact = first_bad == 0 ? 0 : std::min<std::uint64_t>(first_bad - 1, frames);
        ASSERT_TRUE(verdict.wrong.empty()) << name << ", packet " << k;
        ASSERT_FALSE(verdict.reports.empty()) << name << ", packet " << k;
        ASSERT_FALSE(verdict.error) << name << ", packet " << k;
        for (std::uint64_t f = 0; f < original.frames.size(); ++f) {
          const bool lost = f >= gop_begin + intact && f < gop_begin + frames;
          ASSERT_EQ(verdict.reported(f), lost) << name << ", packet " << k << ", frame " << f;
        }
        ASSERT_EQ(verdict.exact.size(), original.frames.size() - (frames - intact)) << name << ", " << k;
      }
      gop_begin += frames;
    }
  }
}

TEST(StructureDamage, ADroppedPacketLosesExactlyTheFramesThatNeedIt) {
  damage_packets(
      [](auto& order, std::size_t k) { order.erase(order.begin() + static_cast<std::ptrdiff_t>(k)); }, 0);
}

TEST(StructureDamage, ADoubledPacketLosesExactlyTheFramesBehindIt) {
  damage_packets(
      [](auto& order, std::size_t k) { order.insert(order.begin() + static_cast<std::ptrdiff_t>(k), k); }, 1);
}

TEST(StructureDamage, SwappedPacketsLoseExactlyTheFramesFromThereOn) {
  damage_packets([](auto& order, std::size_t k) { std::swap(order[k], order[k + 1]); }, 0);
}

/// Every way to drop, double or swap chunks: the index or the order of chunks is wrong then, and that is said
/// even where all frames are right.
void expect_reported(const Original& original, const Stream& damaged, const std::string& what) {
  const Verdict verdict = judge(original, damaged);
  EXPECT_FALSE(verdict.called_valid()) << what;
}

TEST(StructureDamage, ChunksDroppedDoubledOrSwappedAreNeverSilent) {
  for (const std::string_view name :
       {"gops", "hybrid_time", "pipe", "metadata", "two_meshes", "basis", "basis_and_elp"}) {
    const Original original = make_original(name);
    const std::vector<ChunkExtent> chunks = find_chunks(original.stream);
    for (std::size_t k = 0; k < chunks.size(); ++k) {
      const std::string at = std::string(name) + ", chunk " + std::to_string(k);
      std::vector<std::size_t> dropped = counted(chunks.size());
      dropped.erase(dropped.begin() + static_cast<std::ptrdiff_t>(k));
      expect_reported(original, with_chunks(original.stream, chunks, dropped), at + " dropped");
      std::vector<std::size_t> doubled = counted(chunks.size());
      doubled.insert(doubled.begin() + static_cast<std::ptrdiff_t>(k), k);
      expect_reported(original, with_chunks(original.stream, chunks, doubled), at + " doubled");
      for (std::size_t j = k + 1; j < chunks.size(); ++j) {
        std::vector<std::size_t> swapped = counted(chunks.size());
        std::swap(swapped[k], swapped[j]);
        // GOPs of one length fit the index in either order: only the labels of their frames tell.
        if (chunks[j].whole.size == chunks[k].whole.size) continue;
        expect_reported(original, with_chunks(original.stream, chunks, swapped),
                        at + " swapped with " + std::to_string(j));
      }
    }
  }
}

/// Each plan of a stream of several, damaged in one place after the other: the frames of the GOPs behind it,
/// up to the next plan, are reported lost, and all others are exact.
void damage_plans(std::string_view name, bool repaired) {
  const Original original = make_original(name);
  const std::vector<ChunkExtent> chunks = find_chunks(original.stream);
  std::size_t plans = 0;
  for (std::size_t k = 0; k < chunks.size(); ++k) {
    if (chunks[k].type != 'P') continue;
    ++plans;
    std::vector<std::pair<std::uint64_t, bool>> gops;  // frames, and whether they need the plan
    bool needed = false;
    for (std::size_t i = 0; i < chunks.size(); ++i) {
      if (chunks[i].type == 'P' || chunks[i].type == 'M') needed = i == k;
      if (chunks[i].type == 'G') gops.emplace_back(chunks[i].packets.size() - 2, needed);
    }
    // Behind its fields up to the scales, whose damage not every digest tells.
    const std::size_t begin = chunks[k].whole.begin + (repaired ? 100 : 0);
    const std::size_t end_of_damage =
        chunks[k].whole.end() - (repaired ? 4 : 0);  // what is repaired is no damage
    for (std::size_t at = begin; at < end_of_damage; at += 3) {
      Stream damaged = original.stream;
      damaged[at] ^= 0x10;
      if (repaired) repair_checksums(damaged);
      const Verdict verdict = judge(original, damaged);
      ASSERT_TRUE(verdict.wrong.empty()) << name << ", chunk " << k << ", byte " << at;
      ASSERT_FALSE(verdict.error) << name << ", chunk " << k << ", byte " << at;
      std::uint64_t frame = 0;
      for (const auto& [frames, lost] : gops) {
        for (const std::uint64_t end = frame + frames; frame < end; ++frame)
          ASSERT_EQ(verdict.reported(frame), lost) << name << ", byte " << at << ", frame " << frame;
      }
    }
  }
  EXPECT_GE(plans, 1u);
}

TEST(StructureDamage, ADamagedPlanLosesExactlyTheFramesOfItsGops) {
  for (const std::string_view name : {"basis", "basis_hybrid", "basis_error", "basis_and_elp"})
    damage_plans(name, false);
}

TEST(StructureDamage, APlanOfOtherValuesBehindFittingChecksumsLosesTheFramesOfItsGops) {
  for (const std::string_view name : {"basis", "basis_error"}) damage_plans(name, true);
}

/// Bytes in the middle are gone, as when a download lost a piece: decoding finds its way back.
TEST(StructureDamage, ALostPieceIsReportedAndOtherGopsAreExact) {
  const Original original = make_original("gops");
  const std::size_t size = original.stream.size();
  const std::size_t first_gop = find_chunks(original.stream)[2].whole.begin;
  for (std::size_t begin = first_gop; begin + 40 < size; begin += 3) {
    Stream damaged(original.stream.begin(), original.stream.begin() + static_cast<std::ptrdiff_t>(begin));
    append(damaged, original.stream, {begin + 40, size - begin - 40});
    const Verdict verdict = judge(original, damaged);
    ASSERT_FALSE(verdict.called_valid()) << begin;
    ASSERT_TRUE(verdict.wrong.empty()) << begin;
    ASSERT_GE(verdict.exact.size() + 4, original.frames.size()) << begin;  // at most two GOPs are hit
  }
}

}  // namespace
}  // namespace tvg::corruption
