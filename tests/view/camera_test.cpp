#include "player/view/camera.hpp"

#include "tool/tool_error.hpp"

#include <array>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vector>

namespace tvg::player {
namespace {

/// Where a point is in the picture: -1 to 1 across and up, and its depth.
std::array<double, 3> project(const OrbitCamera& camera, double aspect, const std::array<float, 3>& point) {
  const CameraMatrices matrices = camera.matrices(aspect);
  const auto times = [](const std::array<float, 16>& m, const std::array<double, 4>& v) {
    std::array<double, 4> result{};
    for (std::size_t row = 0; row < 4; ++row) {
      for (std::size_t column = 0; column < 4; ++column) {
        result[row] += double{m[4 * column + row]} * v[column];
      }
    }
    return result;
  };
  const auto clip = times(matrices.projection, times(matrices.view, {point[0], point[1], point[2], 1}));
  return {clip[0] / clip[3], clip[1] / clip[3], clip[2] / clip[3]};
}

BoundingBox box(float x, float y, float z) {
  BoundingBox bounds;
  bounds.extend(std::vector<float>{-x, -y, -z, x, y, z});
  return bounds;
}

OrbitCamera camera_at(const char* view, UpAxis up = UpAxis::kY) {
  OrbitCamera camera;
  camera.set_angles(parse_view(view));
  camera.fit(box(1, 1, 1), up);
  return camera;
}

TEST(Camera, SeesTheSideThatTheViewIsNamedAfter) {
  struct Case {
    const char* view;
    std::array<float, 3> nearest;
  };
  for (const Case& c : {Case{"front", {0, 0, 1}}, Case{"back", {0, 0, -1}}, Case{"left", {-1, 0, 0}},
                        Case{"right", {1, 0, 0}}, Case{"top", {0, 1, 0}}, Case{"bottom", {0, -1, 0}}}) {
    const OrbitCamera camera = camera_at(c.view);
    const std::array<float, 3> farthest = {-c.nearest[0], -c.nearest[1], -c.nearest[2]};
    EXPECT_LT(project(camera, 1, c.nearest)[2], project(camera, 1, farthest)[2]) << c.view;
    EXPECT_NEAR(project(camera, 1, c.nearest)[0], 0, 1e-5) << c.view;
  }
}

TEST(Camera, KeepsTheUpAxisUp) {
  EXPECT_GT(project(camera_at("front"), 1, {0, 1, 0})[1], 0.1);
  EXPECT_GT(project(camera_at("front", UpAxis::kZ), 1, {0, 0, 1})[1], 0.1);
  EXPECT_LT(project(camera_at("front", UpAxis::kZ), 1, {0, -1, 0})[2],
            project(camera_at("front", UpAxis::kZ), 1, {0, 1, 0})[2]);
  EXPECT_GT(project(camera_at("front"), 1, {1, 0, 0})[0], 0.1);
}

TEST(Camera, FitsEveryCornerFromEverywhere) {
  const BoundingBox bounds = box(3, 0.5F, 1);
  for (const double aspect : {0.4, 1.0, 2.5}) {
    for (double azimuth = -180; azimuth < 180; azimuth += 37) {
      for (const double elevation : {-90.0, -20.0, 0.0, 50.0, 90.0}) {
        for (const bool closely : {false, true}) {
          OrbitCamera camera;
          camera.set_angles({azimuth, elevation, 1});
          closely ? camera.fit_closely(bounds, UpAxis::kY, aspect) : camera.fit(bounds, UpAxis::kY);
          double most = 0;
          for (int corner = 0; corner < 8; ++corner) {
            const auto at = project(camera, aspect,
                                    {(corner & 1) != 0 ? 3.0F : -3.0F, (corner & 2) != 0 ? 0.5F : -0.5F,
                                     (corner & 4) != 0 ? 1.0F : -1.0F});
            most = std::max({most, std::abs(at[0]), std::abs(at[1])});
            EXPECT_LT(std::abs(at[2]), 1);
          }
          EXPECT_LT(most, 1.0) << azimuth << " " << elevation << " " << aspect << closely;
          if (closely) {
            EXPECT_GT(most, 0.85) << azimuth << " " << elevation << " " << aspect;
          }
        }
      }
    }
  }
}

TEST(Camera, StopsAtThePolesAndTurnsAround) {
  OrbitCamera camera = camera_at("front");
  camera.orbit(400, 100);
  EXPECT_NEAR(camera.angles().azimuth, 40, 1e-9);
  EXPECT_EQ(camera.angles().elevation, 90);
}

TEST(Camera, PansByTheHeightOfThePicture) {
  OrbitCamera camera = camera_at("30,15");
  camera.pan(0.25, -0.5);
  const auto at = project(camera, 1, {0, 0, 0});
  EXPECT_NEAR(at[0], 0.5, 1e-5);
  EXPECT_NEAR(at[1], -1.0, 1e-5);
}

TEST(Camera, ZoomsWithinBounds) {
  OrbitCamera camera = camera_at("front");
  for (int i = 0; i < 100; ++i) camera.zoom_by(10);
  for (const float value : camera.matrices(1).projection) EXPECT_TRUE(std::isfinite(value));
  for (int i = 0; i < 200; ++i) camera.zoom_by(0.1);
  for (const float value : camera.matrices(1).view) EXPECT_TRUE(std::isfinite(value));
}

TEST(Camera, StandsSomewhereEvenForOnePointOrNone) {
  for (const std::vector<float>& points :
       {std::vector<float>{}, std::vector<float>{5, 5, 5}, std::vector<float>{NAN, 0, 0, INFINITY, 1, 1}}) {
    BoundingBox bounds;
    bounds.extend(points);
    OrbitCamera camera;
    camera.fit_closely(bounds, UpAxis::kY, 1.5);
    for (const float value : camera.matrices(1.5).view) EXPECT_TRUE(std::isfinite(value));
    for (const float value : camera.matrices(1.5).projection) EXPECT_TRUE(std::isfinite(value));
  }
}

TEST(ParseView, TakesNamesAndNumbers) {
  EXPECT_EQ(parse_view("left").azimuth, -90);
  EXPECT_EQ(parse_view("-40,10").elevation, 10);
  EXPECT_EQ(parse_view("370,-10.5,2").azimuth, 10);
  EXPECT_EQ(parse_view("370,-10.5,2").zoom, 2);
}

TEST(ParseView, ShowsWhatWouldBeRight) {
  for (const char* text : {"", "up", "1", "1,", ",1", "1,2,", "1,2,0", "1,91", "nan,0", "1,2,3,4", "1 ,2"}) {
    try {
      parse_view(text);
      ADD_FAILURE() << text;
    } catch (const cli::ToolError& error) {
      EXPECT_EQ(error.status(), cli::ExitStatus::kUsage);
      EXPECT_THAT(error.what(), ::testing::HasSubstr("30,15"));
    }
  }
}

}  // namespace
}  // namespace tvg::player
