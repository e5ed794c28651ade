/* Prints a line for every frame of a stream as soon as its bytes are in:
 *   print_frames < clip.tvg        or        curl -sN http://host/clip.tvg | print_frames */
#include <stdio.h>
#include <stdlib.h>

#include <tvg/tvg.h>

static void print_attributes(const tvg_decoder* decoder) {
  tvg_attribute_info attribute = {.struct_size = sizeof attribute};
  for (uint32_t i = 0; tvg_decoder_get_attribute(decoder, i, &attribute) == TVG_OK; ++i)
    printf("attribute '%s': %u values of %u numbers\n", attribute.name, (unsigned)attribute.value_count,
           (unsigned)attribute.components);
}

/* Makes room for the frames of a mesh; null where memory is short. */
static float* use_mesh(const tvg_decoder* decoder, float* positions, size_t* size) {
  tvg_mesh_info mesh = {.struct_size = sizeof mesh};
  float* more;
  tvg_decoder_get_mesh(decoder, &mesh);
  *size = 3 * sizeof(float) * (size_t)mesh.vertex_count;
  more = realloc(positions, *size);
  if (more == NULL) free(positions);
  printf("mesh: %u vertices, %u faces\n", (unsigned)mesh.vertex_count, (unsigned)mesh.face_count);
  print_attributes(decoder);
  return more;
}

static void print_frame(const tvg_decoder* decoder, float* positions, size_t size) {
  tvg_frame_info frame = {.struct_size = sizeof frame};
  tvg_decoder_get_frame(decoder, &frame);
  tvg_decoder_copy_positions(decoder, positions, size, 3 * sizeof(float));
  printf("frame %llu: %llu bytes, first vertex %g %g %g\n", (unsigned long long)frame.number,
         (unsigned long long)frame.packet_bytes, positions[0], positions[1], positions[2]);
  fflush(stdout);
}

int main(void) {
  tvg_decoder* decoder = tvg_decoder_create(NULL);
  float* positions = NULL; /* [vertex][xyz] */
  size_t size = 0;
  int status = decoder == NULL ? 1 : -1;
  while (status < 0) {
    switch (tvg_decoder_poll(decoder)) {
      case TVG_EVENT_NEED_BYTES: {
        unsigned char piece[4096];
        const size_t count = fread(piece, 1, sizeof piece, stdin);
        if (count > 0)
          tvg_decoder_push(decoder, piece, count);
        else
          tvg_decoder_finish(decoder);
        break;
      }
      case TVG_EVENT_MESH:
        positions = use_mesh(decoder, positions, &size);
        if (positions == NULL) status = 1;
        break;
      case TVG_EVENT_FRAME:
        print_frame(decoder, positions, size);
        break;
      case TVG_EVENT_DAMAGE: { /* frames are missing; decoding goes on */
        tvg_damage_info damage = {.struct_size = sizeof damage};
        tvg_decoder_get_damage(decoder, &damage);
        fprintf(stderr, "damage at frame %llu: %s\n", (unsigned long long)damage.first_frame, damage.text);
        break;
      }
      case TVG_EVENT_ERROR:
        fprintf(stderr, "%s\n", tvg_decoder_error_text(decoder));
        status = 1;
        break;
      case TVG_EVENT_END:
        status = 0;
        break;
      default:
        break;
    }
  }
  free(positions);
  tvg_decoder_destroy(decoder);
  return status;
}
