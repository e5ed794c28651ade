#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <tvg/properties.hpp>
#include <tvg/types.hpp>

namespace tvg::cli {

/// An attribute of vertices without values.
Attribute empty_attribute(std::string name, AttributeKind kind, std::uint32_t components);

/// Attributes of vertices, put together from stretches of a mesh that need not have the same ones. What a
/// stretch has not is white, (0, 0) or 0 there.
class AttributeGatherer {
 public:
  /// At most so many numbers are taken.
  explicit AttributeGatherer(std::uint64_t most_numbers) : most_(most_numbers) {}

  /// Goes on with `vertices` more vertices, of which `attributes` have one value each. False where there
  /// would be more numbers, and then nothing is taken.
  bool take(std::size_t vertices, std::span<const Attribute> attributes);
  /// What has been gathered, in the order of appearance, [vertex][component] each; it is empty then.
  std::vector<Attribute> finish() { return std::move(gathered_); }
  /// Attributes above kMaxAttributes, which were left out.
  std::size_t left_out() const { return left_out_; }

 private:
  Attribute* find(const Attribute& like);

  std::uint64_t most_;
  std::size_t vertices_ = 0;
  std::size_t left_out_ = 0;
  std::vector<Attribute> gathered_;
};

/// The same attribute where vertices have been joined: `faces` as they were before, `vertex_of` for each
/// vertex of them the one it became, of `vertex_count`. Its domain is kCorner where corners of one vertex
/// differ; values count where a face uses them, and else of the first that became a vertex.
Attribute with_joined_vertices(const Attribute& of_vertices, std::span<const Face> faces,
                               std::span<const std::uint32_t> vertex_of, std::uint32_t vertex_count);

/// Bytes of a name in a stream.
inline constexpr std::size_t kLongestName = 1024;

/// `name` as a stream may have it: bytes that are no text become '_', and what is longer is cut.
std::string plain_name(std::string name, std::size_t longest = kLongestName);

}  // namespace tvg::cli
