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

void fit(OrbitCamera& camera, const BoundingBox& bounds, double aspect = 1) {
  ViewExtent extent = camera.extent(aspect);
  extent.extend(bounds);
  camera.fit(extent);
}

OrbitCamera camera_at(const char* view, const Orientation& orientation = {}) {
  OrbitCamera camera;
  camera.set_angles(parse_view(view));
  camera.set_orientation(orientation);
  fit(camera, box(1, 1, 1));
  return camera;
}

const AxisDirection kAll[] = {{0, 1}, {0, -1}, {1, 1}, {1, -1}, {2, 1}, {2, -1}};

/// The middle of a side of the box.
std::array<float, 3> side(const AxisDirection& direction) {
  const std::array<double, 3> vector = direction.vector();
  return {static_cast<float>(vector[0]), static_cast<float>(vector[1]), static_cast<float>(vector[2])};
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
  const Orientation up_is_z({2, 1});
  EXPECT_GT(project(camera_at("front"), 1, {0, 1, 0})[1], 0.1);
  EXPECT_GT(project(camera_at("front", up_is_z), 1, {0, 0, 1})[1], 0.1);
  EXPECT_LT(project(camera_at("front", up_is_z), 1, {0, -1, 0})[2],
            project(camera_at("front", up_is_z), 1, {0, 1, 0})[2]);
  EXPECT_GT(project(camera_at("front"), 1, {1, 0, 0})[0], 0.1);
}

TEST(Camera, StandsByWhateverIsUpAndWhateverIsTheFront) {
  for (const AxisDirection& up : kAll) {
    for (const AxisDirection& front : kAll) {
      if (up.axis == front.axis) continue;
      const Orientation orientation(up, front);
      const OrbitCamera from_front = camera_at("front", orientation),
                        from_above = camera_at("top", orientation);
      EXPECT_GT(project(from_front, 1, side(up))[1], 0.1);
      EXPECT_GT(project(from_front, 1, side(orientation.right()))[0], 0.1);
      EXPECT_LT(project(from_front, 1, side(front))[2], 0.999);
      EXPECT_LT(project(from_above, 1, side(up))[2], project(from_above, 1, {0, 0, 0})[2]);
      EXPECT_LT(project(from_above, 1, side(front))[1], -0.1) << "the front is below in the plan";
    }
  }
}

TEST(Camera, FitsEveryCornerFromEverywhere) {
  const BoundingBox bounds = box(3, 0.5F, 1);
  for (const double aspect : {0.4, 1.0, 2.5}) {
    for (double azimuth = -180; azimuth < 180; azimuth += 37) {
      for (const double elevation : {-90.0, -20.0, 0.0, 50.0, 90.0}) {
        OrbitCamera camera;
        camera.set_angles({azimuth, elevation, 1});
        fit(camera, bounds, aspect);
        double most = 0;
        for (int corner = 0; corner < 8; ++corner) {
          const auto at = project(camera, aspect,
                                  {(corner & 1) != 0 ? 3.0F : -3.0F, (corner & 2) != 0 ? 0.5F : -0.5F,
                                   (corner & 4) != 0 ? 1.0F : -1.0F});
          most = std::max({most, std::abs(at[0]), std::abs(at[1])});
          EXPECT_LT(std::abs(at[2]), 1);
        }
        EXPECT_NEAR(most, 1 / 1.06, 1e-4) << azimuth << " " << elevation << " " << aspect;
      }
    }
  }
}

/// Points on a ball: the box around them is wider in every picture that does not look along an axis.
std::vector<float> ball(const std::array<float, 3>& middle) {
  std::vector<float> points;
  for (int i = 0; i < 40; ++i) {
    for (int j = 0; j <= 20; ++j) {
      const double turn = 6.2831853 * i / 40, tilt = 3.1415927 * j / 20;
      points.push_back(middle[0] + static_cast<float>(std::sin(tilt) * std::cos(turn)));
      points.push_back(middle[1] + static_cast<float>(std::cos(tilt)));
      points.push_back(middle[2] + static_cast<float>(std::sin(tilt) * std::sin(turn)));
    }
  }
  return points;
}

TEST(Camera, FillsThePictureWithThePointsOfAllFramesFromEverywhere) {
  const std::vector<std::vector<float>> frames = {ball({0, 0, 0}), ball({2, 0, 5}), ball({1e4F, 7, 1})};
  for (const std::size_t count : {1U, 2U, 3U}) {
    for (const double aspect : {0.5, 1.0, 1.8}) {
      for (const char* view : {"front", "iso", "top", "-130,-40"}) {
        OrbitCamera camera;
        camera.set_angles(parse_view(view));
        ViewExtent extent = camera.extent(aspect);
        for (std::size_t f = 0; f < count; ++f) extent.extend(frames[f]);
        camera.fit(extent);
        std::array<double, 2> low = {1, 1}, high = {-1, -1};
        for (std::size_t f = 0; f < count; ++f) {
          for (std::size_t i = 0; i < frames[f].size(); i += 3) {
            const auto at = project(camera, aspect, {frames[f][i], frames[f][i + 1], frames[f][i + 2]});
            for (std::size_t k = 0; k < 2; ++k) low[k] = std::min(low[k], at[k]);
            for (std::size_t k = 0; k < 2; ++k) high[k] = std::max(high[k], at[k]);
          }
        }
        // Across or up there is no room left but the margin, which is the same on both sides.
        const std::size_t tight = high[0] - low[0] > high[1] - low[1] ? 0 : 1;
        EXPECT_NEAR(high[tight], 1 / 1.06, 2e-3) << view << " " << aspect << " " << count;
        EXPECT_NEAR(low[tight], -1 / 1.06, 2e-3) << view << " " << aspect << " " << count;
        const std::size_t loose = 1 - tight;
        EXPECT_LT(high[loose], 1 / 1.05);
        EXPECT_GT(low[loose], -1 / 1.05);
        EXPECT_NEAR(high[loose], -low[loose], 0.1) << view << " " << aspect << " " << count;
      }
    }
  }
}

TEST(Camera, LeavesTheRoomAskedForAroundEveryPoint) {
  OrbitCamera camera;
  ViewExtent padded = camera.extent(1), larger = camera.extent(1);
  padded.extend(ball({0, 0, 0}));
  padded.pad(0.5);
  std::vector<float> grown = ball({0, 0, 0});
  for (float& coordinate : grown) coordinate *= 1.5F;
  larger.extend(grown);
  EXPECT_NEAR(padded.place().distance, larger.place().distance, 0.05);
}

TEST(Orientation, IsReadFromOptionsAndMetadata) {
  EXPECT_EQ(parse_axis_direction("-Z"), (AxisDirection{2, -1}));
  EXPECT_EQ(parse_axis_direction("+x"), (AxisDirection{0, 1}));
  EXPECT_EQ(parse_axis_direction("y"), (AxisDirection{1, 1}));
  for (const char* text : {"", "+", "w", "+XY", "--x", "x+"})
    EXPECT_FALSE(parse_axis_direction(text)) << text;
  EXPECT_EQ(up_of({}), (AxisDirection{1, 1}));
  EXPECT_EQ(up_of({{"up", "z"}}), (AxisDirection{2, 1}));
  EXPECT_EQ(up_of({{"up", "sideways"}}), (AxisDirection{1, 1}));
  EXPECT_EQ(ChosenOrientation().of({{"up", "z"}}).front(), (AxisDirection{1, -1}));
  const ChosenOrientation upside_down{AxisDirection{1, -1}, {}};
  EXPECT_EQ(upside_down.of({{"up", "z"}}).up(), (AxisDirection{1, -1}));
  const ChosenOrientation from_behind{{}, AxisDirection{1, 1}};
  EXPECT_EQ(from_behind.of({{"up", "z"}}).right(), (AxisDirection{0, -1}));
  EXPECT_THROW(static_cast<void>(from_behind.of({})), cli::ToolError);
}

TEST(Camera, StopsAtThePolesAndTurnsAround) {
  OrbitCamera camera = camera_at("front");
  camera.orbit(400, 100);
  EXPECT_NEAR(camera.angles().azimuth, 40, 1e-9);
  EXPECT_EQ(camera.angles().elevation, 90);
}

TEST(Camera, PansByTheHeightOfThePicture) {
  OrbitCamera camera = camera_at("30,15");
  const auto before = project(camera, 1, {0, 0, 0});
  camera.pan(0.25, -0.5);
  const auto at = project(camera, 1, {0, 0, 0});
  EXPECT_NEAR(at[0] - before[0], 0.5, 1e-5);
  EXPECT_NEAR(at[1] - before[1], -1.0, 1e-5);
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
    OrbitCamera camera;
    ViewExtent extent = camera.extent(1.5);
    extent.extend(points);
    camera.fit(extent);
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
