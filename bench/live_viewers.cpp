// Watches a live stream with many viewers at once, each decoding it, and compares what they saw with each
// other and with the encoder's own output.
#include "base/checksum.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <curl/curl.h>
#include <fmt/format.h>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <sys/resource.h>
#include <thread>
#include <vector>

#include <tvg/decoder.hpp>

namespace {

using Clock = std::chrono::steady_clock;

struct SeenFrame {
  std::uint64_t source = 0;  ///< number in the sequence that was encoded
  std::uint64_t digest = 0;  ///< of lattice, flags and that number
  Clock::time_point at{};
};

/// Decodes what it is given and keeps a digest of each frame.
class FrameDigester {
 public:
  void push(std::span<const std::uint8_t> bytes) {
    decoder_.push(bytes);
    drain();
  }
  void finish() {
    decoder_.finish();
    drain();
  }

  const std::vector<SeenFrame>& frames() const { return frames_; }
  std::size_t damages() const { return damages_; }
  bool complete() const { return complete_; }

 private:
  void drain() {
    for (;;) {
      switch (decoder_.poll()) {
        case tvg::Decoder::Event::kNeedBytes:
        case tvg::Decoder::Event::kError:
          return;
        case tvg::Decoder::Event::kEnd:
          complete_ = true;
          return;
        case tvg::Decoder::Event::kDamage:
          ++damages_;
          break;
        case tvg::Decoder::Event::kFrame:
          digest_frame();
          break;
        default:
          break;
      }
    }
  }

  void digest_frame() {
    lattice_.resize(3 * std::size_t{decoder_.mesh().vertex_count});
    flags_.resize(decoder_.mesh().vertex_count);
    decoder_.copy_lattice(lattice_);
    decoder_.copy_flags(flags_);
    const tvg::GopInfo& gop = decoder_.gop();
    const std::uint64_t source = gop.source_frame + decoder_.frame_number() - gop.first_frame;
    tvg::Hasher hash;
    hash.update(std::span<const std::int32_t>(lattice_));
    hash.update(std::span<const std::uint8_t>(flags_));
    const std::array<std::int32_t, 2> number = {static_cast<std::int32_t>(source & 0x7FFFFFFF),
                                                static_cast<std::int32_t>(source >> 31)};
    hash.update(std::span<const std::int32_t>(number));
    frames_.push_back({source, hash.value(), Clock::now()});
  }

  tvg::Decoder decoder_;
  std::vector<std::int32_t> lattice_;
  std::vector<std::uint8_t> flags_;
  std::vector<SeenFrame> frames_;
  std::size_t damages_ = 0;
  bool complete_ = false;
};

struct Viewer {
  FrameDigester seen;
  Clock::time_point deadline{};
  std::string problem;
};

std::size_t take_bytes(char* bytes, std::size_t size, std::size_t count, void* target) {
  auto& viewer = *static_cast<Viewer*>(target);
  if (Clock::now() > viewer.deadline) return 0;  // leaves
  viewer.seen.push({reinterpret_cast<const std::uint8_t*>(bytes), size * count});
  return size * count;
}

void watch(const std::string& url, Viewer& viewer) {
  const std::unique_ptr<CURL, decltype(&curl_easy_cleanup)> easy(curl_easy_init(), &curl_easy_cleanup);
  curl_easy_setopt(easy.get(), CURLOPT_URL, url.c_str());
  curl_easy_setopt(easy.get(), CURLOPT_NOSIGNAL, 1L);
  curl_easy_setopt(easy.get(), CURLOPT_FAILONERROR, 1L);
  curl_easy_setopt(easy.get(), CURLOPT_WRITEFUNCTION, &take_bytes);
  curl_easy_setopt(easy.get(), CURLOPT_WRITEDATA, &viewer);
  const CURLcode code = curl_easy_perform(easy.get());
  if (code == CURLE_OK) viewer.seen.finish();
  if (code != CURLE_OK && code != CURLE_WRITE_ERROR) viewer.problem = curl_easy_strerror(code);
}

/// Digests of the encoder's own stream by frame; its end may be missing.
std::map<std::uint64_t, std::uint64_t> digest_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot open " + path);
  FrameDigester digester;
  std::vector<char> piece(std::size_t{1} << 20);
  while (file.read(piece.data(), static_cast<std::streamsize>(piece.size())), file.gcount() > 0) {
    digester.push(
        {reinterpret_cast<const std::uint8_t*>(piece.data()), static_cast<std::size_t>(file.gcount())});
  }
  digester.finish();
  std::map<std::uint64_t, std::uint64_t> digests;
  for (const SeenFrame& frame : digester.frames()) digests[frame.source] = frame.digest;
  return digests;
}

template <class T>
T quantile(std::vector<T> values, double share) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// Whether every frame that was seen is the encoder's, and what was missed.
bool report(const std::vector<std::unique_ptr<Viewer>>& viewers,
            const std::map<std::uint64_t, std::uint64_t>& encoded) {
  std::vector<std::size_t> counts;
  std::map<std::uint64_t, Clock::time_point> first_seen;
  std::map<std::uint64_t, std::uint64_t> digests = encoded;
  std::uint64_t missed = 0, mismatches = 0, unknown = 0, damages = 0, problems = 0;
  for (const auto& viewer : viewers) {
    const std::vector<SeenFrame>& frames = viewer->seen.frames();
    counts.push_back(frames.size());
    damages += viewer->seen.damages();
    if (!viewer->problem.empty()) {
      ++problems;
      fmt::print("problem: {}\n", viewer->problem);
    }
    for (std::size_t i = 0; i < frames.size(); ++i) {
      if (i > 0) missed += frames[i].source - frames[i - 1].source - 1;
      const auto [at, is_new] = first_seen.emplace(frames[i].source, frames[i].at);
      if (!is_new) at->second = std::min(at->second, frames[i].at);
      // Without the encoder's own output the first viewer's frame stands for it.
      const auto [known, was_unknown] = digests.emplace(frames[i].source, frames[i].digest);
      if (was_unknown && !encoded.empty()) ++unknown;
      if (known->second != frames[i].digest) ++mismatches;
    }
  }
  std::vector<double> behind;
  for (const auto& viewer : viewers) {
    for (const SeenFrame& frame : viewer->seen.frames())
      behind.push_back(
          std::chrono::duration<double, std::milli>(frame.at - first_seen[frame.source]).count());
  }
  fmt::print("viewers {}, of these failed {}\n", viewers.size(), problems);
  fmt::print("frames per viewer: min {}, median {}, max {}\n", quantile(counts, 0), quantile(counts, 0.5),
             quantile(counts, 1));
  fmt::print("frames missed between the first and the last a viewer saw, all viewers: {}\n", missed);
  fmt::print("digest mismatches: {}; frames the encoder's output does not have: {}; damage reports: {}\n",
             mismatches, unknown, damages);
  fmt::print("behind the first viewer to have the frame: median {:.1f} ms, 99% {:.1f} ms, max {:.1f} ms\n",
             quantile(behind, 0.5), quantile(behind, 0.99), quantile(behind, 1));
  return mismatches + unknown + damages + problems == 0 && quantile(counts, 0) > 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Watches a live stream with many viewers and checks every frame they see");
  std::string url;
  std::string against;
  std::size_t count = 50;
  double seconds = 60;
  app.add_option("url", url, "a live stream, http://host:port/live/NAME")->required();
  app.add_option("--viewers", count, "how many at once")->check(CLI::Range(1, 400))->capture_default_str();
  app.add_option("--seconds", seconds, "how long they watch")->capture_default_str();
  app.add_option("--against", against, "the encoder's own output, read when the viewers have left");
  CLI11_PARSE(app, argc, argv);

  curl_global_init(CURL_GLOBAL_DEFAULT);
  std::vector<std::unique_ptr<Viewer>> viewers;
  std::vector<std::thread> threads;
  const auto deadline =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  for (std::size_t i = 0; i < count; ++i) {
    viewers.push_back(std::make_unique<Viewer>());
    viewers.back()->deadline = deadline;
    threads.emplace_back([&url, viewer = viewers.back().get()] { watch(url, *viewer); });
  }
  for (std::thread& thread : threads) thread.join();
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  fmt::print("processor time of all viewers: {}.{:02} s user, {}.{:02} s system\n", usage.ru_utime.tv_sec,
             usage.ru_utime.tv_usec / 10000, usage.ru_stime.tv_sec, usage.ru_stime.tv_usec / 10000);
  try {
    return report(viewers, against.empty() ? std::map<std::uint64_t, std::uint64_t>() : digest_file(against))
               ? 0
               : 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
