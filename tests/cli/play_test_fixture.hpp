#pragma once
#include "tool_test_fixture.hpp"

#include <unistd.h>

namespace tvg::cli::testing {

/// Shell functions: `display` starts a display in memory and sets X, its process; `serve` a server with URL U
/// and process S.
inline constexpr const char* kFunctions = R"(
display() {
  rm -f display
  Xvfb -displayfd 5 -screen 0 800x600x24 5>display 2>/dev/null & X=$!
  for i in $(seq 300); do [ -s display ] && break; sleep 0.02; done
  export DISPLAY=:$(cat display)
}
serve() {
  rm -f url
  tvg serve . --port 0 >url 2>log & S=$!
  for i in $(seq 500); do [ -s url ] && break; sleep 0.02; done
  U=$(cat url)
}
)";

class PlayTest : public ToolTest {
 protected:
  void SetUp() override {
    if (::access("/usr/bin/Xvfb", X_OK) != 0) GTEST_SKIP() << "Xvfb is not installed";
    folder_.write("functions", kFunctions);
    good("tvg encode hand.obj hand.pc2 -q -o hand.tvg --bits 12:10 --gop 4");
  }

  /// Runs `text` where there is a display, which is gone afterwards.
  Outcome on_display(const std::string& text) const {
    return run(". ./functions; display; " + text + "; R=$?; kill $X; wait $X 2>/dev/null; exit $R");
  }
  nlohmann::json report() const { return nlohmann::json::parse(folder_.read("report.json")); }
};

}  // namespace tvg::cli::testing
