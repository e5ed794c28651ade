#include "connectivity/vertex_order_encode.hpp"

#include "connectivity/vertex_order_coding.hpp"

#include <utility>
#include <vector>

namespace tvg {
namespace {

std::vector<std::uint8_t> with_mode(OrderMode mode, std::vector<std::uint8_t> coded) {
  coded.insert(coded.begin(), static_cast<std::uint8_t>(mode));
  return coded;
}

bool is_identity(std::span<const std::uint32_t> order) {
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (order[i] != i) return false;
  }
  return true;
}

}  // namespace

std::vector<std::uint8_t> encode_order(std::span<const std::uint32_t> order, std::span<const Gate> gates) {
  if (is_identity(order)) return with_mode(OrderMode::kIdentity, {});
  std::vector<std::uint32_t> copy(order.begin(), order.end());
  RangeEncoder near, uniform;
  NearOrder(gates).code(near, copy);
  code_uniform_order(uniform, copy);
  std::vector<std::uint8_t> near_bytes = near.finish(), uniform_bytes = uniform.finish();
  return near_bytes.size() <= uniform_bytes.size() ? with_mode(OrderMode::kNear, std::move(near_bytes))
                                                   : with_mode(OrderMode::kUniform, std::move(uniform_bytes));
}

}  // namespace tvg
