#include "tool/mesh_format.hpp"

#include <gtest/gtest.h>

namespace tvg::cli {
namespace {

TEST(FileNames, TellCachesAndMeshesInEitherCase) {
  for (const char* cache : {"a.pc2", "A.PC2", "walk.mdd", "dir.obj/b.Mdd"})
    EXPECT_TRUE(is_cache_file(cache)) << cache;
  for (const char* other : {"a.obj", "pc2", "a.pc2.obj", "-", ""})
    EXPECT_FALSE(is_cache_file(other)) << other;
  EXPECT_EQ(mesh_format("A.OBJ"), MeshFormat::kObj);
  EXPECT_EQ(mesh_format("a.pc2"), std::nullopt);
}

}  // namespace
}  // namespace tvg::cli
