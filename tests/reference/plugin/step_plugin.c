/* A plug-in that answers steps alone: of two triangles of which the second, smaller one passes
 * through the first at half of the step. Its option `says`: `truth`, or what is wrong with it. */
#include <math.h>
#include <stdlib.h>

#include "contactcheck_plugin.h"
#include "one_word_plugin.h"

static int32_t create(const contactcheck_setting* settings, uint32_t count, void** detector,
                      char* message) {
  Word* const word = calloc(1, sizeof *word);
  (void)message;
  take_word(settings, count, word);
  *detector = word;
  return CONTACTCHECK_OK;
}

static void destroy(void* detector) { free(detector); }

static int32_t declare_impacts(void* detector, contactcheck_impact_semantics* s, char* message) {
  (void)message;
  s->levels = CONTACTCHECK_IMPACT_VERTEX_FACE | CONTACTCHECK_IMPACT_EDGE_EDGE |
              CONTACTCHECK_IMPACT_TRIANGLE | CONTACTCHECK_IMPACT_BODY;
  if (is(detector, "bodies")) s->levels = CONTACTCHECK_IMPACT_BODY;
  if (is(detector, "tolerant")) s->tolerance = 0.125, s->tolerance_of_start = 0.0625;
  return CONTACTCHECK_OK;
}

static int32_t prepare(void* detector, const contactcheck_body* bodies, uint32_t count,
                       char* message) {
  (void)detector, (void)message;
  return count == 2 && bodies[0].triangle_count == 1 ? CONTACTCHECK_OK : CONTACTCHECK_ERROR;
}

static int32_t step(void* detector, const contactcheck_step* step,
                    const contactcheck_step_answer* answer, char* message) {
  contactcheck_impact impact = {1, CONTACTCHECK_HAS_TIME, 0.5, 0};
  (void)message;
  if (step->body_count != 2 || step->start[1].vertices[2] != 1 || step->end[1].vertices[2] > 0.125)
    return CONTACTCHECK_ERROR;
  if (is(detector, "nothing")) return CONTACTCHECK_OK;
  if (is(detector, "early")) impact.time = 0.25;
  if (is(detector, "late")) impact.time = 0.75;
  if (is(detector, "nan")) impact.time = NAN;
  if (is(detector, "after")) impact.time = 1.5;
  if (is(detector, "timeless")) impact.has = 0;
  const contactcheck_body_impact bodies = {{1, 0}, impact};
  answer->bodies(answer->host, &bodies, 1);
  if (is(detector, "bodies")) return CONTACTCHECK_OK;
  const contactcheck_triangle_impact triangles = {{1, 0, 0, 0}, impact};
  answer->triangles(answer->host, &triangles, 1);
  for (uint32_t v = 0; v < 3; ++v) {
    const contactcheck_vertex_face_impact vertex = {{1, 0, v, 0}, impact};
    answer->vertex_faces(answer->host, &vertex, 1);
  }
  if (is(detector, "edges")) {
    const contactcheck_edge_edge_impact edges = {0, 1, {1, 0}, {2, 1}, impact};
    answer->edge_edges(answer->host, &edges, 1);
  }
  if (is(detector, "no-edge")) {
    const contactcheck_edge_edge_impact edges = {0, 1, {1, 7}, {2, 1}, impact};
    answer->edge_edges(answer->host, &edges, 1);
  }
  if (is(detector, "unsaid")) {
    const contactcheck_vertex_face_impact vertex = {{0, 1, 0, 0}, {0, 0, 0, 0}};
    answer->vertex_faces(answer->host, &vertex, 1);
  }
  return CONTACTCHECK_OK;
}

static const char* const kChoices[] = {"truth",  "nothing",  "early", "late",    "nan",
                                       "after",  "timeless", "edges", "no-edge", "unsaid",
                                       "bodies", "tolerant", NULL};
static const contactcheck_option kOptions[] = {
    {.name = "says", .default_value = "truth", .choices = kChoices}};

static const contactcheck_plugin kTable = {.abi_version = CONTACTCHECK_PLUGIN_ABI,
                                           .struct_sizes = CONTACTCHECK_STRUCT_SIZES,
                                           .impact_sizes = CONTACTCHECK_IMPACT_SIZES,
                                           .id = "knows-steps",
                                           .options = kOptions,
                                           .option_count = 1,
                                           .create = create,
                                           .destroy = destroy,
                                           .prepare = prepare,
                                           .declare_impacts = declare_impacts,
                                           .step = step};

const contactcheck_plugin* contactcheck_plugin_entry(void) { return &kTable; }
