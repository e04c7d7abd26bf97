/* A detector that contactcheck loads from a shared library:
 *
 *     contactcheck run bunny-touch --detector ./libsweep.so:axis=z
 *
 * Boxes of triangles are swept along an axis; pairs whose boxes overlap are tested by separating
 * axes, in double precision. Rounding can hide a contact or make one up where surfaces only just
 * touch: it claims triangles and bodies, and does not claim to be exact. It tells of its work: the
 * stage of the boxes, how many pairs it looked at, and times by its own clock. */
#define _POSIX_C_SOURCE 199309L
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "contactcheck_plugin.h"

typedef struct {
  double low[3], high[3];
  uint32_t body, triangle;
} Box;

typedef struct {
  int axis;
  uint32_t body_count;
  const contactcheck_body* bodies; /* the host's, as long as this detector lives */
  const double** vertices;         /* per body, of the last frame */
  Box* boxes;
  Box** order; /* the same boxes, by where they begin on the axis */
  size_t box_count;
  uint64_t swept, tested; /* pairs since the last update: met on the axis, and of them in boxes */
  double milliseconds;    /* of the last update or query */
} Sweep;

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static int32_t fail(char* message, const char* text) {
  snprintf(message, CONTACTCHECK_MESSAGE_SIZE, "%s", text);
  return CONTACTCHECK_ERROR;
}

/* ---- boxes ------------------------------------------------------------------------------- */

static const double* corner(const Sweep* sweep, const Box* box, int i) {
  const contactcheck_body* body = &sweep->bodies[box->body];
  return sweep->vertices[box->body] + 3 * (size_t)body->triangles[3 * (size_t)box->triangle + i];
}

static void refit(const Sweep* sweep, Box* box) {
  for (int k = 0; k < 3; ++k) {
    const double a = corner(sweep, box, 0)[k], b = corner(sweep, box, 1)[k],
                 c = corner(sweep, box, 2)[k];
    box->low[k] = fmin(a, fmin(b, c));
    box->high[k] = fmax(a, fmax(b, c));
  }
}

/* Insertion: frames follow one another, and the order hardly changes. */
static void sort_boxes(const Sweep* sweep) {
  const int axis = sweep->axis;
  for (size_t i = 1; i < sweep->box_count; ++i) {
    Box* const box = sweep->order[i];
    size_t place = i;
    for (; place > 0 && sweep->order[place - 1]->low[axis] > box->low[axis]; --place)
      sweep->order[place] = sweep->order[place - 1];
    sweep->order[place] = box;
  }
}

static int boxes_overlap(const Box* a, const Box* b) {
  for (int k = 0; k < 3; ++k)
    if (a->low[k] > b->high[k] || b->low[k] > a->high[k]) return 0;
  return 1;
}

/* ---- triangles --------------------------------------------------------------------------- */

static void subtract(const double* p, const double* q, double* out) {
  for (int k = 0; k < 3; ++k) out[k] = p[k] - q[k];
}

static void cross(const double* p, const double* q, double* out) {
  out[0] = p[1] * q[2] - p[2] * q[1];
  out[1] = p[2] * q[0] - p[0] * q[2];
  out[2] = p[0] * q[1] - p[1] * q[0];
}

static double dot(const double* p, const double* q) {
  return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}

/* True when the projections on the axis are apart. Closed: equal ends touch. */
static int separates(const double* axis, const double* const* p, const double* const* q) {
  double p_low = INFINITY, p_high = -INFINITY, q_low = INFINITY, q_high = -INFINITY;
  for (int i = 0; i < 3; ++i) {
    const double on_p = dot(axis, p[i]), on_q = dot(axis, q[i]);
    p_low = fmin(p_low, on_p);
    p_high = fmax(p_high, on_p);
    q_low = fmin(q_low, on_q);
    q_high = fmax(q_high, on_q);
  }
  return p_high < q_low || q_high < p_low;
}

static void edges_and_normal(const double* const* p, double edges[3][3], double* normal) {
  for (int i = 0; i < 3; ++i) subtract(p[(i + 1) % 3], p[i], edges[i]);
  cross(edges[0], edges[1], normal);
}

/* Both normals, all pairs of edges and, for triangles of one plane, the edges' own normals. */
static int triangles_meet(const double* const* p, const double* const* q) {
  double p_edges[3][3], q_edges[3][3], p_normal[3], q_normal[3], axis[3];
  edges_and_normal(p, p_edges, p_normal);
  edges_and_normal(q, q_edges, q_normal);
  if (separates(p_normal, p, q) || separates(q_normal, p, q)) return 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      cross(p_edges[i], q_edges[j], axis);
      if (separates(axis, p, q)) return 0;
    }
    cross(p_normal, p_edges[i], axis);
    if (separates(axis, p, q)) return 0;
    cross(q_normal, q_edges[i], axis);
    if (separates(axis, p, q)) return 0;
  }
  return 1;
}

static int meet(const Sweep* sweep, const Box* a, const Box* b) {
  const double* p[3];
  const double* q[3];
  for (int i = 0; i < 3; ++i) {
    p[i] = corner(sweep, a, i);
    q[i] = corner(sweep, b, i);
  }
  return triangles_meet(p, q);
}

/* ---- the functions of the table ---------------------------------------------------------- */

static int32_t create(const contactcheck_setting* settings, uint32_t count, void** detector,
                      char* message) {
  Sweep* const sweep = calloc(1, sizeof *sweep);
  if (sweep == NULL) return fail(message, "out of memory");
  for (uint32_t i = 0; i < count; ++i)
    if (strcmp(settings[i].name, "axis") == 0) sweep->axis = settings[i].value[0] - 'x';
  *detector = sweep;
  return CONTACTCHECK_OK;
}

static void release(Sweep* sweep) {
  free(sweep->vertices);
  free(sweep->boxes);
  free(sweep->order);
}

static void destroy(void* detector) {
  release(detector);
  free(detector);
}

static int32_t declare(void* detector, contactcheck_semantics* semantics, char* message) {
  (void)detector;
  (void)message;
  semantics->levels = CONTACTCHECK_LEVEL_BODY | CONTACTCHECK_LEVEL_TRIANGLE;
  semantics->question_count = 2;
  semantics->questions[0] = CONTACTCHECK_ASK_TRIANGLES;
  semantics->questions[1] = CONTACTCHECK_ASK_BODY;
  return CONTACTCHECK_OK; /* as preset: surfaces, touching counts, double, no depth, not exact */
}

static int32_t prepare(void* detector, const contactcheck_body* bodies, uint32_t count,
                       char* message) {
  Sweep* const sweep = detector;
  release(sweep);
  sweep->bodies = bodies;
  sweep->body_count = count;
  sweep->box_count = 0;
  for (uint32_t b = 0; b < count; ++b) sweep->box_count += bodies[b].triangle_count;
  sweep->vertices = calloc(count + 1, sizeof *sweep->vertices);
  sweep->boxes = calloc(sweep->box_count + 1, sizeof *sweep->boxes);
  sweep->order = calloc(sweep->box_count + 1, sizeof *sweep->order);
  if (!sweep->vertices || !sweep->boxes || !sweep->order) return fail(message, "out of memory");
  size_t next = 0;
  for (uint32_t b = 0; b < count; ++b)
    for (uint32_t t = 0; t < bodies[b].triangle_count; ++t, ++next) {
      sweep->boxes[next].body = b;
      sweep->boxes[next].triangle = t;
      sweep->order[next] = &sweep->boxes[next];
    }
  return CONTACTCHECK_OK;
}

static int32_t update(void* detector, const contactcheck_frame* frame, char* message) {
  Sweep* const sweep = detector;
  const double start = now();
  if (frame->body_count != sweep->body_count) return fail(message, "not the bodies of prepare");
  for (uint32_t b = 0; b < frame->body_count; ++b) sweep->vertices[b] = frame->bodies[b].vertices;
  for (size_t i = 0; i < sweep->box_count; ++i) refit(sweep, &sweep->boxes[i]);
  sort_boxes(sweep);
  sweep->swept = sweep->tested = 0;
  sweep->milliseconds = now() - start;
  return CONTACTCHECK_OK;
}

static void report(const Box* a, const Box* b, uint32_t question,
                   const contactcheck_answer* answer) {
  if (question == CONTACTCHECK_ASK_BODY) {
    const contactcheck_body_pair pair = {a->body, b->body};
    answer->bodies(answer->host, &pair, 1);
  } else {
    const contactcheck_element_pair pair = {a->body, b->body, a->triangle, b->triangle};
    answer->triangles(answer->host, &pair, 1);
  }
}

/* Calls visit() for every pair of boxes of two bodies that overlap; gives how many pairs it looked
 * at. */
static uint64_t sweep_boxes(const Sweep* sweep,
                            void (*visit)(void* context, const Box* a, const Box* b),
                            void* context) {
  uint64_t looked_at = 0;
  for (size_t i = 0; i < sweep->box_count; ++i) {
    const Box* const a = sweep->order[i];
    for (size_t j = i + 1; j < sweep->box_count; ++j, ++looked_at) {
      const Box* const b = sweep->order[j];
      if (b->low[sweep->axis] > a->high[sweep->axis]) break;
      if (a->body != b->body && boxes_overlap(a, b)) visit(context, a, b);
    }
  }
  return looked_at;
}

typedef struct {
  Sweep* sweep;
  uint32_t question;
  const contactcheck_answer* answer;
} Asked;

static void test_pair(void* context, const Box* a, const Box* b) {
  const Asked* const asked = context;
  ++asked->sweep->tested;
  if (meet(asked->sweep, a, b)) report(a, b, asked->question, asked->answer);
}

/* Pairs of bodies may be told again and again: the host makes a set of them. */
static int32_t query(void* detector, uint32_t question, const contactcheck_answer* answer,
                     char* message) {
  Sweep* const sweep = detector;
  const Asked asked = {sweep, question, answer};
  const double start = now();
  (void)message;
  sweep->swept += sweep_boxes(sweep, test_pair, (void*)&asked);
  sweep->milliseconds = now() - start;
  return CONTACTCHECK_OK;
}

/* ---- what it tells of its work ----------------------------------------------------------- */

typedef struct {
  contactcheck_element_pair* pairs;
  uint64_t count, room;
  int failed;
} PairList;

static void add_pair(void* context, const Box* a, const Box* b) {
  PairList* const list = context;
  const contactcheck_element_pair pair = {a->body, b->body, a->triangle, b->triangle};
  if (list->count == list->room) {
    const uint64_t room = list->room * 2 + 64;
    void* const larger = realloc(list->pairs, room * sizeof pair);
    if (larger == NULL) {
      list->failed = 1;
      return;
    }
    list->pairs = larger;
    list->room = room;
  }
  list->pairs[list->count++] = pair;
}

static int32_t trace(void* detector, const contactcheck_trace* trace, char* message) {
  PairList list = {NULL, 0, 0, 0};
  const uint64_t swept = sweep_boxes(detector, add_pair, &list);
  const contactcheck_stage stage = {.name = "boxes",
                                    .unit = "triangle pairs",
                                    .in = swept,
                                    .out = list.count,
                                    .covers = CONTACTCHECK_COVERS_TRIANGLES,
                                    .count = list.count,
                                    .pairs = list.pairs};
  if (!list.failed) trace->stage(trace->host, &stage);
  free(list.pairs); /* it was copied */
  return list.failed ? fail(message, "out of memory") : CONTACTCHECK_OK;
}

static int32_t counts(void* detector, const contactcheck_counts* counts, char* message) {
  const Sweep* const sweep = detector;
  (void)message;
  counts->add(counts->host, "pairs_swept", sweep->swept);
  counts->add(counts->host, "triangle_pairs_tested", sweep->tested);
  return CONTACTCHECK_OK;
}

static double own_ms(void* detector) { return ((const Sweep*)detector)->milliseconds; }

static const char* const kAxes[] = {"x", "y", "z", NULL};
static const contactcheck_option kOptions[] = {
    {"axis", "x", "boxes are swept along it", kAxes, 0.0, 0.0, 0, 0}};

static const contactcheck_plugin kPlugin = {
    .abi_version = CONTACTCHECK_PLUGIN_ABI,
    .struct_sizes = CONTACTCHECK_STRUCT_SIZES,
    .id = "c-sweep",
    .summary = "example: boxes swept along an axis, separating axes of triangles, in C",
    .version = "1.0",
    .options = kOptions,
    .option_count = 1,
    .create = create,
    .destroy = destroy,
    .declare = declare,
    .prepare = prepare,
    .update = update,
    .query = query,
    .told_sizes = CONTACTCHECK_TOLD_SIZES,
    .trace = trace,
    .counts = counts,
    .own_ms = own_ms,
};

const contactcheck_plugin* contactcheck_plugin_entry(void) { return &kPlugin; }
