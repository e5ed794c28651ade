/* Writes a stream of a square cloth with a wave running over it:
 *   encode_wave > wave.tvg        or        encode_wave | print_frames */
#include <math.h>
#include <stdio.h>

#include <tvg/tvg.h>

enum { kSide = 33, kFrames = 60 };

static int write_to_stdout(void* user, const void* bytes, size_t size) {
  (void)user;
  return fwrite(bytes, 1, size, stdout) == size ? 0 : 1;
}

/* Two triangles for each cell of the grid, [face][corner]. */
static uint32_t make_faces(uint32_t faces[][3]) {
  uint32_t count = 0;
  for (uint32_t y = 0; y + 1 < kSide; ++y) {
    for (uint32_t x = 0; x + 1 < kSide; ++x) {
      const uint32_t corner = kSide * y + x;
      const uint32_t cell[2][3] = {{corner, corner + 1, corner + kSide},
                                   {corner + 1, corner + kSide + 1, corner + kSide}};
      for (int half = 0; half < 2; ++half, ++count) {
        for (int i = 0; i < 3; ++i) faces[count][i] = cell[half][i];
      }
    }
  }
  return count;
}

/* Where each vertex lies on a texture, from 0 to 1. */
static tvg_code add_texture_coordinates(tvg_encoder* encoder) {
  static float coordinates[kSide * kSide][2];
  const tvg_attribute attribute = {.struct_size = sizeof attribute,
                                   .name = "uv",
                                   .kind = TVG_ATTRIBUTE_TEXCOORD,
                                   .domain = TVG_DOMAIN_VERTEX,
                                   .components = 2,
                                   .values = coordinates,
                                   .value_count = kSide * kSide};
  for (int v = 0; v < kSide * kSide; ++v) {
    coordinates[v][0] = (float)(v % kSide) / (kSide - 1);
    coordinates[v][1] = (float)(v / kSide) / (kSide - 1);
  }
  return tvg_encoder_add_attribute(encoder, &attribute);
}

static void make_frame(int frame, float positions[][3]) {
  for (int v = 0; v < kSide * kSide; ++v) {
    positions[v][0] = (float)(v % kSide);
    positions[v][1] = (float)(v / kSide);
    positions[v][2] = (float)sin(0.3 * (v % kSide) + 0.2 * frame);
  }
}

int main(void) {
  static uint32_t faces[2 * (kSide - 1) * (kSide - 1)][3];
  static float positions[kSide * kSide][3];
  tvg_encoder_options options = {.struct_size = sizeof options};
  tvg_encoder* encoder = NULL;
  tvg_code code;
  tvg_encoder_options_init(&options);
  options.fine_bits = options.coarse_bits = 12;
  code = tvg_encoder_create(&options, write_to_stdout, NULL, &encoder);
  if (code == TVG_OK) code = tvg_encoder_set_metadata(encoder, "fps", "30");
  if (code == TVG_OK) code = add_texture_coordinates(encoder);
  if (code == TVG_OK) code = tvg_encoder_set_mesh(encoder, kSide * kSide, faces[0], make_faces(faces));
  for (int frame = 0; frame < kFrames && code == TVG_OK; ++frame) {
    make_frame(frame, positions);
    code = tvg_encoder_add_frame(encoder, positions, sizeof positions, sizeof positions[0]);
  }
  if (code == TVG_OK) code = tvg_encoder_finish(encoder, NULL);
  if (code != TVG_OK)
    fprintf(stderr, "%s\n", encoder != NULL ? tvg_encoder_error_text(encoder) : tvg_code_name((int)code));
  tvg_encoder_destroy(encoder);
  return code == TVG_OK ? 0 : 1;
}
