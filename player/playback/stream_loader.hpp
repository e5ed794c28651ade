#pragma once
#include "player/playback/bell.hpp"
#include "player/playback/frame_pool.hpp"
#include "player/playback/frame_ring.hpp"
#include "player/playback/stream_facts.hpp"
#include "player/playback/stream_input.hpp"

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <tvg/decoder.hpp>

namespace tvg::player {

struct LoaderOptions {
  DecoderLimits limits{};
  std::size_t ring_frames = 64;  ///< most frames held, at least 2
  std::uint64_t ring_bytes = std::uint64_t{512}
                             << 20;  ///< most bytes of frames held, but never below 2 frames
  bool measure_bits = false;         ///< fill PlayerFrame::bits, at some cost
  bool surfaces = true;              ///< fill PlayerFrame::surface
  std::string folder{};              ///< where pictures lie that the stream names; empty for nowhere
  std::uint32_t lod = 0;             ///< which coarser mesh is decoded (Decoder::use_lod()); 0 the whole
};

/// The frames that are played again and again; the end of the stream where `last` is absent.
struct LoopRange {
  std::uint64_t first = 0;
  std::optional<std::uint64_t> last;  ///< included

  bool operator==(const LoopRange&) const = default;
};

/// What is known and how things stand; a copy that may be kept.
struct LoaderSnapshot {
  enum class State {
    kOpening,  ///< no frame has been decoded yet
    kReady,
    kEnded,   ///< everything is decoded up to the end
    kFailed,  ///< `message` says why decoding cannot go on; frames decoded before can still be shown
  };

  State state = State::kOpening;
  std::string message;                       ///< why it failed, or why it waits; empty where all is well
  std::optional<std::uint64_t> frame_count;  ///< of the whole stream, once known
  std::uint64_t known_frames = 0;            ///< frames up to the end of what was met so far
  Metadata metadata;
  std::vector<double> times;         ///< of frames, in seconds, where they are uneven (PlaybackClock)
  std::shared_ptr<const Mesh> mesh;  ///< null before the first one; that of the frame decoded last
  GopMarks gops;                     ///< never null; all of them once the index is in
  bool has_index = false;
  std::vector<DamageMark> damage;
  std::vector<FrameRun> decoded;   ///< frames in the ring
  std::vector<FrameRun> buffered;  ///< frames whose bytes are on hand
  std::optional<std::uint64_t> stream_bytes;
  std::uint64_t bytes_read = 0;  ///< by the decoder; what was read twice counts twice
  std::uint32_t lod = 0;         ///< which of `lods` coarser meshes `mesh` is; 0 the whole
  std::uint32_t lods = 0;
  InputStatus input;
  double mean_decode_ms = 0;  ///< over the frames decoded lately
  double max_decode_ms = 0;   ///< of all
  std::uint64_t frames_decoded = 0;
  std::size_t frames_ahead = 0;  ///< decoded frames behind the one shown
  std::size_t frame_slots = 0;   ///< frames for which there is memory
  std::size_t ring_capacity = 0;
};

/// Decodes a stream ahead of what is shown, on a thread of its own, into a bounded ring. Frames that are lost
/// are noted, and the last good one stands in for them. All functions are for one other thread, and none of
/// them waits for the network or for decoding.
class StreamLoader {
 public:
  explicit StreamLoader(std::unique_ptr<StreamInput> input, const LoaderOptions& options = {});
  ~StreamLoader();
  StreamLoader(const StreamLoader&) = delete;
  StreamLoader& operator=(const StreamLoader&) = delete;

  /// The frame for `number` if it is decoded, else null. It counts as the one shown: the ring moves on.
  std::shared_ptr<const PlayerFrame> show(std::uint64_t number);
  /// Whether `number` will come without a seek().
  bool heads_for(std::uint64_t number) const;
  /// Goes to `number`: drops the ring, unless it has the frame already. Where `lead_in` is not 0, up to that
  /// many frames before it in the same GOP come first, for stepping back.
  void seek(std::uint64_t number, std::uint64_t lead_in = 0);
  /// After the range's last frame decoding goes on with its first; without one it ends at the stream's end.
  void set_loop(std::optional<LoopRange> loop);
  /// Frames decoded from now on go through the decorator, from `number` on anew; null for none.
  void set_decorator(std::shared_ptr<FrameDecorator> decorator, std::uint64_t number);

  LoaderSnapshot snapshot() const;
  /// Packet sizes of frames `first` to `last`, as far as they were met lately.
  std::vector<FrameBytes> frame_bytes(std::uint64_t first, std::uint64_t last) const;
  /// Decoded frames behind the one shown, and whether there will be more.
  struct Supply {
    std::size_t ahead = 0;
    bool complete = false;  ///< no more will come, or no more fit
    bool failed = false;
    bool can_go_back = true;  ///< to frame 0; not in a pipe or a live stream whose beginning was dropped
    std::optional<std::uint64_t> frame_count;
  };
  Supply supply() const;

 private:
  struct Request {
    std::uint64_t frame = 0;
    std::uint64_t lead_in = 0;
  };

  void request(const Request& request);

  // Decoding thread.
  void run();
  void go_on();
  enum class Work { kNone, kRequest, kLoop, kDecode };
  Work find_work() const;
  void take_index();
  void begin_request(const Request& request);
  void wait_for_index(std::uint64_t frame);
  void go_to(std::uint64_t frame);
  void advance();
  void feed();
  void begin_live_anew();
  void take_data();
  void begin_mesh();
  void begin_gop();
  void take_frame(double decode_ms);
  void fill_frame(PlayerFrame& frame, double decode_ms);
  void push_frame(std::shared_ptr<PlayerFrame> frame);
  void note_damage();
  void begin_round(std::uint64_t end);
  void end_stream();
  void fail(const Error& error);
  void fit_ring(std::size_t vertices);

  // Index thread.
  void load_index();
  void find_index();
  std::optional<std::vector<IndexEntry>> fetch_index(std::uint64_t& end);

  const LoaderOptions options_;
  const std::unique_ptr<StreamInput> input_;

  mutable std::mutex mutex_;
  const std::shared_ptr<Bell> work_ = std::make_shared<Bell>();  ///< for the decoding thread
  std::condition_variable index_;                                ///< for the index thread
  FrameRing ring_;
  StreamFacts facts_;
  LoaderSnapshot state_;  ///< what of the snapshot is kept ready
  std::optional<Request> request_;
  std::optional<LoopRange> loop_;
  std::shared_ptr<FrameDecorator> decorator_;
  std::optional<std::vector<IndexEntry>> new_index_;  ///< for the decoder
  bool wants_index_ = false;
  bool index_done_ = false;
  bool active_ = true;       ///< there is more to decode
  bool began_anew_ = false;  ///< a live stream was opened again
  bool opened_ = false;      ///< a frame has been decoded
  bool stopped_ = false;

  // Of the decoding thread alone.
  FramePool pool_{work_};
  std::unique_ptr<Decoder> decoder_;
  std::vector<std::uint8_t> piece_;
  std::vector<IndexEntry> entries_;  ///< the index, for a decoder that begins anew
  std::uint64_t offset_ = 0;         ///< in the stream, of the next byte to push
  std::uint64_t base_ = 0;  ///< number of the decoder's frame 0: a live stream that is opened again goes on
  std::uint64_t next_frame_ = 0;         ///< number after the last frame decoded or lost
  std::optional<std::uint64_t> target_;  ///< frame to seek as soon as the head is in
  bool has_head_ = false;
  bool failed_ = false;
  int openings_in_vain_ = 0;      ///< of a live stream, since it brought a frame
  bool pushed_in_round_ = false;  ///< a loop with no frame at all must end
  std::shared_ptr<const PlayerGop> gop_;
  ShownMaterials materials_;
  bool has_materials_ = false;  ///< they are made: a mesh has come
  std::shared_ptr<const Surface> surface_;
  std::shared_ptr<FrameDecorator> used_decorator_;

  std::thread index_thread_;
  std::thread thread_;
};

}  // namespace tvg::player
