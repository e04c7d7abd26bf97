/* A beginning that is wrong: it says that two bodies touch where their boxes do. To answer with pairs
 * of triangles, add CONTACTCHECK_LEVEL_TRIANGLE and the question CONTACTCHECK_ASK_TRIANGLES in
 * declare(), and give the pairs to answer->triangles. What each function is for:
 * contactcheck_plugin.h. */
#include "contactcheck_plugin.h"

#include <stdlib.h>
#include <string.h>

typedef struct box {
  double low[3], high[3];
} box;

typedef struct detector {
  const contactcheck_body* bodies;
  uint32_t count;
  box* boxes; /* of each body, in the frame of the last update */
} detector;

static int32_t no_memory(char* message) {
  strcpy(message, "no memory");
  return CONTACTCHECK_ERROR;
}

static int32_t create(const contactcheck_setting* settings, uint32_t count, void** self, char* message) {
  (void)settings, (void)count;
  *self = calloc(1, sizeof(detector));
  return *self != NULL ? CONTACTCHECK_OK : no_memory(message);
}

static void destroy(void* self) {
  free(((detector*)self)->boxes);
  free(self);
}

/* What it claims, and so is judged by. */
static int32_t declare(void* self, contactcheck_semantics* semantics, char* message) {
  (void)self, (void)message;
  semantics->levels = CONTACTCHECK_LEVEL_BODY;
  semantics->question_count = 1;
  semantics->questions[0] = CONTACTCHECK_ASK_BODY;
  return CONTACTCHECK_OK;
}

/* Once per scene, not timed. */
static int32_t prepare(void* self, const contactcheck_body* bodies, uint32_t count, char* message) {
  detector* d = (detector*)self;
  d->bodies = bodies;
  d->count = count;
  d->boxes = (box*)malloc(count * sizeof(box));
  return d->boxes != NULL ? CONTACTCHECK_OK : no_memory(message);
}

/* Once per frame. */
static int32_t update(void* self, const contactcheck_frame* frame, char* message) {
  detector* d = (detector*)self;
  (void)message;
  for (uint32_t b = 0; b < d->count; ++b) {
    const double* vertices = frame->bodies[b].vertices;
    for (int k = 0; k < 3; ++k) d->boxes[b].low[k] = d->boxes[b].high[k] = vertices[k];
    for (uint32_t v = 1; v < d->bodies[b].vertex_count; ++v)
      for (int k = 0; k < 3; ++k) {
        const double x = vertices[3 * v + k];
        if (x < d->boxes[b].low[k]) d->boxes[b].low[k] = x;
        if (x > d->boxes[b].high[k]) d->boxes[b].high[k] = x;
      }
  }
  return CONTACTCHECK_OK;
}

static int overlap(const box* a, const box* b) {
  for (int k = 0; k < 3; ++k)
    if (a->high[k] < b->low[k] || b->high[k] < a->low[k]) return 0;
  return 1;
}

static int32_t query(void* self, uint32_t question, const contactcheck_answer* answer, char* message) {
  const detector* d = (const detector*)self;
  (void)question, (void)message;
  for (uint32_t b = 0; b < d->count; ++b)
    for (uint32_t a = 0; a < b; ++a)
      if (overlap(&d->boxes[a], &d->boxes[b])) {
        const contactcheck_body_pair pair = {a, b};
        answer->bodies(answer->host, &pair, 1);
      }
  return CONTACTCHECK_OK;
}

static const contactcheck_plugin table = {
    .abi_version = CONTACTCHECK_PLUGIN_ABI,
    .struct_sizes = CONTACTCHECK_STRUCT_SIZES,
    .id = "mine",
    .summary = "compares boxes of bodies",
    .version = "0.1",
    .create = create,
    .destroy = destroy,
    .declare = declare,
    .prepare = prepare,
    .update = update,
    .query = query,
};

const contactcheck_plugin* contactcheck_plugin_entry(void) { return &table; }
