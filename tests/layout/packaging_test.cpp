#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

namespace {

std::string read(const std::string& path) {
  std::ifstream file(std::string(TVG_SOURCE_DIR) + "/" + path);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> all_matches(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator i(text.begin(), text.end(), regex), end; i != end; ++i) found.push_back((*i)[1]);
  return found;
}

TEST(Packaging, EveryPackageHasTheVersionOfTheProject) {
  const std::vector<std::string> project =
      all_matches(read("CMakeLists.txt"), "project\\(tvg VERSION ([0-9.]+)");
  ASSERT_EQ(project.size(), 1u);
  EXPECT_EQ(all_matches(read("packaging/vcpkg/ports/tvg/vcpkg.json"), "\"version\": \"([^\"]+)\""), project);
  EXPECT_EQ(all_matches(read("packaging/conan/conanfile.py"), "\n    version = \"([^\"]+)\""), project);
}

TEST(Packaging, RecipesSetOptionsThatTheProjectHas) {
  const std::string project = read("CMakeLists.txt");
  const std::string port = read("packaging/vcpkg/ports/tvg/portfile.cmake");
  const std::string recipe = read("packaging/conan/conanfile.py");
  for (const std::string& option : all_matches(port, "(TVG_BUILD_[A-Z]+)"))
    EXPECT_TRUE(std::regex_search(project, std::regex("option\\(\\s*" + option))) << option;
  for (const std::string& part : all_matches(recipe, "\"(TOOL|PLAYER|TESTS)\""))
    EXPECT_NE(project.find("TVG_BUILD_" + part), std::string::npos) << part;
  EXPECT_NE(recipe.find("TVG_BUILD_ENCODER"), std::string::npos);
}

}  // namespace
