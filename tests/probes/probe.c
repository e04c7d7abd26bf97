/* A detector that takes a known time and finds nothing: what the timing of a run is held against.
 *
 *     contactcheck run far-apart --detector ./libprobe.so:update_us=400,query_us=200
 *
 * It spins or sleeps in update, spins in query, and on request reads a buffer along a chain of
 * dependent loads, or maps all vertices itself, one by one. */
#define _POSIX_C_SOURCE 199309L
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "contactcheck_plugin.h"

enum { LINE = 64 / sizeof(size_t) }; /* elements of a cache line */

typedef struct {
  double update_us, query_us, sleep_us;
  int feeds_on_vertices, maps;
  size_t* chain; /* one element per line names the next line's; a cycle through all */
  size_t lines, place;
  const contactcheck_body* bodies;
  double mapped; /* a sum, so that no compiler leaves the mapping out */
} Probe;

static double thread_us(void) {
  struct timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e6 * (double)t.tv_sec + 1e-3 * (double)t.tv_nsec;
}

/* Of this thread's own time: what others take of the CPU meanwhile is no part of a detector's. */
static void spin(double us) {
  const double start = thread_us();
  while (thread_us() - start < us) continue;
}

/* A random cycle: no prefetcher guesses the next line. */
static int make_chain(Probe* probe, size_t bytes) {
  const size_t lines = bytes / 64;
  size_t* const order = malloc((lines + 1) * sizeof *order);
  probe->chain = calloc(lines * LINE + 1, sizeof *probe->chain);
  if (order == NULL || probe->chain == NULL) {
    free(order);
    return 0;
  }
  for (size_t i = 0; i < lines; ++i) order[i] = i;
  unsigned long long state = 88172645463325252ULL;
  for (size_t i = lines; i > 1; --i) {
    state ^= state << 13, state ^= state >> 7, state ^= state << 17;
    const size_t j = (size_t)(state % i), held = order[i - 1];
    order[i - 1] = order[j];
    order[j] = held;
  }
  for (size_t i = 0; i < lines; ++i)
    probe->chain[order[i] * LINE] = order[(i + 1) % lines] * LINE;
  free(order);
  probe->lines = lines;
  return 1;
}

static int32_t create(const contactcheck_setting* settings, uint32_t count, void** detector,
                      char* message) {
  Probe* const probe = calloc(1, sizeof *probe);
  double chase_kib = 0.0;
  (void)message;
  if (probe == NULL) return CONTACTCHECK_ERROR;
  for (uint32_t i = 0; i < count; ++i) {
    const char *name = settings[i].name, *value = settings[i].value;
    if (strcmp(name, "update_us") == 0) probe->update_us = atof(value);
    if (strcmp(name, "query_us") == 0) probe->query_us = atof(value);
    if (strcmp(name, "sleep_us") == 0) probe->sleep_us = atof(value);
    if (strcmp(name, "chase_kib") == 0) chase_kib = atof(value);
    if (strcmp(name, "map") == 0) {
      probe->feeds_on_vertices = strcmp(value, "given") == 0;
      probe->maps = strcmp(value, "own") == 0;
    }
  }
  if (chase_kib > 0.0 && !make_chain(probe, (size_t)(1024.0 * chase_kib))) {
    free(probe);
    return CONTACTCHECK_ERROR;
  }
  *detector = probe;
  return CONTACTCHECK_OK;
}

static void destroy(void* detector) {
  free(((Probe*)detector)->chain);
  free(detector);
}

static int32_t declare(void* detector, contactcheck_semantics* semantics, char* message) {
  (void)message;
  semantics->levels = CONTACTCHECK_LEVEL_BODY; /* none ever touch: for scenes where that is so */
  semantics->question_count = 1;
  semantics->questions[0] = CONTACTCHECK_ASK_BODY;
  semantics->needs_vertices = (uint32_t)((const Probe*)detector)->feeds_on_vertices;
  return CONTACTCHECK_OK;
}

static int32_t prepare(void* detector, const contactcheck_body* bodies, uint32_t count,
                       char* message) {
  (void)count;
  (void)message;
  ((Probe*)detector)->bodies = bodies;
  return CONTACTCHECK_OK;
}

static double blend(double a, double b, double w) { return a * (1.0 - w) + b * w; }

static void map_all(Probe* probe, const contactcheck_frame* frame) {
  for (uint32_t b = 0; b < frame->body_count; ++b) {
    const contactcheck_body* const body = &probe->bodies[b];
    const contactcheck_lattice* const lattice = body->lattice;
    if (lattice == NULL) continue;
    for (uint32_t v = 0; v < body->vertex_count; ++v) {
      const double* const w = lattice->local + 3 * (size_t)v;
      const uint32_t* const corner = lattice->cell_nodes + 8 * (size_t)lattice->home_cell[v];
      for (int k = 0; k < 3; ++k) {
        double x[4];
        for (int i = 0; i < 4; ++i)
          x[i] = blend(frame->bodies[b].nodes[3 * (size_t)corner[2 * i] + k],
                       frame->bodies[b].nodes[3 * (size_t)corner[2 * i + 1] + k], w[0]);
        probe->mapped += blend(blend(x[0], x[1], w[1]), blend(x[2], x[3], w[1]), w[2]);
      }
    }
  }
}

static int32_t update(void* detector, const contactcheck_frame* frame, char* message) {
  Probe* const probe = detector;
  (void)message;
  for (size_t i = 0; i < probe->lines; ++i) probe->place = probe->chain[probe->place];
  if (probe->maps) map_all(probe, frame);
  if (probe->sleep_us > 0.0) {
    const struct timespec t = {0, (long)(1e3 * probe->sleep_us)};
    nanosleep(&t, NULL);
  }
  if (probe->update_us > 0.0) spin(probe->update_us);
  return CONTACTCHECK_OK;
}

static int32_t query(void* detector, uint32_t question, const contactcheck_answer* answer,
                     char* message) {
  const Probe* const probe = detector;
  (void)question;
  (void)answer;
  (void)message;
  if (probe->query_us > 0.0) spin(probe->query_us);
  return CONTACTCHECK_OK;
}

static const char* const kMap[] = {"none", "given", "own", NULL};
static const contactcheck_option kOptions[] = {
    {"update_us", "0", "microseconds to spin in update", NULL, 0.0, 1e6, 0, 0},
    {"query_us", "0", "microseconds to spin in query", NULL, 0.0, 1e6, 0, 0},
    {"sleep_us", "0", "microseconds to sleep in update", NULL, 0.0, 1e5, 0, 0},
    {"chase_kib", "0", "size of the buffer that update reads along a chain", NULL, 0.0, 1e5, 0, 0},
    {"map", "none", "given: it is fed vertices; own: it maps them itself", kMap, 0.0, 0.0, 0, 0}};

static const contactcheck_plugin kPlugin = {
    .abi_version = CONTACTCHECK_PLUGIN_ABI,
    .struct_sizes = CONTACTCHECK_STRUCT_SIZES,
    .id = "probe",
    .summary = "takes a known time and finds nothing",
    .version = "1.0",
    .options = kOptions,
    .option_count = sizeof kOptions / sizeof *kOptions,
    .create = create,
    .destroy = destroy,
    .declare = declare,
    .prepare = prepare,
    .update = update,
    .query = query,
};

CONTACTCHECK_PLUGIN_EXPORT const contactcheck_plugin* contactcheck_plugin_entry(void) {
  return &kPlugin;
}
