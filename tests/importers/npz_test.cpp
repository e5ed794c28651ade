#include "encoder/importers/open_source.hpp"
#include "tests/importers/npz_builder.hpp"
#include "tests/importers/sample_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

// Arrays of .npz files: how they are found, stored and deflated.
namespace tvg::cli {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string frames_npy() {
  ByteString values(false);
  for (std::size_t frame = 0; frame < 3; ++frame) {
    for (const float value : tetrahedron_positions(frame)) values.add(value);
  }
  return npy("<f4", "3, 4, 3", values.bytes());
}

class Npz : public ::testing::Test {
 protected:
  Npz() { folder_.write("a.obj", sample_obj()); }
  OpenedSource open(const std::string& bytes, const std::string& array = "") const {
    folder_.write("a.npz", bytes);
    SourceSpec spec{{folder_.path("a.obj"), folder_.path("a.npz")}};
    spec.array = array;
    return open_source(spec);
  }
  std::string message(const std::string& bytes, const std::string& array = "") const {
    return thrown_by([&] { open(bytes, array); }).what();
  }
  TemporaryFolder folder_;
};

TEST_F(Npz, StoredAndDeflatedArraysAreReadTwice) {
  const std::string other = npy("<i8", "2", std::string(16, '\0'));
  for (const bool is_deflated : {false, true}) {
    for (const bool wide : {false, true}) {
      const OpenedSource opened =
          open(npz({{"faces.npy", other}, {"deformed.npy", frames_npy(), is_deflated, wide}}));
      for (int pass = 0; pass < 2; ++pass) {
        const Frames frames = read_all(*opened.source);
        EXPECT_FALSE(frames.error);
        EXPECT_THAT(frames.frames, ElementsAre(tetrahedron_positions(0), tetrahedron_positions(1),
                                               tetrahedron_positions(2)));
        EXPECT_TRUE(opened.source->rewind());
      }
      EXPECT_TRUE(opened.source->skip_frames(2).ok());
      EXPECT_THAT(read_all(*opened.source).frames, ElementsAre(tetrahedron_positions(2)));
    }
  }
}

TEST_F(Npz, TheArrayIsChosenByItsShapeOrName) {
  const std::string two = npz({{"rest.npy", frames_npy()}, {"b.npy", frames_npy()}});
  EXPECT_THAT(message(two), HasSubstr("'rest', 'b' may all be positions: choose one by --array"));
  EXPECT_EQ(open(two, "b").source->frame_count(), 3U);
  EXPECT_THAT(message(two, "c"), HasSubstr("it has no array 'c', but 'rest', 'b'"));
  EXPECT_EQ(open(npz({{"rest.npy", frames_npy()}, {"verts.npy", frames_npy()}})).source->frame_count(), 3U);
  EXPECT_THAT(message(npz({{"x.npy", npy("<i8", "2", std::string(16, '\0'))}})),
              HasSubstr("none of its arrays"));
  EXPECT_THAT(message(npz({{"x.txt", "text"}})), HasSubstr("it holds no arrays"));
}

TEST_F(Npz, DamageIsAnError) {
  const std::string good = npz({{"verts.npy", frames_npy(), true}});
  EXPECT_THAT(message("PK\x03\x04" + std::string(100, 'x')), HasSubstr("no archive of arrays"));
  for (std::size_t length = 1; length < good.size(); ++length)
    EXPECT_NE(message(good.substr(0, length)), "") << length;
  std::string odd = good;
  odd[good.find("verts.npy") + 12] = 7;  // the first block's kind
  EXPECT_THAT(message(odd), HasSubstr("compressed bytes are damaged"));
  for (const bool is_deflated : {false, true}) {
    std::string turned = npz({{"verts.npy", frames_npy(), is_deflated}});
    turned[turned.find("NUMPY") + 130] ^= 1;  // a value of the first frame
    const Frames frames = read_all(*open(turned).source);
    ASSERT_TRUE(frames.error);
    EXPECT_THAT(frames.error->message, HasSubstr("its checksum does not fit its bytes"));
  }
}

}  // namespace
}  // namespace tvg::cli
