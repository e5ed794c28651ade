#include "container/data_payload.hpp"

#include "structures_toolbox.hpp"

#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <zstd.h>

namespace tvg {
namespace {

CodedData read_back(const Buffer& payload) {
  CodedData data;
  const Fault fault = read_data(payload, data);
  EXPECT_FALSE(fault) << fault.sentence;
  return data;
}

Buffer zstd_frame(const Buffer& bytes) {
  Buffer frame(ZSTD_compressBound(bytes.size()));
  frame.resize(ZSTD_compress(frame.data(), frame.size(), bytes.data(), bytes.size(), 3));
  return frame;
}

CodedData coded(const Buffer& frame, std::uint64_t decoded_size) {
  return {"x", DataEncoding::kZstd, decoded_size, frame};
}

TEST(Data, ThatRepeatAreCompressedAndComeBack) {
  const NamedData given{"extras", Buffer(5000, 'a')};
  const Buffer payload = write_data(given);
  EXPECT_LT(payload.size(), 100u);
  const CodedData data = read_back(payload);
  EXPECT_EQ(data.encoding, DataEncoding::kZstd);
  EXPECT_EQ(data.decoded_size, 5000u);
  const Result<NamedData> unpacked = unpack_data(data);
  ASSERT_TRUE(unpacked) << unpacked.error().describe();
  EXPECT_EQ(*unpacked, given);
}

TEST(Data, ThatDoNotRepeatAreStored) {
  std::mt19937 random(1);
  NamedData given{"image/leaf.png", Buffer(3000)};
  for (std::uint8_t& byte : given.bytes) byte = static_cast<std::uint8_t>(random());
  for (const std::size_t size : {std::size_t{3000}, std::size_t{1}, std::size_t{0}}) {
    given.bytes.resize(size);
    const Buffer payload = write_data(given);
    const CodedData data = read_back(payload);
    EXPECT_EQ(data.encoding, DataEncoding::kStored);
    EXPECT_EQ(data.bytes.size(), size);
    const Result<NamedData> unpacked = unpack_data(data);
    ASSERT_TRUE(unpacked);
    EXPECT_EQ(*unpacked, given);
  }
}

TEST(Data, OfAnotherLengthThanTheirsAreRefused) {
  expect_exact_length(write_data({"x", {1, 2, 3}}), [](const Buffer& payload) {
    CodedData data;
    return !read_data(payload, data);
  });
}

TEST(Data, AreRefusedWhoseNameOrSizeNoStreamHas) {
  CodedData data;
  const auto code = [&data](const Buffer& payload) {
    const Fault fault = read_data(payload, data);
    return fault ? std::optional(fault.code) : std::nullopt;
  };
  EXPECT_EQ(code({0, 0, 0}), ErrorCode::kMalformed);
  EXPECT_EQ(code({1, 0xFF, 0, 0}), ErrorCode::kMalformed);
  EXPECT_EQ(code(write_data({std::string(kMaxDataNameBytes, 'n'), {}})), std::nullopt);
  EXPECT_EQ(code(write_data({std::string(kMaxDataNameBytes + 1, 'n'), {}})), ErrorCode::kMalformed);
  EXPECT_EQ(code({1, 'x', 1, 0x80, 0x80, 0x80, 0x20}), std::nullopt) << "2^26";
  EXPECT_EQ(code({1, 'x', 1, 0x81, 0x80, 0x80, 0x20}), ErrorCode::kLimitExceeded);
}

TEST(Data, InAnotherEncodingAreReadButNotUnpacked) {
  const Buffer payload = {1, 'x', 9, 4, 7, 7};
  const CodedData data = read_back(payload);
  EXPECT_EQ(data.decoded_size, 4u);
  EXPECT_EQ(data.bytes.size(), 2u);
  expect_refused(unpack_data(data), ErrorCode::kUnsupported, "§4.8");
}

TEST(Data, ThatAreNotExactlyOneFrameOfTheSizeSaidAreRefused) {
  const Buffer bytes(4000, 'a');
  const Buffer frame = zstd_frame(bytes);
  ASSERT_TRUE(unpack_data(coded(frame, 4000)));
  for (const std::uint64_t size : {0u, 3999u, 4001u, 1u << 20})
    expect_refused(unpack_data(coded(frame, size)), ErrorCode::kMalformed, "§4.8");
  expect_refused(unpack_data(coded(frame, kMaxDataBytes + 1)), ErrorCode::kLimitExceeded, "§4.8");

  Buffer two = frame;
  const Buffer nothing = zstd_frame({});
  two.insert(two.end(), nothing.begin(), nothing.end());
  expect_refused(unpack_data(coded(two, 4000)), ErrorCode::kMalformed, "§4.8");

  Buffer longer = frame;
  longer.push_back(0);
  expect_refused(unpack_data(coded(longer, 4000)), ErrorCode::kMalformed, "§4.8");
  const Buffer skippable = {0x50, 0x2A, 0x4D, 0x18, 0, 0, 0, 0};
  expect_refused(unpack_data(coded(skippable, 0)), ErrorCode::kMalformed, "§4.8");
  for (std::size_t length = 0; length < frame.size(); ++length) {
    const Buffer cut(frame.begin(), frame.begin() + static_cast<std::ptrdiff_t>(length));
    expect_refused(unpack_data(coded(cut, 4000)), ErrorCode::kMalformed, "§4.8");
  }
}

TEST(Data, ThatAreDamagedAreRefusedOrOfTheirSize) {
  std::string text;
  for (int i = 0; i < 400; ++i) text += std::to_string(i * i) + ",";
  const NamedData given{"x", Buffer(text.begin(), text.end())};
  const Buffer payload = write_data(given);
  const CodedData data = read_back(payload);
  ASSERT_EQ(data.encoding, DataEncoding::kZstd);
  for (std::size_t i = 0; i < data.bytes.size(); ++i) {
    for (const int change : {1, 0x10, 0x80, 0xFF}) {
      Buffer damaged(data.bytes.begin(), data.bytes.end());
      damaged[i] = static_cast<std::uint8_t>(damaged[i] ^ change);
      const Result<NamedData> unpacked = unpack_data(coded(damaged, data.decoded_size));
      if (unpacked) {
        EXPECT_EQ(unpacked->bytes.size(), given.bytes.size());
      }
    }
  }
}

}  // namespace
}  // namespace tvg
