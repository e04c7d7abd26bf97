/* A plug-in that tells of its work: stages, counters and times. It reports every pair of triangles
 * whose first triangle has an even number, which is its claim. Its option `told` says what it
 * tells; all but `truth`, `owners` and `labels` cannot be so, or change in frame 2. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "contactcheck_plugin.h"
#include "one_word_plugin.h"

typedef struct {
  Word told;
  uint64_t frame;
  const contactcheck_body* bodies;
  contactcheck_element_pair* pairs;
  uint64_t pair_count;
} State;

static int32_t create(const contactcheck_setting* settings, uint32_t count, void** detector,
                      char* message) {
  State* const state = calloc(1, sizeof *state);
  (void)message;
  take_word(settings, count, &state->told);
  *detector = state;
  return CONTACTCHECK_OK;
}

static void destroy(void* detector) {
  free(((State*)detector)->pairs);
  free(detector);
}

static int32_t declare(void* detector, contactcheck_semantics* s, char* message) {
  (void)detector;
  (void)message;
  s->levels = CONTACTCHECK_LEVEL_TRIANGLE;
  s->question_count = 1;
  return CONTACTCHECK_OK;
}

static int32_t prepare(void* detector, const contactcheck_body* bodies, uint32_t count,
                       char* message) {
  State* const state = detector;
  (void)count;
  (void)message;
  state->bodies = bodies;
  state->pair_count = 0;
  free(state->pairs);
  state->pairs =
      calloc((size_t)bodies[0].triangle_count * bodies[1].triangle_count, sizeof *state->pairs);
  for (uint32_t a = 0; a < bodies[0].triangle_count; a += 2)
    for (uint32_t b = 0; b < bodies[1].triangle_count; ++b) {
      const contactcheck_element_pair pair = {1, 0, b, a}; /* the higher body first */
      state->pairs[state->pair_count++] = pair;
    }
  return CONTACTCHECK_OK;
}

static int32_t update(void* detector, const contactcheck_frame* frame, char* message) {
  (void)message;
  ((State*)detector)->frame = frame->index;
  return CONTACTCHECK_OK;
}

static int32_t query(void* detector, uint32_t question, const contactcheck_answer* answer,
                     char* message) {
  const State* const state = detector;
  (void)question;
  (void)message;
  answer->triangles(answer->host, state->pairs, state->pair_count);
  return CONTACTCHECK_OK;
}

/* ---- what it tells ----------------------------------------------------------------------- */

/* More than the suite takes, where `what` is what is told; else the true number. */
static uint64_t huge(const State* state, const char* what, uint64_t number) {
  return is(state, what) ? UINT64_MAX : number;
}

static void tell_cells(const State* state, contactcheck_stage* stage,
                       const contactcheck_trace* trace) {
  static const contactcheck_element_pair first_cells = {0, 1, 0, 0};
  stage->covers =
      is(state, "labels") ? CONTACTCHECK_COVERS_LABEL_CELLS : CONTACTCHECK_COVERS_OWNER_CELLS;
  stage->pairs = &first_cells;
  stage->count = 1;
  if (!is(state, "owners") && !is(state, "wrong-owner")) return;
  for (uint32_t body = 0; body < 2; ++body) {
    const uint32_t count = state->bodies[body].triangle_count;
    uint32_t* const owner = calloc(count, sizeof *owner);
    if (is(state, "wrong-owner")) owner[0] = 1000000;
    trace->owners(trace->host, body, owner, count);
    free(owner);
  }
}

static int32_t trace(void* detector, const contactcheck_trace* trace, char* message) {
  const State* const state = detector;
  const int late = state->frame == 2;
  static const contactcheck_body_pair all = {1, 0};
  static const contactcheck_element_pair wrong = {0, 1, 1000000, 0};
  contactcheck_stage stage = {.name = "everything",
                              .unit = "body pairs",
                              .in = huge(state, "huge-in", 1),
                              .out = huge(state, "huge-out", 1),
                              .covers = CONTACTCHECK_COVERS_BODIES,
                              .count = 1,
                              .bodies = &all};
  if (is(state, "trace-fails") && late) {
    snprintf(message, CONTACTCHECK_MESSAGE_SIZE, "lost the stages");
    return CONTACTCHECK_ERROR;
  }
  if (is(state, "no-name")) stage.name = NULL;
  if (is(state, "two-lines")) stage.unit = "body\npairs";
  if (is(state, "changes") && late) stage.name = "something";
  for (int i = 0; i < (is(state, "many") ? 1000 : 1); ++i) trace->stage(trace->host, &stage);
  stage = (contactcheck_stage){.name = "even",
                               .unit = "triangle pairs",
                               .in = 2 * state->pair_count,
                               .out = state->pair_count,
                               .visited = huge(state, "huge-visited", 7),
                               .visited_unit = "numbers",
                               .covers = CONTACTCHECK_COVERS_TRIANGLES,
                               .count = state->pair_count,
                               .pairs = state->pairs};
  if (is(state, "wrong-triangle")) {
    stage.pairs = &wrong;
    stage.count = 1;
  }
  if (is(state, "covers-nothing")) stage.covers = 99;
  if (is(state, "owners") || is(state, "labels") || is(state, "no-owners") ||
      is(state, "wrong-owner"))
    tell_cells(state, &stage, trace);
  if (is(state, "owners-of-nobody")) trace->owners(trace->host, 777, NULL, 0);
  if (is(state, "owners-far-away")) trace->owners(trace->host, UINT32_MAX, NULL, 0);
  trace->stage(trace->host, &stage);
  return CONTACTCHECK_OK;
}

static int32_t counts(void* detector, const contactcheck_counts* counts, char* message) {
  const State* const state = detector;
  (void)message;
  counts->add(counts->host, "pairs_looked_at", huge(state, "huge-counter", state->pair_count));
  if (is(state, "counter-twice")) counts->add(counts->host, "pairs_looked_at", 1);
  if (is(state, "counter-name")) counts->add(counts->host, "two words", 1);
  if (is(state, "counter-comes") && state->frame == 2) counts->add(counts->host, "new", 1);
  return CONTACTCHECK_OK;
}

static double own_ms(void* detector) {
  const State* const state = detector;
  if (is(state, "clock-nan")) return NAN;
  if (is(state, "clock-endless")) return INFINITY;
  return is(state, "no-clock") && state->frame == 2 ? -1.0 : 0.25;
}

static const char* const kTold[] = {"truth",
                                    "owners",
                                    "labels",
                                    "trace-fails",
                                    "no-name",
                                    "two-lines",
                                    "changes",
                                    "many",
                                    "wrong-triangle",
                                    "covers-nothing",
                                    "no-owners",
                                    "wrong-owner",
                                    "owners-of-nobody",
                                    "owners-far-away",
                                    "huge-in",
                                    "huge-out",
                                    "huge-visited",
                                    "huge-counter",
                                    "counter-twice",
                                    "counter-name",
                                    "counter-comes",
                                    "clock-nan",
                                    "clock-endless",
                                    "no-clock",
                                    NULL};
static const contactcheck_option kOptions[] = {
    {"told", "truth", "what it tells of its work", kTold, 0.0, 0.0, 0, 0}};

static contactcheck_plugin plugin = {
    ONE_WORD_TABLE,
    .id = "staged",
    .summary = "tells of its work",
    .version = "2.5",
    .told_sizes = CONTACTCHECK_TOLD_SIZES,
    .trace = trace,
    .counts = counts,
    .own_ms = own_ms,
};

const contactcheck_plugin* contactcheck_plugin_entry(void) {
  if (getenv("CONTACTCHECK_STAGE_SIZE") != NULL) plugin.told_sizes[0] -= 8;
  return &plugin;
}
