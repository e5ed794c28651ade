/* How much each vertex matters to an animation, and how far two sequences are apart: the measure and the
 * metrics beyond what tvg_encoder.h has of them. tvg.h includes this header where the library encodes. */
#ifndef TVG_TVG_MEASURE_H
#define TVG_TVG_MEASURE_H

#include <tvg/tvg_encoder.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A criterion and its weight. The cost of a vertex is the weighted sum of its criteria. */
typedef struct tvg_criterion {
  const char* name; /* one of tvg_criterion_name() */
  double weight;    /* finite; a negative one favours vertices with low values */
} tvg_criterion;

/* What makes vertices important. New members stand at its end and mean what was before when they are 0. */
typedef struct tvg_importance {
  size_t struct_size;
  const tvg_criterion* criteria; /* `criterion_count` of them; "curv" of weight 1 where there are none */
  size_t criterion_count;
  double share;           /* of the vertices, those of the highest cost, 0 to 1; 0.35 unless set */
  uint32_t has_threshold; /* not 0: instead of a share, all whose cost is above `threshold` */
  double threshold;
  uint32_t smoothing;     /* times the cost is averaged over neighbours, at most 1000; 0 unless set */
  double curvature_alpha; /* of curv and curvature-norm: weight of the change against the mean, 0 to 1; 0.5
                             unless set */
  double viewpoint[3];    /* of distance: x, y, z in the mesh's units */
  const double* weights;  /* of weights: the values themselves, finite, one for each vertex */
  size_t weight_count;
  uint32_t low_delay; /* not 0: a GOP's important vertices are those of the GOP before; 0 unless set */
} tvg_importance;

/* The criteria there are, in order, and a line on each; null behind the last. */
TVG_API const char* tvg_criterion_name(size_t index);
TVG_API const char* tvg_criterion_description(size_t index);

/* Sets all to what it is without being set. `importance->struct_size` must be set. */
TVG_API tvg_code tvg_importance_init(tvg_importance* importance);

/* What makes vertices important in the stream, in place of important_share and low_delay of the options;
   copied. Before the first mesh; what is out of range or does not fit the mesh is an error of
   tvg_encoder_set_mesh, as is a criterion that needs a skeleton. */
TVG_API tvg_code tvg_encoder_set_importance(tvg_encoder* encoder, const tvg_importance* importance);

/* Measures `frame_count` >= 1 frames, [frame][vertex][xyz], of a mesh as tvg_encoder_set_mesh takes it:
   `costs` and `flags` (1 important, 0 not) have room for `vertex_count` each, or are null. `importance` may
   be null. Where it fails, one line of text that says why is written to `error_text`, of `error_size` bytes
   with its zero; it may be null. */
TVG_API tvg_code tvg_measure(uint32_t vertex_count, const uint32_t* faces, uint32_t face_count,
                             const float* positions, size_t frame_count, const tvg_importance* importance,
                             double* costs, uint8_t* flags, char* error_text, size_t error_size);

/* All figures of a comparison. Distances are in the mesh's units; without frames all are 0, but snr_db. */
typedef struct tvg_comparison_report {
  size_t struct_size;
  uint64_t frames;
  double extent;                /* the longest side of the box around all frames of the original */
  double diagonal;              /* that box's diagonal */
  double max_coordinate_error;  /* largest difference of a coordinate */
  double rms_coordinate_error;  /* root mean square over all coordinates of all frames */
  double mean_coordinate_error; /* mean size of the difference */
  double max_vertex_distance;   /* of a vertex from its decoded self */
  double rms_vertex_distance;   /* root mean square over all vertices of all frames */
  uint64_t worst_frame;         /* where max_vertex_distance is reached first */
  uint32_t worst_vertex;        /* the vertex there */
  double snr_db;             /* the paper's signal to noise ratio; infinite for sequences that are the same */
  double kg_percent;         /* the KG error; infinite where each frame of the original is one point */
  double mean_quadric_error; /* the paper's quadric error (Eq. 8), over all vertices of all frames */
  double max_quadric_error;  /* in squared units */
  double sted;               /* a STED-type metric: how unevenly edge lengths are off */
  double sted_spatial;
  double sted_temporal;
  uint64_t hausdorff_frames; /* at how many frames the following was measured */
  double hausdorff; /* between the surfaces, the larger of both directions, the largest of those frames */
} tvg_comparison_report;

/* Measures the Hausdorff distance too, at every frame whose number is a multiple of `stride`; 0: not at all.
   It costs about 20 ms per frame of 10,000 vertices. TVG_ERROR_WRONG_STATE once there was a frame. */
TVG_API tvg_code tvg_comparer_use_hausdorff(tvg_comparer* comparer, uint32_t stride);
/* The figures over the frames so far. */
TVG_API tvg_code tvg_comparer_get_report(const tvg_comparer* comparer, tvg_comparison_report* report);

#ifdef __cplusplus
}
#endif

#endif /* TVG_TVG_MEASURE_H */
