/* What a GPU needs to make the frames of TVG_MODE_BASIS by itself. tvg.h includes this header; what stands
 * there of states, sizes and ownership holds here too.
 *
 * Such frames are sums and nothing else. A GOP has some planes, which it mostly shares with others: each is
 * one number for each vertex, its coefficient, a whole one. A frame has a row of x, y and z for each plane
 * and one to begin with. Vertex v is at
 *
 *   rows[0] + planes[0][v] * rows[1] + planes[1][v] * rows[2] + ...
 *
 * So the planes are uploaded once, when tvg_basis_info says another number than before, and for each frame
 * its rows: nothing is done on the CPU for each vertex, for the decoder makes positions when
 * tvg_decoder_copy_positions or what stands on it is called, and not before. The digest of a GOP is over its
 * rows and is compared all the same; of the sums there is none, and a GPU's differ in their last bits. */
#ifndef TVG_TVG_BASIS_H
#define TVG_TVG_BASIS_H

#include <tvg/tvg.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct tvg_basis_info {
  size_t struct_size;
  uint64_t number;          /* of the planes, from 1: those of the same number are the same */
  uint32_t vertex_count;    /* of the mesh */
  uint32_t component_count; /* planes, as many as are decoded (tvg_decoder_use_components) */
  uint32_t most; /* no coefficient is larger in size; at most 2^24, so that float32 has it exactly */
} tvg_basis_info;

/* As tvg_decoder_get_gop; TVG_ERROR_WRONG_STATE while the GOP is in another mode. */
TVG_API tvg_code tvg_decoder_get_basis(const tvg_decoder* decoder, tvg_basis_info* basis);
/* Writes the coefficients of planes 4 * `group` to 4 * `group` + 3, [vertex][4], into `count` >=
   4 * vertex_count numbers: a texture with four channels. Planes that are not there are 0.
   TVG_ERROR_WRONG_STATE as above; TVG_ERROR_INVALID_ARGUMENT where there is no such group. Does not allocate.
 */
TVG_API tvg_code tvg_decoder_copy_planes(const tvg_decoder* decoder, uint32_t group, float* coefficients,
                                         size_t count);
/* The same in 16 bits; TVG_ERROR_INVALID_ARGUMENT where `most` is above 32767 too. */
TVG_API tvg_code tvg_decoder_copy_short_planes(const tvg_decoder* decoder, uint32_t group,
                                               int16_t* coefficients, size_t count);
/* Writes the rows of the frame, [1 + component][xyz], in the mesh's units, into `count` >=
   3 * (1 + component_count) numbers. As tvg_decoder_get_frame; TVG_ERROR_WRONG_STATE in other modes. Does not
   allocate. */
TVG_API tvg_code tvg_decoder_copy_rows(const tvg_decoder* decoder, float* rows, size_t count);

#ifdef __cplusplus
}
#endif

#endif /* TVG_TVG_BASIS_H */
