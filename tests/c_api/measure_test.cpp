#include "c_api_toolbox.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>

#include <tvg/measure.hpp>
#include <tvg/metrics.hpp>

// The measure and the metrics through the C interface: what they say is what C++ says.
namespace tvg::test {
namespace {

struct Destroy {
  void operator()(tvg_encoder* encoder) const { tvg_encoder_destroy(encoder); }
  void operator()(tvg_comparer* comparer) const { tvg_comparer_destroy(comparer); }
};

int append(void* user, const void* bytes, std::size_t size) {
  const auto* const first = static_cast<const std::uint8_t*>(bytes);
  static_cast<Stream*>(user)->insert(static_cast<Stream*>(user)->end(), first, first + size);
  return 0;
}

class MeasureInC : public ::testing::Test {
 protected:
  const Sequence sequence_ = corpus::find_corpus_entry("toy")->make(*corpus::named_size("small")).sequence;
  const Mesh& mesh_ = sequence_.mesh;
  const std::uint32_t face_count_ = static_cast<std::uint32_t>(mesh_.faces.size());
  const std::uint32_t* faces_ = mesh_.faces.front().data();
  const std::array<tvg_criterion, 2> terms_ = {{{"curv", 1}, {"velocity", 0.5}}};

  std::vector<float> positions() const {
    std::vector<float> all;
    for (const FramePositions& frame : sequence_.frames) all.insert(all.end(), frame.begin(), frame.end());
    return all;
  }

  tvg_importance importance() const {
    tvg_importance importance = {};
    importance.struct_size = sizeof importance;
    EXPECT_EQ(tvg_importance_init(&importance), TVG_OK);
    importance.criteria = terms_.data();
    importance.criterion_count = terms_.size();
    importance.share = 0.2;
    importance.smoothing = 2;
    return importance;
  }

  static Importance same_in_cpp() {
    Importance importance;
    importance.criteria = {{"curv", 1}, {"velocity", 0.5}};
    importance.share = 0.2;
    importance.smoothing = 2;
    return importance;
  }

  /// What tvg_measure says of these arguments.
  tvg_code measure(const std::vector<float>& positions, std::size_t frames, const tvg_importance* given,
                   std::string* text = nullptr) const {
    std::array<char, 200> said = {};
    const tvg_code code = tvg_measure(mesh_.vertex_count, faces_, face_count_, positions.data(), frames,
                                      given, nullptr, nullptr, said.data(), said.size());
    if (text != nullptr) *text = said.data();
    return code;
  }
};

TEST_F(MeasureInC, SaysWhatTheMeasureSays) {
  const tvg::Result<Measure> expected = tvg::measure(mesh_, sequence_.frames, {}, {}, same_in_cpp());
  ASSERT_TRUE(expected);
  std::vector<double> costs(mesh_.vertex_count);
  std::vector<std::uint8_t> flags(mesh_.vertex_count);
  const tvg_importance given = importance();
  ASSERT_EQ(tvg_measure(mesh_.vertex_count, faces_, face_count_, positions().data(), sequence_.frames.size(),
                        &given, costs.data(), flags.data(), nullptr, 0),
            TVG_OK);
  EXPECT_EQ(costs, expected->cost);
  EXPECT_EQ(flags, expected->flags);
}

TEST_F(MeasureInC, NamesTheCriteriaThatThereAre) {
  const std::vector<CriterionDescription> all = criterion_descriptions();
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(tvg_criterion_name(i), all[i].name);
    EXPECT_EQ(tvg_criterion_description(i), all[i].description);
  }
  EXPECT_EQ(tvg_criterion_name(all.size()), nullptr);
  EXPECT_EQ(tvg_criterion_description(SIZE_MAX), nullptr);
}

TEST_F(MeasureInC, RefusesWhatMeansNothingAndSaysWhy) {
  std::string text;
  tvg_importance given = importance();
  const std::vector<float> all = positions();
  EXPECT_EQ(measure(all, 0, &given), TVG_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(measure(all, SIZE_MAX / 2, &given), TVG_ERROR_INVALID_ARGUMENT);
  given.share = 2;
  EXPECT_EQ(measure(all, 1, &given, &text), TVG_ERROR_INVALID_ARGUMENT);
  EXPECT_NE(text.find("share"), std::string::npos) << text;
  const tvg_criterion beauty = {"beauty", 1}, nameless = {nullptr, 1};
  given = importance();
  given.criteria = &beauty;
  given.criterion_count = 1;
  EXPECT_EQ(measure(all, 1, &given, &text), TVG_ERROR_INVALID_ARGUMENT);
  EXPECT_NE(text.find("beauty"), std::string::npos) << text;
  given.criteria = &nameless;
  EXPECT_EQ(measure(all, 1, &given), TVG_ERROR_INVALID_ARGUMENT);
  given.criteria = nullptr;
  EXPECT_EQ(measure(all, 1, &given), TVG_ERROR_INVALID_ARGUMENT);
  given.struct_size = 0;
  EXPECT_EQ(measure(all, 1, &given), TVG_ERROR_INVALID_ARGUMENT);

  std::vector<float> holes = all;
  holes[5] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(measure(holes, 1, nullptr), TVG_ERROR_INVALID_INPUT);
  const std::array<std::uint32_t, 3> astray = {0, 1, mesh_.vertex_count};
  EXPECT_EQ(
      tvg_measure(mesh_.vertex_count, astray.data(), 1, all.data(), 1, nullptr, nullptr, nullptr, nullptr, 0),
      TVG_ERROR_INVALID_INPUT);
}

TEST_F(MeasureInC, FlagsOfAStreamAreThoseOfTheImportanceThatWasSet) {
  tvg_encoder_options options = {};
  options.struct_size = sizeof options;
  ASSERT_EQ(tvg_encoder_options_init(&options), TVG_OK);
  options.coarse_bits = 8;
  Stream stream;
  tvg_encoder* made = nullptr;
  ASSERT_EQ(tvg_encoder_create(&options, append, &stream, &made), TVG_OK);
  const std::unique_ptr<tvg_encoder, Destroy> encoder(made);
  const tvg_importance given = importance();
  EXPECT_EQ(tvg_encoder_set_importance(made, nullptr), TVG_OK);
  ASSERT_EQ(tvg_encoder_set_importance(made, &given), TVG_OK);
  ASSERT_EQ(tvg_encoder_set_mesh(made, mesh_.vertex_count, faces_, face_count_), TVG_OK);
  EXPECT_EQ(tvg_encoder_set_importance(made, &given), TVG_ERROR_WRONG_STATE);
  for (const FramePositions& frame : sequence_.frames)
    ASSERT_EQ(tvg_encoder_add_frame(made, frame.data(), frame.size() * sizeof(float), 12), TVG_OK);
  ASSERT_EQ(tvg_encoder_finish(made, nullptr), TVG_OK);

  const tvg::Result<Measure> expected = tvg::measure(mesh_, sequence_.frames, {}, {}, same_in_cpp());
  ASSERT_TRUE(expected);
  for (const auto& [number, frame] : decode_all(stream, stream.size()))
    EXPECT_EQ(frame.flags, expected->flags) << number;
}

TEST_F(MeasureInC, ReportsAreThoseOfTheComparison) {
  SequenceComparison expected(mesh_, {true, 2});
  tvg_comparer* made = nullptr;
  ASSERT_EQ(tvg_comparer_create(mesh_.vertex_count, faces_, face_count_, &made), TVG_OK);
  const std::unique_ptr<tvg_comparer, Destroy> comparer(made);
  EXPECT_EQ(tvg_comparer_use_hausdorff(nullptr, 1), TVG_ERROR_INVALID_ARGUMENT);
  ASSERT_EQ(tvg_comparer_use_hausdorff(made, 2), TVG_OK);
  for (const FramePositions& frame : sequence_.frames) {
    FramePositions moved = frame;
    for (std::size_t i = 0; i < moved.size(); i += 7) moved[i] += 0.01F;
    ASSERT_TRUE(expected.add_frame(frame, moved).ok());
    ASSERT_EQ(tvg_comparer_add_frame(made, frame.data(), moved.data(), frame.size()), TVG_OK);
  }
  EXPECT_EQ(tvg_comparer_use_hausdorff(made, 1), TVG_ERROR_WRONG_STATE);
  tvg_comparison_report report = {};
  EXPECT_EQ(tvg_comparer_get_report(made, &report), TVG_ERROR_INVALID_ARGUMENT);
  report.struct_size = sizeof report;
  ASSERT_EQ(tvg_comparer_get_report(made, &report), TVG_OK);
  const ComparisonReport figures = expected.report();
  EXPECT_EQ(report.frames, figures.frames);
  EXPECT_EQ(report.max_coordinate_error, figures.max_coordinate_error);
  EXPECT_EQ(report.rms_vertex_distance, figures.rms_vertex_distance);
  EXPECT_EQ(report.worst_vertex, figures.worst_vertex);
  EXPECT_EQ(report.snr_db, figures.snr_db);
  EXPECT_EQ(report.kg_percent, figures.kg_percent);
  EXPECT_EQ(report.mean_quadric_error, figures.mean_quadric_error);
  EXPECT_EQ(report.sted_temporal, figures.sted_temporal);
  EXPECT_EQ(report.hausdorff_frames, figures.hausdorff_frames);
  EXPECT_EQ(report.hausdorff, figures.hausdorff.value());
}

}  // namespace
}  // namespace tvg::test
