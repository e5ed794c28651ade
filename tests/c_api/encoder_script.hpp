#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tvg/tvg.h>

namespace tvg::test {

/// The encoding half of the C interface, called as a script of bytes says: in any order, with good and with
/// bad arguments. What a call returns is held against what was called before, and a stream that was finished
/// against the frames that were taken: it decodes, and no coordinate is off by more than half a step or, in
/// mode basis, than the report says.
class EncoderScript {
 public:
  /// The bytes must outlive the script. Where they end, what they are read for is 0.
  explicit EncoderScript(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  /// Does all the script says, and then finishes. The first promise that was broken; empty where none was.
  std::string run();

 private:
  /// A stream that was finished, with what it was made of.
  struct Finished {
    std::vector<std::uint8_t> bytes;
    std::vector<std::vector<float>> decoded;  ///< [frame][vertex][xyz]
  };
  struct DestroyEncoder {
    void operator()(tvg_encoder* encoder) const { tvg_encoder_destroy(encoder); }
  };

  // One call each; `how`, 5 bits, says with what.
  void create(unsigned how);
  void set_metadata(unsigned how);
  void set_mesh(unsigned how);
  void add_properties(std::uint32_t vertices, std::uint32_t faces);
  void add_frame(const std::vector<float>& frame);
  void add_frames(unsigned how);
  void add_odd_frame(unsigned how);
  void finish();
  void compare(unsigned how);
  void join(unsigned how);

  tvg_encoder_options read_options(unsigned how);
  std::vector<float> quiet_frame(std::uint8_t seed, unsigned number) const;
  std::vector<float> wild_frame();
  /// All frames of a stream; with `originals`, each is held against its own. Nothing where it does not
  /// decode.
  std::optional<std::vector<std::vector<float>>> decode(const std::vector<std::uint8_t>& stream,
                                                        const std::vector<std::vector<float>>* originals);

  std::uint8_t byte();
  std::uint32_t word();
  double number();
  /// What a call on the encoder returned: whether it may say so, and whether the stream is lost by it.
  void answered(tvg_code code);
  void promise(bool kept, const std::string& what);

  static int take(void* user, const void* bytes, std::size_t size);

  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  std::string broken_;

  std::unique_ptr<tvg_encoder, DestroyEncoder> encoder_;
  std::vector<std::uint8_t> stream_;
  unsigned writes_left_ = ~0u;  ///< then the sink gives up
  bool reordered_ = false;
  double max_error_ = 0;      ///< asked for, of a basis; 0 where it was not
  double largest_error_ = 0;  ///< of the stream finished last, as its report has it
  bool lost_ = false;
  bool ended_ = false;
  std::uint32_t vertex_count_ = 0;
  std::vector<std::uint32_t> faces_;        ///< [face][corner], of the mesh in force
  std::vector<std::vector<float>> frames_;  ///< what the encoder took
  std::vector<Finished> finished_;
};

}  // namespace tvg::test
