/* What a mesh has beside its connectivity (attributes, parts, polygons), free-form data that go with a
 * stream, and a mesh as graphics hardware draws it. tvg.h includes this header; what stands there of states,
 * sizes and ownership holds here too.
 *
 * Everything of a mesh can be asked for from TVG_EVENT_MESH on, and is another mesh's after the next one;
 * texts and arrays that are pointed at are the decoder's own until then. A coarser mesh (tvg_decoder_use_lod)
 * has no properties. */
#ifndef TVG_TVG_PROPERTIES_H
#define TVG_TVG_PROPERTIES_H

#include <tvg/tvg.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum tvg_attribute_kind {
  TVG_ATTRIBUTE_TEXCOORD = 0, /* one to four numbers; v points up */
  TVG_ATTRIBUTE_NORMAL = 1,   /* three numbers of length 1, or 0, 0, 0 */
  TVG_ATTRIBUTE_COLOUR = 2,   /* three or four numbers: red, green, blue, alpha */
  TVG_ATTRIBUTE_GENERIC = 3   /* one to four numbers that mean what the name says */
} tvg_attribute_kind;

/* What has a value each. */
typedef enum tvg_attribute_domain {
  TVG_DOMAIN_VERTEX = 0,
  TVG_DOMAIN_CORNER = 1, /* of a face; corners of several faces may share one */
  TVG_DOMAIN_PART = 2
} tvg_attribute_domain;

/* As a number of bits: float32, of which every bit comes back. */
#define TVG_EXACT_BITS 32
/* Of a render vertex that no face uses: it has no value of an attribute of corners or parts. */
#define TVG_NO_VALUE UINT32_MAX

/* How many of each the mesh has. */
typedef struct tvg_properties_info {
  size_t struct_size;
  uint32_t attribute_count;
  uint32_t part_count;    /* 0: all faces are one part without a name */
  uint32_t polygon_count; /* faces of more than three corners, which became several triangles */
} tvg_properties_info;

typedef struct tvg_attribute_info {
  size_t struct_size;
  const char* name;     /* UTF-8; may be "", and need not be unique */
  uint32_t kind;        /* a tvg_attribute_kind */
  uint32_t domain;      /* a tvg_attribute_domain */
  uint32_t components;  /* numbers of a value, 1 to 4 */
  uint32_t bits;        /* of each, or of a normal's two coordinates; TVG_EXACT_BITS: exact */
  uint32_t animated;    /* not 0: each frame has values of its own, which are there with it */
  uint32_t value_count; /* of one frame, where they are animated; there are as many in each */
} tvg_attribute_info;

/* Texts in UTF-8; "" for none. */
typedef struct tvg_part_info {
  size_t struct_size;
  const char* object;
  const char* group;
  const char* material;
} tvg_part_info;

/* Faces first_face to first_face + corner_count - 3 are a fan around the polygon's first corner. */
typedef struct tvg_polygon {
  uint32_t first_face;
  uint32_t corner_count;
} tvg_polygon;

TVG_API tvg_code tvg_decoder_get_properties(const tvg_decoder* decoder, tvg_properties_info* properties);
/* `attribute` is below attribute_count. */
TVG_API tvg_code tvg_decoder_get_attribute(const tvg_decoder* decoder, uint32_t attribute,
                                           tvg_attribute_info* info);
/* Writes the components of value i as float32 at `values` + i * `stride` bytes. `stride` is at least
   4 * components, `size` at least (value_count - 1) * stride + 4 * components. TVG_ERROR_WRONG_STATE for an
   animated attribute while there is no frame. Does not allocate. */
TVG_API tvg_code tvg_decoder_copy_attribute(const tvg_decoder* decoder, uint32_t attribute, void* values,
                                            size_t size, size_t stride);
/* Which value each corner has, [face][corner], into `count` >= 3 * face_count numbers, whatever the domain.
 */
TVG_API tvg_code tvg_decoder_copy_corners(const tvg_decoder* decoder, uint32_t attribute, uint32_t* corners,
                                          size_t count);
/* `part` is below part_count. */
TVG_API tvg_code tvg_decoder_get_part(const tvg_decoder* decoder, uint32_t part, tvg_part_info* info);
/* The part of each face into `count` >= face_count numbers: 0 where there are no parts. */
TVG_API tvg_code tvg_decoder_copy_face_parts(const tvg_decoder* decoder, uint32_t* parts, size_t count);
/* In the order of their faces, into `count` >= polygon_count structures. */
TVG_API tvg_code tvg_decoder_copy_polygons(const tvg_decoder* decoder, tvg_polygon* polygons, size_t count);

/* A mesh with one index for all that a vertex has. A vertex whose corners differ in an attribute becomes
   several render vertices: the first has the vertex's own number, others follow behind all vertices. Faces
   are sorted by their part. */
typedef struct tvg_view_info {
  size_t struct_size;
  uint32_t vertex_count;           /* render vertices */
  uint32_t index_count;            /* three to a face */
  uint32_t range_count;            /* one for each part; 1 where there are none */
  const uint32_t* indices;         /* render vertices, three to a face */
  const uint32_t* source_vertices; /* [render vertex]: which vertex it is */
  const uint32_t* source_faces;    /* [face of the indices]: which face it is */
} tvg_view_info;

/* Where the faces of a part are in the indices. */
typedef struct tvg_view_range {
  size_t struct_size;
  uint32_t first_index;
  uint32_t index_count;
} tvg_view_range;

/* The first call after a mesh makes the view, and allocates; what follows is for after it. */
TVG_API tvg_code tvg_decoder_get_view(tvg_decoder* decoder, tvg_view_info* view);
TVG_API tvg_code tvg_decoder_get_view_range(const tvg_decoder* decoder, uint32_t part, tvg_view_range* range);
/* Which value of an attribute each render vertex has, or TVG_NO_VALUE, into `count` >= vertex_count numbers.
 */
TVG_API tvg_code tvg_decoder_copy_view_values(const tvg_decoder* decoder, uint32_t attribute,
                                              uint32_t* values, size_t count);
/* As tvg_decoder_copy_positions, tvg_decoder_compute_normals and tvg_decoder_copy_attribute, for every render
   vertex: `size` is at least (vertex_count - 1) * stride and a value. A render vertex without a value gets
   zeros. The first copy of positions or normals after a mesh allocates. */
TVG_API tvg_code tvg_decoder_copy_view_positions(tvg_decoder* decoder, void* positions, size_t size,
                                                 size_t stride);
TVG_API tvg_code tvg_decoder_compute_view_normals(tvg_decoder* decoder, void* normals, size_t size,
                                                  size_t stride);
TVG_API tvg_code tvg_decoder_copy_view_attribute(const tvg_decoder* decoder, uint32_t attribute, void* values,
                                                 size_t size, size_t stride);

typedef enum tvg_data_encoding {
  TVG_DATA_STORED = 0,
  TVG_DATA_ZSTD = 1 /* one frame of zstd (RFC 8878) */
} tvg_data_encoding;

/* Free-form data: "materials", "image/NAME", "skeleton" and the like, of which the specification tells. */
typedef struct tvg_data_info {
  size_t struct_size;
  const char* name;
  uint64_t size;        /* of the data */
  uint32_t encoding;    /* a tvg_data_encoding, or one that this library does not know */
  const void* packed;   /* as they are encoded; as long as tvg_decoder_get_data may be called */
  uint64_t packed_size; /* bytes */
} tvg_data_info;

/* From TVG_EVENT_DATA until the next tvg_decoder_poll, _push or _seek. Data of a name that came before take
   the place of those. */
TVG_API tvg_code tvg_decoder_get_data(const tvg_decoder* decoder, tvg_data_info* data);
/* The data, decoded, into `size` bytes, at least those of tvg_data_info. TVG_ERROR_UNSUPPORTED for an
   encoding that this library does not know, TVG_DATA_ZSTD where it only decodes: undo it with zstd then. */
TVG_API tvg_code tvg_decoder_copy_data(tvg_decoder* decoder, void* bytes, size_t size);

#ifndef TVG_DECODE_ONLY

/* An attribute to encode. What is 0 means what stands beside it. */
typedef struct tvg_attribute {
  size_t struct_size;
  const char* name;        /* UTF-8; null: "" */
  uint32_t kind;           /* a tvg_attribute_kind */
  uint32_t domain;         /* a tvg_attribute_domain */
  uint32_t components;     /* 1 to 4 */
  uint32_t bits;           /* 1 to 24, of normals 2 to 16, or TVG_EXACT_BITS; 0: what the options say */
  const void* values;      /* value i is at values + i * stride, float32 [component] */
  size_t stride;           /* bytes; 0: values stand without gaps */
  uint32_t value_count;    /* one for each vertex or part; of corners as many as there are */
  const uint32_t* corners; /* of TVG_DOMAIN_CORNER, [face][corner]: which value it has; else null */
  size_t corner_count;     /* 3 * face_count; else 0 */
  uint32_t animated;       /* not 0: each frame has values of its own (tvg_encoder_set_values); those here
                              are not looked at */
} tvg_attribute;

/* What these add, the mesh has that tvg_encoder_set_mesh takes next; where that fails, it is kept for the
   next call. What does not fit the mesh is an error (TVG_ERROR_INVALID_INPUT) of tvg_encoder_set_mesh. */
TVG_API tvg_code tvg_encoder_add_attribute(tvg_encoder* encoder, const tvg_attribute* attribute);
/* The values that an animated attribute of the mesh has from the frame on that tvg_encoder_add_frame takes
   next, until others are set: value i is at `values` + i * `stride` bytes, float32 [component]. There are
   `count` of them, one for each vertex or part; of corners as many as there are. The first frame of a mesh
   needs them all. */
TVG_API tvg_code tvg_encoder_set_values(tvg_encoder* encoder, uint32_t attribute, const void* values,
                                        uint32_t count, size_t stride);
/* Parts are numbered in the order they are added; texts may be null. */
TVG_API tvg_code tvg_encoder_add_part(tvg_encoder* encoder, const tvg_part_info* part);
/* The part of each face; needed where there are parts. */
TVG_API tvg_code tvg_encoder_set_face_parts(tvg_encoder* encoder, const uint32_t* parts, size_t face_count);
/* In the order of their faces. Each has four corners or more. */
TVG_API tvg_code tvg_encoder_set_polygons(tvg_encoder* encoder, const tvg_polygon* polygons, size_t count);
/* Forgets what was added. */
TVG_API tvg_code tvg_encoder_clear_properties(tvg_encoder* encoder);
/* Adds free-form data under a name that is not yet taken, before the first mesh; compressed where that is
   smaller. */
TVG_API tvg_code tvg_encoder_add_data(tvg_encoder* encoder, const char* name, const void* bytes, size_t size);

#endif /* TVG_DECODE_ONLY */

#ifdef __cplusplus
}
#endif

#endif /* TVG_TVG_PROPERTIES_H */
