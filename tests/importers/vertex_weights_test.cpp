#include "encoder/importers/vertex_weights.hpp"

#include "encoder/importers/import_error.hpp"
#include "io_toolbox.hpp"

#include <cstring>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

namespace tvg::cli::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class VertexWeights : public ::testing::Test {
 protected:
  std::vector<double> read(const std::string& name, const std::string& bytes) const {
    folder_.write(name, bytes);
    return read_vertex_weights(folder_.path(name));
  }

  std::string complaint(const std::string& name, const std::string& bytes) const {
    try {
      read(name, bytes);
      return "";
    } catch (const ImportError& error) {
      EXPECT_THAT(error.what(), HasSubstr(name));
      return error.what();
    }
  }

  /// A file as numpy.save() writes it.
  template <class T>
  static std::string numpy(const std::vector<T>& values, const std::string& dictionary) {
    std::string header = dictionary;
    while ((10 + header.size() + 1) % 64 != 0) header += ' ';
    header += '\n';
    std::string bytes("\x93NUMPY\x01\x00", 8);
    bytes += static_cast<char>(header.size() & 0xFF);
    bytes += static_cast<char>(header.size() >> 8);
    bytes += header;
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    return bytes;
  }
  static std::string dictionary(const std::string& type, const std::string& shape,
                                const std::string& fortran = "False") {
    return "{'descr': '" + type + "', 'fortran_order': " + fortran + ", 'shape': " + shape + ", }";
  }

  TemporaryFolder folder_;
};

TEST_F(VertexWeights, AreANumberOnEachLine) {
  EXPECT_THAT(read("w.txt", "# mine\n1\n-2.5\n\n  3e-2  \r\n"), ElementsAre(1, -2.5, double{3e-2F}));
}

TEST_F(VertexWeights, AreNumpyArraysOfBothWidths) {
  EXPECT_THAT(read("w.npy", numpy<float>({1.5F, -2}, dictionary("<f4", "(2,)"))), ElementsAre(1.5, -2));
  EXPECT_THAT(read("w.npy", numpy<double>({0.1, 1e30, 3}, dictionary("<f8", "(3,)"))),
              ElementsAre(0.1, 1e30, 3));
}

TEST_F(VertexWeights, RefuseTextThatIsNoList) {
  EXPECT_THAT(complaint("w.txt", "1\ntwo\n"), HasSubstr("line 2"));
  EXPECT_THAT(complaint("w.txt", "1\n2 3\n"), HasSubstr("line 2"));
  EXPECT_THAT(complaint("w.txt", "1\nnan\n"), HasSubstr("w.txt"));
  EXPECT_THAT(complaint("w.txt", "1\n1e999\n"), HasSubstr("w.txt"));
  EXPECT_THROW(read_vertex_weights(folder_.path("absent.txt")), ImportError);
}

TEST_F(VertexWeights, RefuseOtherNumpyArraysAndSayWhatWouldDo) {
  const std::vector<float> two = {1, 2};
  EXPECT_THAT(complaint("w.npy", "1\n2\n"), HasSubstr("signature"));
  EXPECT_THAT(complaint("w.npy", numpy(two, dictionary(">f4", "(2,)"))), HasSubstr("'>f4'"));
  EXPECT_THAT(complaint("w.npy", numpy(two, dictionary("<i4", "(2,)"))), HasSubstr("float32"));
  EXPECT_THAT(complaint("w.npy", numpy(two, dictionary("<f4", "(2, 1)"))), HasSubstr("one dimension"));
  EXPECT_THAT(complaint("w.npy", numpy(two, dictionary("<f4", "()"))), HasSubstr("one dimension"));
  EXPECT_THAT(complaint("w.npy", numpy(two, dictionary("<f4", "(2,)", "True"))), HasSubstr("Fortran"));
  EXPECT_THAT(complaint("w.npy", numpy(two, dictionary("<f4", "(3,)"))), HasSubstr("3 numbers"));
  EXPECT_THAT(complaint("w.npy", numpy(two, dictionary("<f4", "(1,)"))), HasSubstr("1 numbers"));
  EXPECT_THAT(complaint("w.npy", numpy(two, dictionary("<f4", "(99999999999999999999,)"))),
              HasSubstr("shape"));
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_THAT(complaint("w.npy", numpy<float>({1, infinity}, dictionary("<f4", "(2,)"))),
              HasSubstr("number 1"));
}

TEST_F(VertexWeights, RefuseEveryTruncationOfANumpyFile) {
  const std::string whole = numpy<double>({1, 2, 3}, dictionary("<f8", "(3,)"));
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_NE(complaint("w.npy", whole.substr(0, size)), "") << size;
  }
  EXPECT_NE(complaint("w.npy", whole + "x"), "");
}

TEST_F(VertexWeights, SurviveEveryChangeOfAByteInANumpyHeader) {
  const std::string whole = numpy<float>({1, 2}, dictionary("<f4", "(2,)"));
  for (std::size_t at = 0; at + 8 < whole.size(); ++at) {
    for (const int value : {0, 0x27, 0x28, 0x39, 0x80, 0xFF}) {
      std::string changed = whole;
      changed[at] = static_cast<char>(value);
      // Either refused, or read as two numbers: the header may be changed where it does not matter.
      if (complaint("w.npy", changed).empty()) {
        EXPECT_EQ(read("w.npy", changed).size(), 2U);
      }
    }
  }
}

}  // namespace
}  // namespace tvg::cli::testing
