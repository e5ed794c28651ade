#pragma once
#include "tests/importers/io_toolbox.hpp"

#include <arpa/inet.h>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <netinet/in.h>
#include <optional>
#include <string>
#include <sys/socket.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace tvg::server::testing {

inline std::optional<std::string> find_nginx() {
  for (const char* path : {"/usr/sbin/nginx", "/usr/bin/nginx", "/usr/local/sbin/nginx"}) {
    if (access(path, X_OK) == 0) return path;
  }
  return std::nullopt;
}

/// nginx serving a folder on a port of its own, with nothing set that it does not need here.
class Nginx {
 public:
  Nginx(const std::string& program, const std::string& folder) {
    for (int attempt = 0; attempt < 5 && !running_; ++attempt) {
      port_ = free_port();
      start(program, folder);
    }
  }
  ~Nginx() { end(); }
  Nginx(const Nginx&) = delete;
  Nginx& operator=(const Nginx&) = delete;

  bool running() const { return running_; }
  int port() const { return port_; }

 private:
  static sockaddr_in loopback(int port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    return address;
  }

  /// Someone else may take it before nginx does; then the next attempt gets another.
  static int free_port() {
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address = loopback(0);
    socklen_t size = sizeof address;
    ::bind(socket, reinterpret_cast<sockaddr*>(&address), size);
    ::getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size);
    ::close(socket);
    return ntohs(address.sin_port);
  }

  bool answers() const {
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address = loopback(port_);
    const bool connected = ::connect(socket, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
    ::close(socket);
    return connected;
  }

  void start(const std::string& program, const std::string& folder) {
    const std::string own = own_.path("");
    std::string text;
    if (geteuid() == 0) text += "user root;\n";  // the folder is for its owner only
    text += "daemon off; master_process off; worker_processes 1; pid " + own + "pid;\n";
    text += "error_log " + own + "error.log;\nevents { worker_connections 64; }\n";
    text += "http { access_log off; default_type application/octet-stream; types { model/vnd.tvg tvg; }\n";
    for (const char* kind : {"client_body", "proxy", "fastcgi", "uwsgi", "scgi"})
      text += std::string(kind) + "_temp_path " + own + kind + ";\n";
    text += "server { listen 127.0.0.1:" + std::to_string(port_) + "; root " + folder + "; } }\n";
    const std::string config = own_.write("nginx.conf", text);
    const std::string log = own_.path("error.log");
    pid_ = fork();
    if (pid_ == 0) {
      execl(program.c_str(), "nginx", "-e", log.c_str(), "-p", own.c_str(), "-c", config.c_str(), nullptr);
      _exit(127);
    }
    for (int wait = 0; wait < 500 && !running_; ++wait) {
      int status = 0;
      if (waitpid(pid_, &status, WNOHANG) == pid_) {
        pid_ = -1;
        return;
      }
      running_ = answers();
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    if (!running_) end();
  }

  void end() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGTERM);
    ::waitpid(pid_, nullptr, 0);
    pid_ = -1;
  }

  cli::testing::TemporaryFolder own_;
  pid_t pid_ = -1;
  int port_ = 0;
  bool running_ = false;
};

}  // namespace tvg::server::testing
