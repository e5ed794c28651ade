#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace tvg::server {

struct ServerOptions {
  std::string folder;
  std::string player;  ///< folder of the player's files, which web/ builds; empty: none is offered
  std::string address = "127.0.0.1";
  int port = 8080;               ///< 0: the system picks one
  std::size_t max_clients = 64;  ///< connections at a time, 1 to kMostClients; the next gets 503
  /// Of these, connections from one address; the next gets 503. A reverse proxy is one address.
  std::size_t max_per_address = 32;
  bool live = true;  ///< whether /live/ takes and gives streams
  std::size_t max_live_streams = 8;
  std::uint64_t max_chunk_bytes = std::uint64_t{64} << 20;  ///< of any chunk of a live stream
  /// How long a client may take over a request's head, over the next byte of an upload, and over taking a
  /// piece of an answer (64 KiB at most).
  std::chrono::milliseconds timeout{30000};
  /// The clock that `timeout` goes by; any thread.
  std::function<std::chrono::steady_clock::time_point()> now = std::chrono::steady_clock::now;
  std::function<void(const std::string&)> log;  ///< hears what live streams do, a line at a time; any thread
};

/// Each client holds a socket and perhaps a file, and httplib waits with select().
inline constexpr std::size_t kMostClients = 400;

/// Serves a folder's files and live streams over HTTP, and to browsers pages: the player (PlayerFiles), and
/// of folders their index.html or else a start page, where others get JSON. What happens when one party goes
/// away:
/// - An encoder that ends or is cut off, in the middle of a GOP too: that GOP is dropped, viewers get what is
///   complete, then an index and an end, so that what they saved is a whole stream; the name is free again.
/// - A viewer: nobody else notices.
/// - A viewer that does not read: it is given the newest GOP when it reads again; after the time limit its
///   connection is cut.
/// - The server, by stop(): as if all encoders had ended. Killed: viewers' streams are cut, which a decoder
///   reports as kTruncated, and encoders' uploads fail.
class StreamServer {
 public:
  /// Binds the port. Throws ToolError: kIo where the folder cannot be read or the port not be had.
  explicit StreamServer(ServerOptions options);
  /// Ends as stop() does, and waits for it.
  ~StreamServer();
  StreamServer(const StreamServer&) = delete;
  StreamServer& operator=(const StreamServer&) = delete;

  /// "http://127.0.0.1:8080".
  std::string url() const;
  int port() const;
  /// Serves on threads of its own until stop().
  void start();
  /// Ends live streams properly, gives viewers a few seconds to take their ends, and closes everything.
  /// Throws nothing; may be called more than once.
  void stop();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace tvg::server
