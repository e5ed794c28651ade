#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vector>

#include <tvg/geometry.hpp>

namespace tvg {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(Groups, KeepTheOrderInWhichNumbersCame) {
  const Groups groups(4, [](auto&& put) {
    put(2, 9u);
    put(0, 5u);
    put(2, 1u);
    put(3, 9u);
    put(2, 4u);
  });
  EXPECT_THAT(groups[0], ElementsAre(5));
  EXPECT_THAT(groups[1], IsEmpty());
  EXPECT_THAT(groups[2], ElementsAre(9, 1, 4));
  EXPECT_THAT(groups[3], ElementsAre(9));
}

TEST(OneRings, CountAFaceOnceAtEachDistinctCorner) {
  const OneRings rings(Mesh{5, {{0, 1, 2}, {1, 1, 3}, {2, 2, 2}, {0, 3, 0}}});
  EXPECT_THAT(rings.faces_at(0), ElementsAre(0, 3));
  EXPECT_THAT(rings.faces_at(1), ElementsAre(0, 1));
  EXPECT_THAT(rings.faces_at(2), ElementsAre(0, 2));
  EXPECT_THAT(rings.faces_at(3), ElementsAre(1, 3));
  EXPECT_THAT(rings.faces_at(4), IsEmpty());
}

}  // namespace
}  // namespace tvg
