#include "c_api_toolbox.hpp"
#include "tests/codec/levels_toolbox.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <random>

#include <tvg/normals.hpp>

namespace tvg::test {
namespace {

TEST(CApi, AnySplitOfTheBytesGivesTheFramesOfTheCppDecoder) {
  const Stream stream = hybrid_stream();
  const DecodedStream expected = decode_stream(stream);
  for (const std::size_t piece : {std::size_t{1}, std::size_t{7}, std::size_t{1000}, stream.size()}) {
    const std::map<std::uint64_t, CFrame> frames = decode_all(stream, piece);
    ASSERT_EQ(frames.size(), expected.frames.size());
    for (const DecodedFrame& frame : expected.frames) {
      const CFrame& own = frames.at(frame.number);
      ASSERT_EQ(own.positions, frame.positions);
      ASSERT_EQ(own.flags, frame.flags);
      std::vector<float> normals(own.normals.size());
      vertex_normals(expected.meshes[0].faces, frame.positions, normals);
      ASSERT_EQ(own.normals, normals);
    }
  }
}

TEST(CApi, TellsWhatTheStreamIs) {
  const Stream stream = hybrid_stream();
  const DecodedStream expected = decode_stream(stream);
  StreamDecoder decoder;
  decoder.push(stream.data(), stream.size());
  while (decoder.poll() != TVG_EVENT_FRAME) {
  }
  EXPECT_EQ(decoder.stream()->vertices, expected.head.limits.vertices);
  EXPECT_EQ(decoder.stream()->frame_count, TVG_UNKNOWN);
  EXPECT_EQ(decoder.metadata("fps"), "25");
  EXPECT_EQ(decoder.metadata("no such key"), std::nullopt);
  Metadata metadata;
  for (std::size_t i = 0; const char* const key = tvg_decoder_metadata_key(decoder.get(), i); ++i) {
    metadata.emplace(key, decoder.metadata(key).value());
  }
  EXPECT_EQ(metadata, expected.metadata);
  const tvg_mesh_info mesh = *decoder.mesh();
  ASSERT_EQ(mesh.face_count, expected.meshes[0].faces.size());
  EXPECT_EQ(std::memcmp(mesh.faces, expected.meshes[0].faces.data(), 12 * std::size_t{mesh.face_count}), 0);
  const tvg_gop_info gop = *decoder.gop();
  EXPECT_EQ(gop.frame_count, 5u);
  EXPECT_EQ(gop.coarse_step, 8 * gop.fine_step);
  EXPECT_EQ(gop.important_vertices, expected.frames[0].gop.flagged);
  EXPECT_GT(decoder.frame()->packet_bytes, 0u);
  EXPECT_EQ(tvg_version(), static_cast<std::uint32_t>(TVG_VERSION));
}

TEST(CApi, PassesOverFreeFormData) {
  std::mt19937 random(9);
  EncodeOptions options;
  options.data = {{"a", {1, 2, 3}}, {"b", std::vector<std::uint8_t>(500)}};
  const Stream stream = encode_sequence(random_sequence(grid(4, 3), 5, random), options);
  EXPECT_EQ(decode_stream(stream).data, options.data);
  EXPECT_EQ(decode_all(stream, 1).size(), 5u);
}

TEST(CApi, EveryFunctionTakesNull) {
  std::uint64_t number = 0;
  EXPECT_EQ(tvg_limits_init(nullptr), TVG_ERROR_INVALID_ARGUMENT);
  tvg_decoder_destroy(nullptr);
  EXPECT_EQ(tvg_decoder_push(nullptr, "x", 1), TVG_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(tvg_decoder_finish(nullptr), TVG_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(tvg_decoder_poll(nullptr), TVG_EVENT_ERROR);
  EXPECT_EQ(tvg_decoder_get_stream(nullptr, nullptr), TVG_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(tvg_decoder_metadata(nullptr, "fps"), nullptr);
  EXPECT_EQ(tvg_decoder_metadata_key(nullptr, 0), nullptr);
  EXPECT_EQ(tvg_decoder_get_mesh(nullptr, nullptr), TVG_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(tvg_decoder_get_gop(nullptr, nullptr), TVG_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(tvg_decoder_get_frame(nullptr, nullptr), TVG_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(tvg_decoder_get_damage(nullptr, nullptr), TVG_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(tvg_decoder_copy_flags(nullptr, nullptr, 0), TVG_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(tvg_decoder_copy_positions(nullptr, nullptr, 0, 12), TVG_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(tvg_decoder_compute_normals(nullptr, nullptr, 0, 12), TVG_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(tvg_locate_index(nullptr, 28, 100, &number, &number), TVG_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(tvg_decoder_load_index(nullptr, "x", 1), TVG_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(tvg_decoder_seek(nullptr, 0, &number), TVG_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(tvg_decoder_skip(nullptr), 0u);
  EXPECT_STRNE(tvg_decoder_error_text(nullptr), "");
  EXPECT_EQ(tvg_decoder_error_code(nullptr), TVG_ERROR_INVALID_ARGUMENT);

  StreamDecoder decoder;
  EXPECT_EQ(decoder.push(nullptr, 1), TVG_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(decoder.push(nullptr, 0), TVG_OK);
  EXPECT_EQ(decoder.load_index(nullptr, 1), TVG_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(tvg_decoder_seek(decoder.get(), 0, nullptr), TVG_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(tvg_decoder_metadata(decoder.get(), nullptr), nullptr);
}

TEST(CApi, WhatIsNotThereYetOrNotAnyMoreIsAWrongState) {
  const Stream stream = hybrid_stream();
  StreamDecoder decoder;
  std::vector<float> room(1 << 16);
  std::vector<std::uint8_t> flags(1 << 16);
  const auto codes = [&] {
    tvg_stream_info head = {};
    head.struct_size = sizeof head;
    tvg_mesh_info mesh = {};
    mesh.struct_size = sizeof mesh;
    tvg_gop_info gop = {};
    gop.struct_size = sizeof gop;
    tvg_frame_info frame = {};
    frame.struct_size = sizeof frame;
    return std::array{
        tvg_decoder_get_stream(decoder.get(), &head),     tvg_decoder_get_mesh(decoder.get(), &mesh),
        tvg_decoder_get_gop(decoder.get(), &gop),         decoder.copy_flags(flags.data(), flags.size()),
        tvg_decoder_get_frame(decoder.get(), &frame),     decoder.copy_positions(room.data(), room.size()),
        decoder.compute_normals(room.data(), room.size())};
  };
  const auto expected = [](int known) {
    std::array<tvg_code, 7> result;
    result.fill(TVG_ERROR_WRONG_STATE);
    std::fill_n(result.begin(), known, TVG_OK);
    return result;
  };
  EXPECT_EQ(codes(), expected(0));
  EXPECT_FALSE(decoder.seek(0));
  EXPECT_EQ(decoder.error_code(), TVG_ERROR_WRONG_STATE);
  decoder.push(stream.data(), stream.size());
  while (decoder.poll() != TVG_EVENT_HEAD) {
  }
  EXPECT_EQ(codes(), expected(1));
  while (decoder.poll() != TVG_EVENT_MESH) {
  }
  EXPECT_EQ(codes(), expected(2));
  while (decoder.poll() != TVG_EVENT_GOP) {
  }
  EXPECT_EQ(codes(), expected(4));
  while (decoder.poll() != TVG_EVENT_FRAME) {
  }
  EXPECT_EQ(codes(), expected(7));
  ASSERT_TRUE(decoder.seek(0));
  EXPECT_EQ(codes(), expected(2)) << "after seeking";
  EXPECT_FALSE(decoder.damage());
}

TEST(CApi, BuffersThatAreTooSmallAreRefusedAndOthersNotOverrun) {
  const Stream stream = hybrid_stream();
  StreamDecoder decoder;
  decoder.push(stream.data(), stream.size());
  while (decoder.poll() != TVG_EVENT_FRAME) {
  }
  const std::size_t count = decoder.mesh()->vertex_count;
  for (const std::size_t stride : {std::size_t{12}, std::size_t{20}}) {
    const std::size_t needed = (count - 1) * stride + 12;
    std::vector<std::uint8_t> room(needed + 8, 0xAB);
    EXPECT_EQ(tvg_decoder_copy_positions(decoder.get(), room.data(), needed - 1, stride),
              TVG_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(tvg_decoder_compute_normals(decoder.get(), room.data(), needed - 1, stride),
              TVG_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(std::count(room.begin(), room.end(), 0xAB), static_cast<std::ptrdiff_t>(room.size()));
    EXPECT_EQ(tvg_decoder_copy_positions(decoder.get(), room.data(), needed, stride), TVG_OK);
    EXPECT_EQ(tvg_decoder_compute_normals(decoder.get(), room.data(), needed, stride), TVG_OK);
    EXPECT_EQ(std::count(room.end() - 8, room.end(), 0xAB), 8);
  }
  std::vector<float> room(3 * count);
  EXPECT_EQ(tvg_decoder_copy_positions(decoder.get(), room.data(), 12 * count, 11),
            TVG_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(tvg_decoder_copy_positions(decoder.get(), room.data(), 12 * count, SIZE_MAX),
            TVG_ERROR_INVALID_ARGUMENT);
  std::vector<std::uint8_t> flags(count);
  EXPECT_EQ(decoder.copy_flags(flags.data(), count - 1), TVG_ERROR_INVALID_ARGUMENT);
}

TEST(CApi, ACallerOfAnOlderHeaderGetsWhatHeKnows) {
  const Stream stream = hybrid_stream();
  StreamDecoder decoder;
  decoder.push(stream.data(), stream.size());
  while (decoder.poll() != TVG_EVENT_FRAME) {
  }
  tvg_frame_info frame = {};
  frame.packet_bytes = 77;
  EXPECT_EQ(tvg_decoder_get_frame(decoder.get(), &frame), TVG_ERROR_INVALID_ARGUMENT) << "size not set";
  frame.struct_size = offsetof(tvg_frame_info, packet_bytes);
  EXPECT_EQ(tvg_decoder_get_frame(decoder.get(), &frame), TVG_OK);
  EXPECT_EQ(frame.packet_bytes, 77u);
  tvg_limits limits = {};
  EXPECT_EQ(tvg_decoder_create(&limits), nullptr) << "size not set";
}

TEST(CApi, LimitsRefuseAStreamThatDeclaresMore) {
  const Stream stream = hybrid_stream();
  tvg_limits limits = {};
  limits.struct_size = sizeof limits;
  ASSERT_EQ(tvg_limits_init(&limits), TVG_OK);
  EXPECT_EQ(limits.vertices, DecoderLimits().vertices);
  limits.vertices = 10;
  StreamDecoder decoder(&limits);
  decoder.push(stream.data(), stream.size());
  ASSERT_EQ(decoder.poll(), TVG_EVENT_ERROR);
  EXPECT_EQ(decoder.error_code(), TVG_ERROR_LIMIT_EXCEEDED);
  EXPECT_STREQ(tvg_code_name(decoder.error_code()), "limit-exceeded");
  EXPECT_NE(decoder.error_text().find("the limit set here is 10"), std::string::npos) << decoder.error_text();
}

TEST(CApi, DamageIsReportedAndDecodingGoesOn) {
  Stream stream = hybrid_stream();
  const std::map<std::uint64_t, CFrame> whole = decode_all(stream, 4096);
  const DecodedStream facts = decode_stream(stream);
  stream[static_cast<std::size_t>(facts.index[2].offset) + 300] ^= 0x40;  // inside the second GOP
  StreamDecoder decoder;
  decoder.push(stream.data(), stream.size());
  decoder.finish();
  std::map<std::uint64_t, CFrame> frames;
  std::uint64_t lost = 0;
  for (tvg_event event = decoder.poll(); event != TVG_EVENT_END; event = decoder.poll()) {
    ASSERT_NE(event, TVG_EVENT_ERROR);
    if (event == TVG_EVENT_FRAME) frames.emplace(decoder.frame()->number, current_c_frame(decoder));
    if (event != TVG_EVENT_DAMAGE) continue;
    lost += decoder.damage()->frame_count;
    EXPECT_EQ(decoder.damage()->code, TVG_ERROR_CHECKSUM_MISMATCH);
    EXPECT_NE(std::string(decoder.damage()->text).find("packet"), std::string::npos);
    EXPECT_FALSE(decoder.gop()) << "the GOP that is lost may be another";
  }
  EXPECT_GT(lost, 0u);
  EXPECT_EQ(frames.size() + lost, 12u);
  for (const auto& [number, frame] : frames) EXPECT_EQ(frame, whole.at(number)) << number;
}

TEST(CApi, SeeksWithAnIndexAndWithout) {
  const Stream stream = hybrid_stream();
  const std::map<std::uint64_t, CFrame> whole = decode_all(stream, 4096);
  for (const bool with_index : {true, false}) {
    StreamDecoder decoder;
    std::map<std::uint64_t, CFrame> frames;
    decoder.push(stream.data(), 300);
    drain(decoder, frames);
    if (with_index) {
      std::uint64_t offset = 0, size = 0;
      ASSERT_EQ(tvg_locate_index(stream.data() + stream.size() - TVG_TAIL_BYTES, TVG_TAIL_BYTES,
                                 stream.size(), &offset, &size),
                TVG_OK);
      ASSERT_EQ(decoder.load_index(stream.data() + offset, static_cast<std::size_t>(size)), TVG_OK);
      EXPECT_EQ(decoder.stream()->frame_count, 12u);
      EXPECT_FALSE(decoder.seek(12));
      EXPECT_EQ(decoder.error_code(), TVG_ERROR_INVALID_ARGUMENT);
    }
    for (const std::uint64_t wanted : {11u, 2u, 7u, 3u}) {
      frames.clear();
      const std::optional<std::uint64_t> offset = decoder.seek(wanted);
      ASSERT_TRUE(offset);
      decoder.push(stream.data() + *offset, stream.size() - static_cast<std::size_t>(*offset));
      decoder.finish();
      ASSERT_EQ(drain(decoder, frames), TVG_EVENT_END);
      ASSERT_EQ(frames.size(), 12 - wanted);
      for (const auto& [number, frame] : frames) ASSERT_EQ(frame, whole.at(number)) << number;
    }
  }
}

TEST(CApi, RandomCallOrdersNeverCrashAndNeverGiveAWrongFrame) {
  const Stream stream = hybrid_stream();
  const std::map<std::uint64_t, CFrame> whole = decode_all(stream, 4096);
  std::mt19937 random(3);
  for (int round = 0; round < 200; ++round) {
    StreamDecoder decoder;
    std::uint64_t at = 0;
    tvg_event last = TVG_EVENT_NEED_BYTES;
    for (int call = 0; call < 300; ++call) {
      switch (random() % 8) {
        case 0:
        case 1: {
          const std::size_t left = at < stream.size() ? stream.size() - static_cast<std::size_t>(at) : 0;
          const std::size_t size = std::min<std::size_t>(left, random() % 2000);
          ASSERT_EQ(decoder.push(stream.data() + (left > 0 ? at : 0), size), TVG_OK);
          at += size;
          break;
        }
        case 2:
          if (random() % 20 == 0 && at >= stream.size()) decoder.finish();
          break;
        case 3:
          if (const std::optional<std::uint64_t> offset =
                  random() % 8 == 0 ? decoder.seek(random() % 14) : std::nullopt) {
            at = *offset;
            last = TVG_EVENT_NEED_BYTES;
          }
          break;
        case 4:
          at += decoder.skip();
          break;
        default:
          last = decoder.poll();
          if (last == TVG_EVENT_DAMAGE) FAIL() << decoder.damage()->text;
      }
      if (last == TVG_EVENT_FRAME && decoder.frame()) {
        ASSERT_EQ(current_c_frame(decoder), whole.at(decoder.frame()->number));
      }
    }
  }
}

TEST(StreamDecoder, DrawsACoarserMesh) {
  const Sequence sequence = corpus::find_corpus_entry("hand")->make(*corpus::named_size("small")).sequence;
  EncodeOptions options;
  options.levels = greedy_levels(sequence.mesh, 4, {2, 4});
  const Stream stream = encode_sequence(sequence, options);
  std::size_t last = sequence.mesh.vertex_count + 1;
  for (const std::uint32_t lod : {0u, 1u, 2u, 9u}) {
    StreamDecoder decoder;
    EXPECT_EQ(decoder.use_lod(lod), TVG_OK);
    decoder.push(stream.data(), stream.size());
    while (decoder.poll() != TVG_EVENT_FRAME) {
    }
    const auto mesh = decoder.mesh();
    ASSERT_TRUE(mesh);
    EXPECT_EQ(mesh->lod_count, 2u);
    EXPECT_EQ(mesh->lod, std::min(lod, 2u));
    EXPECT_TRUE(mesh->vertex_count < last || lod == 9);
    last = mesh->vertex_count;
    EXPECT_EQ(current_c_frame(decoder).positions.size(), 3 * std::size_t{last});
  }
}

}  // namespace
}  // namespace tvg::test
