#include "connectivity/vertex_order.hpp"
#include "connectivity/vertex_order_coding.hpp"

#include <numeric>

namespace tvg {
namespace {

Error order_error(const char* message) {
  Error error;
  error.code = ErrorCode::kMalformed;
  error.message = message;
  error.section = "§5.2";
  return error;
}

}  // namespace

// format-spec §5.2
Result<std::vector<std::uint32_t>> decode_order(std::span<const std::uint8_t> bytes,
                                                std::span<const Gate> gates) {
  if (bytes.empty()) return order_error("the vertex order is missing");
  std::vector<std::uint32_t> order(gates.size());
  const auto mode = static_cast<OrderMode>(bytes[0]);
  if (mode == OrderMode::kIdentity) {
    std::iota(order.begin(), order.end(), 0u);
    if (bytes.size() != 1) return order_error("bytes follow a vertex order that needs none");
    return order;
  }
  if (mode != OrderMode::kNear && mode != OrderMode::kUniform)
    return order_error("unknown kind of vertex order");
  RangeDecoder coder(bytes.subspan(1));
  const bool valid =
      mode == OrderMode::kNear ? NearOrder(gates).code(coder, order) : code_uniform_order(coder, order);
  if (!valid || !coder.finished())
    return order_error("the vertex order is not a permutation of the vertices");
  return order;
}

}  // namespace tvg
