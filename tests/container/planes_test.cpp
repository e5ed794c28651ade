#include "container/chunk_reader.hpp"
#include "plan_streams.hpp"

#include <algorithm>
#include <array>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include <tvg/stream_map.hpp>

// Planes that several GOPs share, up to the door of their mode.
namespace tvg {
namespace {

using test::PlanStream;
using test::some_gop;
using test::some_mesh;
using test::some_plan;
using Buffer = std::vector<std::uint8_t>;
using Event = ChunkReader::Event;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const Buffer kMesh = some_mesh(1), kOtherMesh = some_mesh(2);
const Buffer kPlan = some_plan(kMesh, 1), kSecondPlan = some_plan(kMesh, 2), kThirdPlan = some_plan(kMesh, 3);
const Buffer kOtherPlan = some_plan(kOtherMesh, 4);

/// What a reader gives of planes and of GOPs.
struct Reading {
  std::vector<std::uint32_t> plans;  ///< ids, as they are given out
  std::size_t gops = 0, lost = 0;    ///< whole ones, and those that cannot be decoded
  std::vector<Error> problems;       ///< those of lost GOPs too
  std::vector<IndexEntry> index;
  bool index_matches = false;
  bool complete = false;

  void take(ChunkReader& reader, Event event) {
    if (event == Event::kPlan) plans.push_back(reader.plan_id());
    if (event == Event::kGopEnd) ++gops;
    if (event == Event::kGopLost) ++lost;
    if (event == Event::kGopLost || event == Event::kProblem) problems.push_back(reader.problem().error);
    if (event == Event::kIndex) {
      index_matches = reader.index_matches();
      index = reader.take_index();
    }
    complete = event == Event::kEnd;
  }
};

Reading read_all(Bytes stream, std::size_t piece = 1000000) {
  ChunkReader reader{DecoderLimits()};
  Reading reading;
  for (;;) {
    const Event event = reader.next();
    if (event == Event::kNeedBytes) {
      const Bytes next = stream.first(std::min(piece, stream.size()));
      stream = stream.subspan(next.size());
      if (next.empty()) reader.finish();
      EXPECT_TRUE(reader.push(next));
      continue;
    }
    reading.take(reader, event);
    if (event == Event::kEnd || event == Event::kFailed) return reading;
  }
}

std::vector<std::string> messages(const Reading& reading) {
  std::vector<std::string> all;
  for (const Error& error : reading.problems) all.push_back(error.message);
  return all;
}

/// A stream of these chunks, in force as they may be, without an end.
Buffer stream_of(const std::vector<Buffer>& chunks, std::uint32_t meshes = 2, std::uint32_t plans = 2) {
  Buffer stream;
  StreamWriter writer([&stream](Bytes bytes) {
    stream.insert(stream.end(), bytes.begin(), bytes.end());
    return Status();
  });
  EXPECT_TRUE(writer.write_start(test::limits_with_plans(meshes, plans), {}).ok());
  for (const Buffer& chunk : chunks) EXPECT_TRUE(writer.write(chunk).ok());
  return stream;
}

Buffer plan_with(PlanHeader header) {
  header.mesh = chunk_id(kMesh);
  return write_chunk(kPlanChunk, false, write_plan(header));
}

Buffer whole_stream() {
  return PlanStream(1, 2)
      .mesh(kMesh)
      .plan(kPlan)
      .gop(kMesh, {kPlan})
      .plan(kSecondPlan)
      .gop(kMesh, {kPlan})
      .gop(kMesh, {kSecondPlan})
      .gop(kMesh, {kSecondPlan, kPlan})
      .mesh(kOtherMesh)
      .plan(kOtherPlan)
      .gop(kOtherMesh, {kOtherPlan})
      .end();
}

TEST(Planes, AreGivenOutWholeAndTheIndexLeadsBackToThem) {
  const Buffer stream = whole_stream();
  for (const std::size_t piece : {1u, 7u, 1000000u}) {
    const Reading reading = read_all(stream, piece);
    EXPECT_TRUE(reading.complete);
    EXPECT_TRUE(reading.index_matches);
    EXPECT_THAT(messages(reading), IsEmpty());
    EXPECT_EQ(reading.gops, 5u);
    EXPECT_THAT(reading.plans, ElementsAre(chunk_id(kPlan), chunk_id(kSecondPlan), chunk_id(kOtherPlan)));
    ASSERT_EQ(reading.index.size(), 10u);
    EXPECT_THAT(reading.index[2].planes_back.numbers(), ElementsAre(1u));
    EXPECT_THAT(reading.index[4].planes_back.numbers(), ElementsAre(2u));
    EXPECT_THAT(reading.index[6].planes_back.numbers(), ElementsAre(1u, 2u));
  }
}

TEST(Planes, StayWithWhatWasMadeOfThemAsLongAsTheyAreInForce) {
  const Buffer stream = stream_of({kMesh, kPlan, kPlan, kSecondPlan});
  ChunkReader reader{DecoderLimits()};
  ASSERT_TRUE(reader.push(stream));
  std::size_t met = 0;
  for (Event event = reader.next(); event != Event::kNeedBytes; event = reader.next()) {
    if (event != Event::kPlan) continue;
    EXPECT_EQ(reader.plan().mesh, chunk_id(kMesh));
    EXPECT_EQ(reader.plan().mode, kModeBasis);
    EXPECT_EQ(reader.plan().fields.size(), 20u);
    if (++met == 1) reader.keep(std::make_shared<const int>(5));
    if (met == 2) {
      EXPECT_NE(reader.plans().find(reader.plan_id())->content, nullptr);
    }
  }
  EXPECT_EQ(met, 3u);
  EXPECT_EQ(reader.plans().find(chunk_id(kSecondPlan))->content, nullptr);
}

TEST(Planes, ThatCannotBeUsedCostTheGopsThatNameThemAndNoOther) {
  const struct {
    Buffer plan;
    std::size_t problems;  ///< of the planes themselves
    ErrorCode code;        ///< of the GOP that names them
  } cases[] = {
      {plan_with({.adds_to = 1, .mode = kModeBasis, .fields = {}}), 1, ErrorCode::kMalformed},
      {plan_with({.adds_to = std::uint64_t{1} << 33, .mode = kModeBasis, .fields = {}}), 1,
       ErrorCode::kMalformed},
      {plan_with({.adds_to = chunk_id(kSecondPlan) + 1u, .mode = 9, .fields = {}}), 1, ErrorCode::kMalformed},
      {some_plan(kMesh, 1, 300), 1, ErrorCode::kLimitExceeded},
      {some_plan(kOtherMesh, 1), 1, ErrorCode::kMalformed},
      {write_chunk(kPlanChunk, false, Buffer{1, 2, 3}), 1, ErrorCode::kMalformed},
      {plan_with({.mode = 9, .fields = {}}), 0, ErrorCode::kMalformed},
  };
  for (const auto& [plan, problems, code] : cases) {
    const Reading reading = read_all(
        stream_of({kMesh, kSecondPlan, plan, some_gop(kMesh, {plan}, 0), some_gop(kMesh, {kSecondPlan}, 2)}));
    EXPECT_EQ(reading.lost, 1u);
    EXPECT_EQ(reading.gops, 1u);
    ASSERT_EQ(reading.problems.size(), problems + 1);
    EXPECT_EQ(reading.problems.back().code, code) << reading.problems.back().message;
  }
}

TEST(Planes, AreInForceUntilOthersOrTheirMeshFollow) {
  const auto gop = [](const Buffer& plan) { return some_gop(kMesh, {plan}, 0); };
  const Reading third = read_all(
      stream_of({kMesh, kPlan, kSecondPlan, kThirdPlan, gop(kThirdPlan), gop(kSecondPlan), gop(kPlan)}));
  EXPECT_EQ(third.gops, 2u);
  EXPECT_THAT(messages(third), ElementsAre(HasSubstr("not in force")));
  const Reading again =
      read_all(stream_of({kMesh, kPlan, kSecondPlan, kPlan, kThirdPlan, gop(kPlan), gop(kSecondPlan)}));
  EXPECT_EQ(again.gops, 1u) << "what comes again is the latest";
  const Reading other_mesh = read_all(stream_of({kMesh, kPlan, kOtherMesh, gop(kPlan)}));
  EXPECT_EQ(other_mesh.gops, 1u);
  const Reading same_mesh = read_all(stream_of({kMesh, kPlan, kMesh, gop(kPlan), kPlan, gop(kPlan)}));
  EXPECT_EQ(same_mesh.gops, 1u);
  EXPECT_THAT(messages(same_mesh), ElementsAre(HasSubstr("not in force")));
}

TEST(Planes, OfAnotherMeshAreNoneOfAGop) {
  const Reading reading = read_all(
      stream_of({kMesh, kOtherMesh, kOtherPlan, some_gop(kMesh, {kOtherPlan}, 0), some_gop(kMesh, {}, 2)}));
  EXPECT_EQ(reading.gops, 1u) << "how many there must be is for the mode to say";
  EXPECT_THAT(messages(reading), ElementsAre(HasSubstr("another mesh")));
}

TEST(Planes, ThatAreDamagedAreReportedAndLookedBehind) {
  Buffer damaged = kPlan;
  damaged[20] ^= 1;
  const Reading reading =
      read_all(stream_of({kMesh, damaged, some_gop(kMesh, {kPlan}, 0), kPlan, some_gop(kMesh, {kPlan}, 2)}));
  EXPECT_EQ(reading.gops, 1u);
  EXPECT_THAT(messages(reading), ElementsAre(HasSubstr("damaged"), HasSubstr("not in force")));
}

TEST(StreamWriter, WritesPlanesOnceWhileTheyAreInForceAndAgainBehindTheirMesh) {
  const Reading reading = read_all(PlanStream(1, 2)
                                       .mesh(kMesh)
                                       .plan(kPlan)
                                       .gop(kMesh, {kPlan})
                                       .plan(kPlan)
                                       .mesh(kOtherMesh)
                                       .plan(kOtherPlan)
                                       .mesh(kMesh)
                                       .plan(kPlan)
                                       .gop(kMesh, {kPlan})
                                       .end());
  EXPECT_TRUE(reading.index_matches);
  EXPECT_THAT(messages(reading), IsEmpty());
  EXPECT_THAT(reading.plans, ElementsAre(chunk_id(kPlan), chunk_id(kOtherPlan), chunk_id(kPlan)));
}

TEST(StreamWriter, RefusesPlanesWithoutAMeshAndGopsWithoutPlanes) {
  StreamWriter writer([](Bytes) { return Status(); });
  ASSERT_TRUE(writer.write_start(test::limits_with_plans(2, 1), {}).ok());
  EXPECT_EQ(writer.write_plan_chunk(kPlan).error().code, ErrorCode::kInvalidArgument);
  ASSERT_TRUE(writer.write_mesh_chunk(kMesh).ok());
  EXPECT_EQ(writer.write_gop_chunk(some_gop(kMesh, {kPlan}, 0), 2).error().code, ErrorCode::kInvalidArgument);
  ASSERT_TRUE(writer.write_plan_chunk(kPlan).ok());
  EXPECT_TRUE(writer.write_gop_chunk(some_gop(kMesh, {kPlan}, 0), 2).ok());
  Buffer alike = some_plan(kMesh, 9);
  std::copy(kPlan.end() - 4, kPlan.end(), alike.end() - 4);
  EXPECT_EQ(writer.write_plan_chunk(alike).error().code, ErrorCode::kInvalidInput);
}

std::vector<std::uint64_t> offsets_of(const std::vector<IndexEntry>& index,
                                      std::initializer_list<int> places) {
  std::vector<std::uint64_t> offsets;
  for (const int place : places) offsets.push_back(index[static_cast<std::size_t>(place)].offset);
  return offsets;
}

// Mesh, plan, GOP, plan, three GOPs, mesh, plan, GOP: places 0 to 9.
TEST(StreamMapOfPlanes, KnowsWhatAGopAndThoseBehindItNeed) {
  const std::vector<IndexEntry> index = read_all(whole_stream()).index;
  const StreamMap map(index);
  const StreamLimits limits = test::limits_with_plans(1, 2);
  const auto needed = [&](std::size_t place) { return map.needed_for(map.places()[place], limits); };
  EXPECT_EQ(needed(2), offsets_of(index, {0, 1})) << "what follows lies behind it";
  EXPECT_EQ(needed(5), offsets_of(index, {0, 1, 3})) << "the next GOP names the first planes";
  EXPECT_EQ(needed(9), offsets_of(index, {7, 8}));
}

TEST(StreamMapOfPlanes, WithoutAnIndexTakesTheLastOnes) {
  const std::vector<IndexEntry> index = read_all(whole_stream()).index;
  const StreamMap whole(index);
  StreamMap met;
  for (const StreamMap::Place& place : whole.places()) ASSERT_TRUE(met.note(place));
  const StreamLimits limits = test::limits_with_plans(1, 2);
  EXPECT_EQ(met.needed_for(met.places()[9], limits), offsets_of(index, {3, 7, 8}));
}

/// A GOP by what it needs, as a seek reads it: from a place on, to the first GOP.
TEST(Planes, AreReadOnTheWayToAGop) {
  const Buffer stream = whole_stream();
  const std::vector<IndexEntry> index = read_all(stream).index;
  const StreamMap map(index);
  for (const StreamMap::Place& place : map.places()) {
    if (!place.entry.is_gop()) continue;
    ChunkReader reader{DecoderLimits()};
    ASSERT_TRUE(reader.push(Bytes(stream).first(static_cast<std::size_t>(index[0].offset))));
    while (reader.next() != Event::kNeedBytes) {
    }
    const std::vector<std::uint64_t> needed = map.needed_for(place, reader.head().limits);
    std::vector<std::uint64_t> stops = needed;
    stops.push_back(place.entry.offset);
    Reading reading;
    for (const std::uint64_t stop : stops) {
      reader.jump(stop, needed);
      const Bytes rest = Bytes(stream).subspan(static_cast<std::size_t>(stop));
      ASSERT_TRUE(reader.push(rest.first(static_cast<std::size_t>(read_chunk_header(rest)->total_size()))));
      for (Event event = reader.next(); event != Event::kNeedBytes; event = reader.next())
        reading.take(reader, event);
    }
    EXPECT_EQ(reading.gops, 1u);
    EXPECT_THAT(messages(reading), IsEmpty());
  }
}

TEST(PlaneList, ComparesByItsNumbersHoweverManyTheyAre) {
  const std::array<std::uint64_t, 3> numbers = {3, 1, 2};
  for (std::size_t count = 0; count <= numbers.size(); ++count) {
    const auto some = std::span(numbers).first(count);
    const PlaneList list = *PlaneList::of(some);
    EXPECT_TRUE(std::ranges::equal(list.numbers(), some));
    EXPECT_EQ(list, *PlaneList::of(some));
    const PlaneList copy = list;
    EXPECT_EQ(copy, list);
    if (count > 0) {
      EXPECT_FALSE(list == *PlaneList::of(some.first(count - 1)));
    }
  }
}

}  // namespace
}  // namespace tvg
