/* A plug-in that answers queries of moving elements, in C11 with the standard library alone:
 *
 *     contactcheck queries vf.csv --detector ./libinclusion.so
 *     contactcheck queries vf.csv --detector ./libinclusion.so:tolerance=1e-9
 *
 * The difference of a point of one element and a point of the other is linear in the time, and in
 * each of the two parameters that say where on the elements the points lie. So over a box of the
 * three its coordinates stay between those at the box's corners. A box whose range does not hold
 * zero has no contact; the others are halved until the range is as small as the tolerance. What is
 * left is reported, so it misses nothing but what rounding hides, and reports near misses as
 * contact. (Snyder, "Interval analysis for computer graphics", 1992; Wang et al., "A Large-Scale
 * Benchmark and an Inclusion-Based Algorithm for Continuous Collision Detection", 2021.) */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "contactcheck_plugin.h"

enum { kMostBoxes = 100000 }; /* looked at in one query; then what is left is contact */

typedef struct {
  double tolerance; /* metres */
} Inclusion;

typedef struct {
  double low[3], high[3]; /* of the time and the two parameters, in [0, 1] */
} Box;

typedef struct {
  const contactcheck_impact_query* query;
  double tolerance;
  int looked_at;
  double widest; /* range of a box that was reported */
} Search;

/* A point of the first element less one of the second. A vertex has no parameter; a triangle has
 * two, of which those with a sum above 1 are beyond its third edge; edges have one each. */
static void difference(const contactcheck_impact_query* q, const double at[3], double out[3]) {
  const double t = at[0], u = at[1], v = at[2];
  for (int k = 0; k < 3; ++k) {
    double p[4];
    for (int i = 0; i < 4; ++i) p[i] = (1 - t) * q->start[3 * i + k] + t * q->end[3 * i + k];
    out[k] = q->kind == CONTACTCHECK_VERTEX_FACE
                 ? p[0] - (p[1] + u * (p[2] - p[1]) + v * (p[3] - p[1]))
                 : (p[0] + u * (p[1] - p[0])) - (p[2] + v * (p[3] - p[2]));
  }
}

/* The largest side of the range; below 0 if the range does not hold zero. */
static double range(const contactcheck_impact_query* q, const Box* box) {
  double low[3], high[3], widest = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double at[3], value[3];
    for (int k = 0; k < 3; ++k) at[k] = corner >> k & 1 ? box->high[k] : box->low[k];
    difference(q, at, value);
    for (int k = 0; k < 3; ++k) {
      if (corner == 0 || value[k] < low[k]) low[k] = value[k];
      if (corner == 0 || value[k] > high[k]) high[k] = value[k];
    }
  }
  for (int k = 0; k < 3; ++k) {
    if (low[k] > 0 || high[k] < 0) return -1;
    if (high[k] - low[k] > widest) widest = high[k] - low[k];
  }
  return widest;
}

/* Earlier boxes first: the first one that is small enough has the time of the first contact. */
static int first_contact(Search* search, const Box* box, double* time) {
  const double width = range(search->query, box);
  const int beyond_edge =
      search->query->kind == CONTACTCHECK_VERTEX_FACE && box->low[1] + box->low[2] > 1;
  if (width < 0 || beyond_edge) return 0;
  int longest = 0;
  for (int k = 1; k < 3; ++k)
    if (box->high[k] - box->low[k] > box->high[longest] - box->low[longest]) longest = k;
  const double middle = (box->low[longest] + box->high[longest]) / 2;
  const int indivisible = middle <= box->low[longest] || middle >= box->high[longest];
  if (width <= search->tolerance || indivisible || ++search->looked_at >= kMostBoxes) {
    if (width > search->widest) search->widest = width;
    *time = box->low[0];
    return 1;
  }
  Box first = *box, second = *box;
  first.high[longest] = second.low[longest] = middle;
  double other;
  if (!first_contact(search, &first, time)) return first_contact(search, &second, time);
  /* The second half of the time is later than the first; of a parameter it may be earlier. */
  if (longest != 0 && first_contact(search, &second, &other) && other < *time) *time = other;
  return 1;
}

/* Of a range that holds zero along each axis, no point is farther away than its width times this.
 */
static const double kRootOf3 = 1.7320508075688774;

static int32_t create(const contactcheck_setting* settings, uint32_t count, void** detector,
                      char* message) {
  Inclusion* const self = malloc(sizeof *self);
  if (self == NULL || count != 1) {
    snprintf(message, CONTACTCHECK_MESSAGE_SIZE, "no memory");
    free(self);
    return CONTACTCHECK_ERROR;
  }
  self->tolerance = strtod(settings[0].value, NULL);
  *detector = self;
  return CONTACTCHECK_OK;
}

static void destroy(void* detector) { free(detector); }

static int32_t declare_impacts(void* detector, contactcheck_impact_semantics* semantics,
                               char* message) {
  (void)message;
  semantics->kinds = CONTACTCHECK_VERTEX_FACE | CONTACTCHECK_EDGE_EDGE;
  semantics->tolerance = kRootOf3 * ((const Inclusion*)detector)->tolerance;
  return CONTACTCHECK_OK;
}

static int32_t impact(void* detector, const contactcheck_impact_query* query,
                      contactcheck_impact* out, char* message) {
  (void)message;
  const Box all = {{0, 0, 0}, {1, 1, 1}};
  Search search = {query, ((const Inclusion*)detector)->tolerance, 0, 0};
  out->contact = (uint32_t)first_contact(&search, &all, &out->time);
  out->tolerance = kRootOf3 * search.widest; /* more than was declared where the search was cut */
  out->has = CONTACTCHECK_HAS_TIME | CONTACTCHECK_HAS_TOLERANCE;
  return CONTACTCHECK_OK;
}

static const contactcheck_option options[] = {
    {"tolerance", "1e-6", "smallest range that is halved, metres", NULL, 1e-12, 1, 0, 0}};

static const contactcheck_plugin table = {.abi_version = CONTACTCHECK_PLUGIN_ABI,
                                          .struct_sizes = CONTACTCHECK_STRUCT_SIZES,
                                          .id = "c-inclusion",
                                          .summary = "example: boxes of time and place, halved",
                                          .version = "1.0",
                                          .options = options,
                                          .option_count = 1,
                                          .create = create,
                                          .destroy = destroy,
                                          .impact_sizes = CONTACTCHECK_IMPACT_SIZES,
                                          .declare_impacts = declare_impacts,
                                          .impact = impact};

const contactcheck_plugin* contactcheck_plugin_entry(void) { return &table; }
