#pragma once
#include <filesystem>
#include <httplib.h>
#include <string>

namespace tvg::server {

/// Whether a client would rather have a page than JSON: browsers say so.
bool wants_html(const httplib::Request& request);

/// The player that web/ builds, over HTTP: its page at "/?stream=URL" and "/?live=NAME", which it reads
/// itself, and what the page needs below kFolder.
class PlayerFiles {
 public:
  /// What no file of the folder that is served can be called.
  static constexpr const char* kFolder = "/.tvg/";

  /// `folder`: of the player's files; empty where there is no player. Throws ToolError: kIo where they cannot
  /// be read, kInvalidInput where they are something else.
  explicit PlayerFiles(const std::string& folder);

  bool available() const { return !page_.empty(); }
  /// Answers GET or HEAD where the request is for the player; false where it is for something else.
  bool answer(const httplib::Request& request, httplib::Response& response) const;

 private:
  std::filesystem::path folder_;
  std::string page_;  // empty without a player
};

}  // namespace tvg::server
