/* Decoding and encoding .tvg streams from C (C99 or later), or from anything that can call C. Three headers
 * come with this one: tvg_encoder.h has encoding, tvg_properties.h attributes, parts, polygons, free-form
 * data and what graphics hardware wants, tvg_basis.h what lets a GPU make frames by itself.
 *
 * Bytes go in as they arrive, in pieces of any size; events come out; frames are written into the caller's
 * own memory. The library opens no file and no connection, starts no thread, and keeps no global state. It is
 * safe on any bytes: a broken stream yields events, never a crash.
 *
 *   tvg_decoder_create
 *          |
 *          v
 *   tvg_decoder_poll <---------------------------------------------------------------+
 *          |                                                                         |
 *          +-- TVG_EVENT_NEED_BYTES   tvg_decoder_push, or tvg_decoder_finish -------+
 *          +-- TVG_EVENT_HEAD         tvg_decoder_get_stream; seeking is possible ---+
 *          +-- TVG_EVENT_METADATA     tvg_decoder_metadata --------------------------+
 *          +-- TVG_EVENT_MESH         tvg_decoder_get_mesh: make room for frames ----+
 *          +-- TVG_EVENT_GOP          tvg_decoder_get_gop, tvg_decoder_copy_flags ---+
 *          +-- TVG_EVENT_FRAME        tvg_decoder_copy_positions, ..._compute_normals --+
 *          +-- TVG_EVENT_DAMAGE       tvg_decoder_get_damage; decoding goes on ------+
 *          +-- TVG_EVENT_DATA         tvg_decoder_get_data: something that goes along +
 *          +-- TVG_EVENT_END          done, or tvg_decoder_seek ---------------------+
 *          +-- TVG_EVENT_ERROR        tvg_decoder_error_text; no way on -------------+ (only by
 * tvg_decoder_seek)
 *          |
 *          v
 *   tvg_decoder_destroy
 *
 * A decoder may be used by one thread at a time; different decoders are independent of each other. A function
 * that is called when it means nothing returns TVG_ERROR_WRONG_STATE and changes nothing.
 *
 * From version 1.0 on, what this header declares stays: functions keep their meaning and their arguments,
 * codes and events keep their numbers, structures grow at their end only. That is what `struct_size` is for:
 * set it to the sizeof of the structure before the call ("tvg_frame_info frame = {.struct_size = sizeof
 * frame};"); no more than that is written. New events may be added: pass over those you do not know. */
#ifndef TVG_TVG_H
#define TVG_TVG_H

#include <stddef.h>
#include <stdint.h>

/* Where the library is linked in statically, who uses it defines TVG_STATIC; CMake and pkg-config do so. */
#if defined(TVG_STATIC)
#define TVG_API
#elif defined(_WIN32) && defined(TVG_BUILDS_LIBRARY)
#define TVG_API __declspec(dllexport)
#elif defined(_WIN32)
#define TVG_API __declspec(dllimport)
#elif defined(__EMSCRIPTEN__)
#define TVG_API __attribute__((used, visibility("default")))
#elif defined(__GNUC__)
#define TVG_API __attribute__((visibility("default")))
#else
#define TVG_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* The version of this header; tvg_version() is that of the library in use. */
#define TVG_VERSION_MAJOR 0
#define TVG_VERSION_MINOR 2
#define TVG_VERSION_PATCH 0
#define TVG_VERSION ((TVG_VERSION_MAJOR << 16) | (TVG_VERSION_MINOR << 8) | TVG_VERSION_PATCH)

/* A number that is not known. */
#define TVG_UNKNOWN UINT64_MAX
/* The last bytes of a stream, by which its index is found. */
#define TVG_TAIL_BYTES 28

/* What a function returns. Numbers are never reused. */
typedef enum tvg_code {
  TVG_OK = 0,
  TVG_ERROR_INVALID_ARGUMENT = 10, /* a null pointer, a buffer that is too small, a frame that is not there */
  TVG_ERROR_INVALID_INPUT = 11,    /* geometry that cannot be encoded: not finite, an index out of range */
  TVG_ERROR_WRONG_STATE = 12,      /* what is asked for is not there yet, or not any more */
  TVG_ERROR_NOT_TVG = 20,          /* the signature is missing */
  TVG_ERROR_UNSUPPORTED_VERSION = 21, /* a version, a bound or a critical chunk this library does not know */
  TVG_ERROR_TRUNCATED = 22,           /* the bytes end before the stream does */
  TVG_ERROR_CHECKSUM_MISMATCH = 23,
  TVG_ERROR_MALFORMED = 24,
  TVG_ERROR_DIGEST_MISMATCH = 25, /* frames were given out and are not what was encoded */
  TVG_ERROR_UNSUPPORTED = 26,     /* frames need what this library does not know; they may be valid */
  TVG_ERROR_LIMIT_EXCEEDED = 30,  /* the stream declares more than tvg_limits allows */
  TVG_ERROR_OUT_OF_MEMORY = 31,
  TVG_ERROR_IO = 40 /* a sink or a source of the caller's gave up */
} tvg_code;

typedef enum tvg_event {
  TVG_EVENT_NEED_BYTES = 0,
  TVG_EVENT_HEAD = 1,
  TVG_EVENT_METADATA = 2,
  TVG_EVENT_MESH = 3,
  TVG_EVENT_GOP = 4,
  TVG_EVENT_FRAME = 5,
  TVG_EVENT_DAMAGE = 6,
  TVG_EVENT_END = 7,
  TVG_EVENT_ERROR = 8,
  TVG_EVENT_DATA = 9 /* free-form data: tvg_properties.h */
} tvg_event;

typedef struct tvg_decoder tvg_decoder;
typedef struct tvg_encoder tvg_encoder; /* tvg_encoder.h */

/* What a stream may ask for. A stream that declares more is refused before anything is allocated by it. */
typedef struct tvg_limits {
  size_t struct_size;
  uint32_t vertices;       /* of a mesh; 2^24 unless set */
  uint32_t faces;          /* of a mesh; 2^25 unless set */
  uint32_t frames_per_gop; /* 2^16 unless set */
  uint32_t packet_bytes;   /* of one frame's packet; 2^29 unless set */
  uint64_t memory_bytes;   /* of the decoder; 4 GiB unless set */
  uint32_t meshes;         /* kept at once; 2^16 unless set */
  uint32_t mesh_bytes;     /* of one mesh's chunk; 2^30 unless set */
  uint32_t plan_bytes;     /* of one chunk of planes that GOPs share; 2^30 unless set */
  uint32_t components;     /* of such a chunk; 2^14 unless set */
  uint32_t plans;          /* such chunks kept at once; 256 unless set */
  uint32_t property_bytes; /* that attributes, parts and polygons of a mesh take; 2^31 unless set */
} tvg_limits;

/* What the head of a stream says, and its index where that is known. */
typedef struct tvg_stream_info {
  size_t struct_size;
  uint16_t format_major;
  uint16_t format_minor;
  uint32_t vertices; /* no mesh has more */
  uint32_t faces;    /* no mesh has more */
  uint32_t frames_per_gop;
  uint64_t memory_bytes; /* the decoder needs no more */
  uint64_t frame_count;  /* of the whole stream; TVG_UNKNOWN without an index */
  uint32_t meshes;       /* the decoder keeps no more at once */
} tvg_stream_info;

/* The connectivity of the frames that follow. */
typedef struct tvg_mesh_info {
  size_t struct_size;
  uint32_t vertex_count;
  uint32_t face_count;
  const uint32_t* faces; /* [face][corner], counter-clockwise; the decoder's own, until the next
                            TVG_EVENT_MESH or tvg_decoder_destroy */
  uint32_t lod_count;    /* coarser meshes that the stream has of it */
  uint32_t lod;          /* which of them this is, counted from 1; 0: the whole mesh */
} tvg_mesh_info;

/* How the frames of a GOP are coded. */
typedef enum tvg_mode {
  TVG_MODE_ELP = 0,     /* positions on a lattice, predicted in space and time */
  TVG_MODE_BASIS = 1,   /* sums of a few planes that a period of frames shares: smallest */
  TVG_MODE_LOSSLESS = 2 /* float32 positions, of which every bit comes back */
} tvg_mode;

/* A group of frames that is decodable on its own, given its mesh. */
typedef struct tvg_gop_info {
  size_t struct_size;
  uint64_t first_frame;  /* position in the stream */
  uint64_t source_frame; /* number of its first frame in the sequence that was encoded */
  uint32_t frame_count;
  uint32_t important_vertices; /* those on the fine lattice */
  double fine_step;   /* edge of a cell of the fine lattice, in the mesh's units: a coordinate of an */
  double coarse_step; /* important vertex is off by half of it at most; of another, by half of this */
  uint32_t mode; /* a tvg_mode; without loss both steps are 0; of a basis they are those of its sums, and do
                    not bound its errors */
  uint32_t components; /* of the basis that the GOP shares with others; 0 in other modes */
} tvg_gop_info;

typedef struct tvg_frame_info {
  size_t struct_size;
  uint64_t number;       /* position in the stream, counted from 0; lost frames count */
  uint64_t packet_bytes; /* what the frame takes in the stream */
  uint32_t predictor;    /* a tvg_predictor: what it was predicted from */
} tvg_frame_info;

/* Frames that are missing or, with TVG_ERROR_DIGEST_MISMATCH and TVG_ERROR_MALFORMED, not to be trusted. */
typedef struct tvg_damage_info {
  size_t struct_size;
  uint64_t first_frame;
  uint64_t frame_count; /* 0 where no frame is lost, or nobody can know how many */
  tvg_code code;
  uint64_t byte_offset; /* in the stream, or TVG_UNKNOWN */
  const char* text;     /* one line; the decoder's own, until the next tvg_decoder_poll */
} tvg_damage_info;

/* The version of the library, as TVG_VERSION has it. */
TVG_API uint32_t tvg_version(void);
/* A code's name ("checksum-mismatch"); "unknown" for a number that is none. Takes any number. */
TVG_API const char* tvg_code_name(int code);

/* Sets all limits to what they are without being set. `limits->struct_size` must be set. */
TVG_API tvg_code tvg_limits_init(tvg_limits* limits);

/* A new decoder, the caller's to destroy; null without memory or `struct_size`. `limits` may be null. */
TVG_API tvg_decoder* tvg_decoder_create(const tvg_limits* limits);
/* Null is allowed. */
TVG_API void tvg_decoder_destroy(tvg_decoder* decoder);

/* Takes the next bytes of the stream; they are copied. */
TVG_API tvg_code tvg_decoder_push(tvg_decoder* decoder, const void* bytes, size_t size);
/* Says that no bytes follow. */
TVG_API tvg_code tvg_decoder_finish(tvg_decoder* decoder);
/* The next event. After TVG_EVENT_END and TVG_EVENT_ERROR it stays the same. */
TVG_API tvg_event tvg_decoder_poll(tvg_decoder* decoder);

/* From TVG_EVENT_HEAD on. */
TVG_API tvg_code tvg_decoder_get_stream(const tvg_decoder* decoder, tvg_stream_info* stream);
/* The value of a key ("fps", "name", "units", "up", ...) in UTF-8, or null. The decoder's own, until the next
   TVG_EVENT_METADATA. */
TVG_API const char* tvg_decoder_metadata(const tvg_decoder* decoder, const char* key);
/* The keys, in order; null behind the last. */
TVG_API const char* tvg_decoder_metadata_key(const tvg_decoder* decoder, size_t index);
/* From TVG_EVENT_MESH on. */
TVG_API tvg_code tvg_decoder_get_mesh(const tvg_decoder* decoder, tvg_mesh_info* mesh);
/* From TVG_EVENT_GOP until the next GOP, mesh, damage or seek, and with every frame. */
TVG_API tvg_code tvg_decoder_get_gop(const tvg_decoder* decoder, tvg_gop_info* gop);
/* Importance of each vertex, 0 or 1, into `size` >= vertex_count bytes. As tvg_decoder_get_gop. */
TVG_API tvg_code tvg_decoder_copy_flags(const tvg_decoder* decoder, uint8_t* flags, size_t size);

/* The frame: from TVG_EVENT_FRAME until the next tvg_decoder_poll or tvg_decoder_seek. */
TVG_API tvg_code tvg_decoder_get_frame(const tvg_decoder* decoder, tvg_frame_info* frame);
/* Writes x, y, z of vertex v as float32 at `positions` + v * `stride` bytes. `stride` is at least 12, `size`
   at least (vertex_count - 1) * stride + 12. Does not allocate. */
TVG_API tvg_code tvg_decoder_copy_positions(const tvg_decoder* decoder, void* positions, size_t size,
                                            size_t stride);
/* The same for unit normals, weighted by area; 0, 0, 0 for a vertex without a face. The first call after a
   mesh allocates. */
TVG_API tvg_code tvg_decoder_compute_normals(tvg_decoder* decoder, void* normals, size_t size, size_t stride);

/* From TVG_EVENT_DAMAGE until the next tvg_decoder_poll. */
TVG_API tvg_code tvg_decoder_get_damage(const tvg_decoder* decoder, tvg_damage_info* damage);

/* Where the index of a stream of `stream_bytes` lies, from its last TVG_TAIL_BYTES bytes. An error where they
   are no tail: the stream is cut, or still being written. */
TVG_API tvg_code tvg_locate_index(const void* tail, size_t tail_size, uint64_t stream_bytes,
                                  uint64_t* index_offset, uint64_t* index_bytes);
/* Takes the bytes that tvg_locate_index points at, so that seeking can go anywhere at once. */
TVG_API tvg_code tvg_decoder_load_index(tvg_decoder* decoder, const void* bytes, size_t size);
/* Goes to a frame, from TVG_EVENT_HEAD on: the next TVG_EVENT_FRAME is this one, or the first good one after
   it. The bytes pushed from now on must begin at `*offset` of the stream. Without an index a frame ahead is
   reached by reading on, which decodes only the GOP that holds it. */
TVG_API tvg_code tvg_decoder_seek(tvg_decoder* decoder, uint64_t frame, uint64_t* offset);
/* How many of the bytes that come next are of no use, on the way to a frame or for what tvg_decoder_use_lod
   asks for. They count as pushed: the next push begins behind them. Who reads from a pipe need not ask. */
TVG_API uint64_t tvg_decoder_skip(tvg_decoder* decoder);

/* Decodes only the first `most` components, rounded up to a multiple of four, of each basis (TVG_MODE_BASIS)
   that is read from now on; those that add most come first. All are decoded unless this says otherwise. */
TVG_API tvg_code tvg_decoder_use_components(tvg_decoder* decoder, uint32_t most);

/* Draws meshes read from now on as a coarser one that they have, of which all vertices are then: 1 the first,
   and so on, at most the last; 0, as at first, the whole. Fewer bytes are needed for it in TVG_MODE_BASIS. */
TVG_API tvg_code tvg_decoder_use_lod(tvg_decoder* decoder, uint32_t lod);

/* What went wrong last: in TVG_EVENT_ERROR, or in a function that did not return TVG_OK and took a decoder
   that was not const. One line; the decoder's own, until the next such event or call. "" where nothing has.
 */
TVG_API const char* tvg_decoder_error_text(const tvg_decoder* decoder);
/* Its code; TVG_OK where nothing has. */
TVG_API tvg_code tvg_decoder_error_code(const tvg_decoder* decoder);

#ifdef __cplusplus
}
#endif

#ifndef TVG_DECODE_ONLY
#include <tvg/tvg_encoder.h>
#include <tvg/tvg_measure.h>
#endif
#include <tvg/tvg_basis.h>
#include <tvg/tvg_properties.h>

#endif /* TVG_TVG_H */
