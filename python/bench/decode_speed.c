/* decode_speed FILE.tvg RUNS: seconds that decoding takes, the least of so many runs: the stream is in
 * memory, and every frame is copied out. What decode_speed.py is held against. */
#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include <tvg/tvg.h>

static double now(void) {
  struct timespec time;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static unsigned char* read_file(const char* path, size_t* size) {
  FILE* const file = fopen(path, "rb");
  if (file == NULL) return NULL;
  fseek(file, 0, SEEK_END);
  *size = (size_t)ftell(file);
  rewind(file);
  unsigned char* const bytes = malloc(*size);
  if (bytes != NULL && fread(bytes, 1, *size, file) != *size) *size = 0;
  fclose(file);
  return bytes;
}

/* How many frames there are: each is copied into the same memory, as a player does. */
static size_t decode(const unsigned char* bytes, size_t size) {
  tvg_decoder* const decoder = tvg_decoder_create(NULL);
  tvg_mesh_info mesh = {.struct_size = sizeof mesh};
  float* positions = NULL;
  size_t at = 0, frames = 0, room = 0;
  for (;;) {
    const tvg_event event = tvg_decoder_poll(decoder);
    if (event == TVG_EVENT_END || event == TVG_EVENT_ERROR) break;
    if (event == TVG_EVENT_MESH && tvg_decoder_get_mesh(decoder, &mesh) == TVG_OK) {
      free(positions);
      room = 12 * (size_t)mesh.vertex_count;
      positions = malloc(room);
    } else if (event == TVG_EVENT_NEED_BYTES) {
      const size_t piece = size - at < 131072 ? size - at : 131072;
      piece > 0 ? tvg_decoder_push(decoder, bytes + at, piece) : tvg_decoder_finish(decoder);
      at += piece;
    } else if (event == TVG_EVENT_FRAME &&
               tvg_decoder_copy_positions(decoder, positions, room, 12) == TVG_OK) {
      ++frames;
    }
  }
  free(positions);
  tvg_decoder_destroy(decoder);
  return frames;
}

int main(int count, char** arguments) {
  size_t size = 0, frames = 0;
  unsigned char* const bytes = count == 3 ? read_file(arguments[1], &size) : NULL;
  if (bytes == NULL) return fprintf(stderr, "usage: decode_speed FILE.tvg RUNS\n"), 2;
  double least = 1e9;
  for (int run = atoi(arguments[2]); run > 0; --run) {
    const double begin = now();
    frames = decode(bytes, size);
    const double taken = now() - begin;
    if (taken < least) least = taken;
  }
  printf("%zu %.6f\n", frames, least);
  free(bytes);
  return 0;
}
