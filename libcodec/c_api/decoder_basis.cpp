#include "c_api/decoder_handle.hpp"
#include "c_api/support.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include <tvg/decoder.hpp>
#include <tvg/tvg.h>

// The C interface to the planes and rows of mode basis, for who makes its frames elsewhere.

namespace {

using tvg::c_api::give;

/// The planes of the GOP; number 0 where there are none.
tvg::BasisInfo basis_of(const tvg_decoder& decoder) {
  return decoder.has_gop ? decoder.decoder.basis() : tvg::BasisInfo();
}

template <class Number>
tvg_code copy_planes(const tvg_decoder* decoder, std::uint32_t group, Number* coefficients, std::size_t count,
                     std::int32_t most) {
  if (decoder == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  const tvg::BasisInfo basis = basis_of(*decoder);
  if (basis.number == 0) return TVG_ERROR_WRONG_STATE;
  const std::size_t vertices = decoder->decoder.mesh().vertex_count;
  if (std::uint64_t{group} * 4 >= basis.components || basis.most > most || count / 4 < vertices ||
      (coefficients == nullptr && vertices > 0))
    return TVG_ERROR_INVALID_ARGUMENT;
  decoder->decoder.copy_planes(group, std::span(coefficients, 4 * vertices));
  return TVG_OK;
}

}  // namespace

tvg_code tvg_decoder_get_basis(const tvg_decoder* decoder, tvg_basis_info* info) {
  if (decoder == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  const tvg::BasisInfo basis = basis_of(*decoder);
  if (basis.number == 0) return TVG_ERROR_WRONG_STATE;
  return give<tvg_basis_info>({sizeof(tvg_basis_info), basis.number, decoder->decoder.mesh().vertex_count,
                               basis.components, static_cast<std::uint32_t>(basis.most)},
                              info);
}

tvg_code tvg_decoder_copy_planes(const tvg_decoder* decoder, uint32_t group, float* coefficients,
                                 size_t count) {
  return copy_planes(decoder, group, coefficients, count, std::numeric_limits<std::int32_t>::max());
}

tvg_code tvg_decoder_copy_short_planes(const tvg_decoder* decoder, uint32_t group, int16_t* coefficients,
                                       size_t count) {
  return copy_planes(decoder, group, coefficients, count, std::numeric_limits<std::int16_t>::max());
}

tvg_code tvg_decoder_copy_rows(const tvg_decoder* decoder, float* rows, size_t count) {
  if (decoder == nullptr) return TVG_ERROR_INVALID_ARGUMENT;
  const tvg::BasisInfo basis = basis_of(*decoder);
  if (!decoder->has_frame || basis.number == 0) return TVG_ERROR_WRONG_STATE;
  const std::size_t needed = 3 * (std::size_t{basis.components} + 1);
  if (rows == nullptr || count < needed) return TVG_ERROR_INVALID_ARGUMENT;
  decoder->decoder.copy_rows(std::span(rows, needed));
  return TVG_OK;
}
