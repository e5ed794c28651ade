#include "cli/commands.hpp"
#include "cli/number_option.hpp"
#include "cli/player_folder.hpp"
#include "server/stream_server.hpp"
#include "tool/tool_error.hpp"

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <pthread.h>

namespace tvg::cli {

namespace {

struct ServeArguments {
  server::ServerOptions options;
  double timeout = 30;
  bool no_live = false;
  bool quiet = false;
};

void run_serve(const ServeArguments& arguments) {
  // Blocked before any thread begins, so that all of them are and this one can wait for a signal.
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);

  server::ServerOptions options = arguments.options;
  options.live = !arguments.no_live;
  // Only where a folder is named it has to be there: files and live streams need no player.
  options.player = (options.player.empty() ? find_player_folder({}) : player_folder(options.player)).string();
  options.timeout = std::chrono::milliseconds(static_cast<std::int64_t>(1000 * arguments.timeout));
  if (!arguments.quiet) options.log = [](const std::string& line) { fmt::print(stderr, "{}\n", line); };
  server::StreamServer server(options);
  server.start();
  fmt::print("{}/\n", server.url());
  if (!arguments.quiet && options.player.empty()) {
    fmt::print(
        stderr,
        "note: the player's files are not installed, so pages have no player; they are built with npm ci "
        "in web/ and the preset wasm (docs/web.md), and --player names the folder they lie in\n");
  }
  if (options.live && !arguments.quiet) {
    fmt::print(stderr, "serving {}; publish with tvg encode ... --live -o {}/live/NAME; Ctrl-C ends\n",
               options.folder, server.url());
  }
  std::fflush(stdout);
  int received = 0;
  sigwait(&signals, &received);
  server.stop();
}

}  // namespace

void add_serve_command(CLI::App& tool) {
  auto arguments = std::make_shared<ServeArguments>();
  server::ServerOptions& options = arguments->options;
  CLI::App& command = *tool.add_subcommand("serve", "Offer a folder and live streams over HTTP");
  command.add_option("folder", options.folder, "what to serve; names that begin with a dot are left out")
      ->required();
  command.add_option("--port", options.port, "0 for any that is free; the URL is printed")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  command
      .add_option("--address", options.address,
                  "address to listen on; 0.0.0.0 lets everyone who reaches this machine read and publish")
      ->capture_default_str();
  command.add_option("--max-clients", options.max_clients, "connections at a time; the next gets 503")
      ->check(CLI::Range(std::size_t{1}, server::kMostClients))
      ->capture_default_str();
  command
      .add_option(
          "--max-per-address", options.max_per_address,
          "of these, connections from one address; a reverse proxy is one, so give it as many as clients")
      ->check(CLI::Range(std::size_t{1}, server::kMostClients))
      ->capture_default_str();
  command.add_option("--max-live-streams", options.max_live_streams, "streams published at a time")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command
      .add_option(
          "--max-chunk-bytes", options.max_chunk_bytes,
          "largest GOP or mesh of a live stream; up to three of them are held for each stream and one "
          "for each viewer")
      ->check(CLI::Range(std::uint64_t{1} << 10, std::uint64_t{1} << 31))
      ->capture_default_str();
  add_number(
      command, "--timeout", {0.1, 3600}, [arguments](double value) { arguments->timeout = value; },
      "seconds a client may take to send a request, the next bytes of an upload, or to read on")
      ->default_str("30");
  command.add_option("--player", options.player,
                     "folder of the player's files, where they are not installed with the tool");
  command.add_flag("--no-live", arguments->no_live, "serve files only");
  command.add_flag("-q,--quiet", arguments->quiet, "print the URL and errors only");
  command.footer(
      "Live: PUT /live/NAME publishes, GET /live/NAME watches from the newest GOP on, GET /live/ lists.\n"
      "A viewer that falls behind skips to the newest GOP. Where an encoder ends or is lost, in the middle "
      "of\n"
      "a GOP too, that GOP is dropped, its viewers' streams end properly and the name is free again. Where "
      "a\n"
      "viewer is lost nobody notices. SIGINT and SIGTERM end all streams properly, exit status 0; where the\n"
      "server is killed, viewers' streams are cut (a decoder says truncated) and encoders end with status "
      "2.");
  command.callback([arguments] { run_serve(*arguments); });
}

}  // namespace tvg::cli
