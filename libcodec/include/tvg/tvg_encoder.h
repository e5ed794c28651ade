/* Encoding .tvg streams, comparing and joining them; tvg.h includes this header where the library has it, and
 * tvg_measure.h with it: what makes vertices important, and all figures of a comparison. */
#ifndef TVG_TVG_ENCODER_H
#define TVG_TVG_ENCODER_H

#include <tvg/tvg.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Encoding: decoding the other way round.
 *
 *   tvg_encoder_options_init, tvg_encoder_create
 *          |
 *   tvg_encoder_set_mesh      once; again for a new mesh after its frames
 *   tvg_encoder_add_frame     for every frame
 *   tvg_encoder_finish        the stream is whole
 *          |
 *   tvg_encoder_destroy
 *
 * What a call is given is copied. Bytes go to the sink, in order, from within these calls and from the thread
 * that makes them. An encoder of one thread (the usual) starts no other. A call that returns
 * TVG_ERROR_WRONG_STATE, _INVALID_ARGUMENT or _INVALID_INPUT, or _LIMIT_EXCEEDED for a mesh, changes nothing;
 * after any other error the stream is lost and every further call returns that error. */

/* Takes the next bytes of a stream: they are valid during the call. Anything but 0 gives up (TVG_ERROR_IO).
   It must not call the object that calls it. */
typedef int (*tvg_sink)(void* user, const void* bytes, size_t size);

typedef enum tvg_predictor {
  TVG_PREDICTOR_SPACE = 0,
  TVG_PREDICTOR_TIME = 1,
  TVG_PREDICTOR_ELP = 2,
  TVG_PREDICTOR_PYRAMID = 3, /* along the surface, coarse to fine: smaller files, slower */
  TVG_PREDICTOR_ROWS = 4,    /* of a frame in TVG_MODE_BASIS; none to encode with */
  TVG_PREDICTOR_AUTO = 255   /* for an encoder: elp or pyramid, whichever is smaller in a frame */
} tvg_predictor;

/* How to encode. New members stand at its end and mean what was before when they are 0. */
typedef struct tvg_encoder_options {
  size_t struct_size;
  uint32_t fine_bits;     /* of important vertices, 1 to 24; 11 unless set */
  uint32_t coarse_bits;   /* of the others, 1 to fine_bits; 11 unless set: all vertices alike */
  double step;            /* instead of bits, the edge of a fine cell in the mesh's units; 0 unless set: bits.
                             fine_bits - coarse_bits is how much coarser the others' cells are. All GOPs'
                             cells lie on one grid, which begins at 0 */
  double important_share; /* of the vertices, by curvature, 0 to 1; 0.35 unless set */
  uint32_t predictor;     /* a tvg_predictor; TVG_PREDICTOR_ELP unless set */
  uint32_t gop_frames;    /* frames that can be decoded on their own, 1 to 65536; 50 unless set */
  uint32_t threads;       /* GOPs encoded at a time; 1 unless set. The bytes are the same */
  uint32_t reorder;       /* not 0: vertices may change their order, which saves bytes; 0 unless set */
  uint32_t low_delay;     /* not 0: a GOP's important vertices are those of the GOP before; 0 unless set */
  uint32_t max_vertices;  /* of the meshes to come; 0 unless set: as many as the first has */
  uint32_t max_faces;     /* the same */
  uint64_t first_frame;   /* number of the first frame in a longer sequence; 0 unless set */
  uint32_t has_box;  /* not 0: every frame lies in this box, and all GOPs share a lattice; 0 unless set: */
  double box_low[3]; /* each GOP has a box of its own */
  double box_high[3];
  uint32_t max_meshes; /* how many meshes a decoder keeps, at most 65536: one of the last so many that comes
                          again is not sent again; 1 unless set */
  uint32_t mode; /* a tvg_mode; TVG_MODE_ELP unless set. Without loss bits count for nothing, but must be
                    those of one resolution; there is no step, and the predictor is elp (unless set) or
                    pyramid. A basis takes at most 16 bits */
  uint32_t period_frames; /* of TVG_MODE_BASIS: frames that share a basis and are held in memory, at most
                             65536; 0 unless set: what the effort says */
  uint32_t effort;        /* 1 (fast) to 9 (small): what TVG_MODE_BASIS tries, and neighbours that the pyramid
                             predicts from; 5 unless set, or 0 */
  double max_error; /* instead of bits and step: what no coordinate may be off by more, in the mesh's units,
                       but for the rounding of decoded positions to float32; 0 unless set: none */
  /* Of attributes that do not say how many bits they have; TVG_EXACT_BITS: exact. 0 is what is usual. */
  uint32_t texcoord_bits;      /* of each component; 12 unless set */
  uint32_t normal_bits;        /* of each of the two coordinates of a normal; 10 unless set */
  uint32_t colour_bits;        /* of each component; 8 unless set */
  uint32_t generic_bits;       /* of each component; TVG_EXACT_BITS unless set */
  uint32_t max_property_bytes; /* what attributes, parts and polygons of the meshes to come may take; 0 unless
                                  set: as much as those of the first mesh */
  uint32_t max_animated_frame_bytes; /* what the values of animated attributes of the meshes to come may take
                                        of a frame; 0 unless set: as much as those of the first mesh */
} tvg_encoder_options;

/* What was encoded, or joined. */
typedef struct tvg_encode_report {
  size_t struct_size;
  uint64_t frames;
  uint64_t gops;
  uint64_t bytes;       /* of the whole stream */
  double largest_error; /* of a coordinate, in the mesh's units, of what was encoded in TVG_MODE_BASIS; 0
                           where nothing was, and of what was joined */
} tvg_encode_report;

/* Sets all options to what they are without being set. `options->struct_size` must be set. */
TVG_API tvg_code tvg_encoder_options_init(tvg_encoder_options* options);

/* A new encoder, the caller's to destroy, into `*encoder`; null there where the call fails. `options` may be
   null. `user` is handed to the sink. Options out of range are an error of the first tvg_encoder_set_mesh. */
TVG_API tvg_code tvg_encoder_create(const tvg_encoder_options* options, tvg_sink sink, void* user,
                                    tvg_encoder** encoder);
/* Null is allowed. Does not finish: the stream lacks its end then. */
TVG_API void tvg_encoder_destroy(tvg_encoder* encoder);

/* Adds a pair of the metadata, both in UTF-8. Before the first mesh. */
TVG_API tvg_code tvg_encoder_set_metadata(tvg_encoder* encoder, const char* key, const char* value);
/* The mesh of the frames that follow: `faces` is [face][corner], every index below `vertex_count`; may be
   null where `face_count` is 0. */
TVG_API tvg_code tvg_encoder_set_mesh(tvg_encoder* encoder, uint32_t vertex_count, const uint32_t* faces,
                                      uint32_t face_count);
/* The next frame: x, y, z of vertex v as float32 at `positions` + v * `stride` bytes. `stride` is at least
   12, `size` at least (vertex_count - 1) * stride + 12. */
TVG_API tvg_code tvg_encoder_add_frame(tvg_encoder* encoder, const void* positions, size_t size,
                                       size_t stride);
/* Ends the stream. `report` may be null. */
TVG_API tvg_code tvg_encoder_finish(tvg_encoder* encoder, tvg_encode_report* report);

/* What the last call said that did not return TVG_OK; the encoder's own, until the next such call; or "". */
TVG_API const char* tvg_encoder_error_text(const tvg_encoder* encoder);

/* How far decoded frames lie from their originals. Distances are in the mesh's units. */
typedef struct tvg_comparison {
  size_t struct_size;
  uint64_t frames;
  double diagonal;     /* of the box around all frames of the original */
  double max_distance; /* of a vertex from its decoded self */
  double rms_distance; /* root mean square over all vertices of all frames */
  double
      kg_percent; /* the KG error; infinite where every frame of the original is one point and they differ */
  double sted;    /* a STED-type metric: how unevenly edge lengths are off */
} tvg_comparison;

typedef struct tvg_comparer tvg_comparer;

/* A comparison of two sequences of this mesh, the caller's to destroy, into `*comparer`; null there where the
   call fails. Arguments as tvg_encoder_set_mesh. */
TVG_API tvg_code tvg_comparer_create(uint32_t vertex_count, const uint32_t* faces, uint32_t face_count,
                                     tvg_comparer** comparer);
/* Null is allowed. */
TVG_API void tvg_comparer_destroy(tvg_comparer* comparer);
/* The next frame of both, [vertex][xyz], `count` = 3 * vertex_count floats each, unless the call fails. */
TVG_API tvg_code tvg_comparer_add_frame(tvg_comparer* comparer, const float* original, const float* decoded,
                                        size_t count);
/* The figures over the frames so far. */
TVG_API tvg_code tvg_comparer_get(const tvg_comparer* comparer, tvg_comparison* comparison);

/* A whole stream in memory; the caller's. */
typedef struct tvg_stream_bytes {
  const void* bytes;
  size_t size;
} tvg_stream_bytes;

/* Makes one stream of several, at GOP borders and without decoding. `report` may be null. Where it fails,
   what went to the sink is no stream, and one line of text that says why is written to `error_text`, of
   `error_size` bytes with its zero; it may be null. */
TVG_API tvg_code tvg_join(const tvg_stream_bytes* streams, size_t count, tvg_sink sink, void* user,
                          tvg_encode_report* report, char* error_text, size_t error_size);

#ifdef __cplusplus
}
#endif

#endif /* TVG_TVG_ENCODER_H */
