#include "connectivity/vertex_order.hpp"

#include "connectivity/connectivity_encode.hpp"
#include "connectivity/vertex_order_coding.hpp"
#include "connectivity/vertex_order_encode.hpp"
#include "mesh_builders.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>

namespace tvg {
namespace {

std::vector<std::uint32_t> identity(std::uint32_t count) {
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  return order;
}

/// The size of the stream, once it has been found to give the order back.
std::size_t checked_size(const std::vector<std::uint32_t>& order, const std::vector<Gate>& gates) {
  const std::vector<std::uint8_t> bytes = encode_order(order, gates);
  const auto decoded = decode_order(bytes, gates);
  EXPECT_TRUE(decoded && *decoded == order);
  return bytes.size();
}

TEST(VertexOrder, RoundTripOfEverySortOfMesh) {
  for (const test::NamedMesh& named : test::all_sorts_of_meshes()) {
    SCOPED_TRACE(named.name);
    const EncodedConnectivity encoded = encode_connectivity(named.mesh);
    checked_size(encoded.order, encoded.connectivity.gates);
  }
}

TEST(VertexOrder, IdentityCostsOneByte) {
  EXPECT_EQ(checked_size(identity(0), {}), 1u);
  EXPECT_EQ(checked_size(identity(10000), std::vector<Gate>(10000)), 1u);
}

TEST(VertexOrder, RandomOrderCostsHardlyMoreThanItsInformation) {
  std::mt19937 random(11);
  for (const std::uint32_t count : {2u, 100u, 5000u, 70000u}) {
    std::vector<std::uint32_t> order = identity(count);
    std::shuffle(order.begin(), order.end(), random);
    const double information = std::lgamma(count + 1.0) / std::log(2.0);
    EXPECT_LT(8.0 * static_cast<double>(checked_size(order, std::vector<Gate>(count))),
              information * 1.01 + 24);
  }
}

TEST(VertexOrder, RowByRowGridCostsLessThanHalfABitPerVertex) {
  const EncodedConnectivity encoded = encode_connectivity(test::grid(80, 80));
  EXPECT_LT(8.0 * static_cast<double>(checked_size(encoded.order, encoded.connectivity.gates)),
            0.5 * 81 * 81);
}

TEST(VertexOrder, ReversedAndSwappedOrdersRoundTrip) {
  std::vector<std::uint32_t> order = identity(300);
  std::reverse(order.begin(), order.end());
  checked_size(order, std::vector<Gate>(300));
  order = identity(300);
  std::swap(order[298], order[299]);
  checked_size(order, std::vector<Gate>(300));
}

TEST(VertexOrder, DecoderRejectsMissingUnknownAndLongerStreams) {
  const std::vector<Gate> gates(4);
  const std::vector<std::vector<std::uint8_t>> streams = {{}, {3}, {255, 0}, {0, 0}, {1}, {2}};
  for (const std::vector<std::uint8_t>& bytes : streams) {
    const auto decoded = decode_order(bytes, gates);
    ASSERT_FALSE(decoded);
    EXPECT_EQ(decoded.error().code, ErrorCode::kMalformed);
    EXPECT_STREQ(decoded.error().section, "§5.2");
  }
}

TEST(VertexOrder, EveryTruncationIsRejectedAndEveryByteChangeGivesAPermutationOrAnError) {
  std::mt19937 random(13);
  const EncodedConnectivity encoded = encode_connectivity(test::shuffled(test::closed_surface(6, 5), random));
  const std::vector<Gate>& gates = encoded.connectivity.gates;
  const EncodedConnectivity near = encode_connectivity(test::closed_surface(6, 5));
  for (const auto& [order, its_gates] :
       {std::pair{encoded.order, gates}, {near.order, near.connectivity.gates}}) {
    const std::vector<std::uint8_t> bytes = encode_order(order, its_gates);
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      EXPECT_FALSE(decode_order(std::span(bytes).first(length), its_gates)) << length;
    }
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      for (unsigned change = 1; change < 256; ++change) {
        std::vector<std::uint8_t> changed = bytes;
        changed[i] = static_cast<std::uint8_t>(changed[i] ^ change);
        auto decoded = decode_order(changed, its_gates);
        if (!decoded) continue;
        std::sort(decoded->begin(), decoded->end());
        ASSERT_EQ(*decoded, identity(static_cast<std::uint32_t>(its_gates.size())));
      }
    }
  }
}

TEST(IndexSet, RankAndSelectAreInverse) {
  std::mt19937 random(17);
  for (const std::uint32_t size : {1u, 2u, 7u, 8u, 9u, 100u}) {
    IndexSet set(size);
    std::vector<std::uint32_t> members = identity(size);
    while (!members.empty()) {
      for (std::uint32_t i = 0; i < members.size(); ++i) {
        ASSERT_EQ(set.select(i), members[i]);
        ASSERT_EQ(set.rank(members[i]), i);
      }
      ASSERT_EQ(set.rank(size), members.size());
      const std::size_t victim = random() % members.size();
      set.remove(members[victim]);
      members.erase(members.begin() + static_cast<std::ptrdiff_t>(victim));
    }
  }
}

TEST(CodeUniform, EveryValueOfEveryBoundRoundTrips) {
  const auto check = [](std::uint32_t value, std::uint32_t bound) {
    RangeEncoder encoder;
    code_uniform(encoder, value, bound);
    const std::vector<std::uint8_t> bytes = encoder.finish();
    RangeDecoder decoder(bytes);
    ASSERT_EQ(code_uniform(decoder, 0, bound), value);
    ASSERT_TRUE(decoder.finished());
  };
  for (std::uint32_t bound = 1; bound < 70; ++bound) {
    for (std::uint32_t value = 0; value < bound; ++value) check(value, bound);
  }
  for (const std::uint32_t bound : {0x7FFFu, 0x8000u, 0x8001u, 0x7FFFFFFFu, 0x80000000u, 0xFFFFFFFFu}) {
    for (const std::uint32_t value : {0u, 1u, bound / 2, bound - 1}) check(value, bound);
  }
}

TEST(LengthModel, NumbersOfEveryLengthRoundTrip) {
  std::vector<std::uint32_t> values = {0};
  for (int bit = 0; bit < 32; ++bit) {
    values.push_back(1u << bit);
    values.push_back((1u << bit) + ((1u << bit) - 1));
  }
  RangeEncoder encoder;
  LengthModel encoding, decoding;
  for (const std::uint32_t value : values) encoding.code(encoder, value);
  const std::vector<std::uint8_t> bytes = encoder.finish();
  RangeDecoder decoder(bytes);
  for (const std::uint32_t value : values) ASSERT_EQ(decoding.code(decoder, 0), value);
  EXPECT_TRUE(decoder.finished());
}

}  // namespace
}  // namespace tvg
