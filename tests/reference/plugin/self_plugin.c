/* A plug-in that answers the question `self`: in every frame, that triangles 0 and 1 of body 0
 * meet. Its option `says`: `pair` (of triangles), `body` (of the body alone), or `others`, which is
 * no answer to that question: a pair of two bodies. */
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

static int32_t declare(void* detector, contactcheck_semantics* s, char* message) {
  (void)message;
  s->levels = CONTACTCHECK_LEVEL_SELF_BODY;
  if (!is(detector, "body")) s->levels |= CONTACTCHECK_LEVEL_SELF_EDGE;
  s->question_count = 1;
  s->questions[0] = CONTACTCHECK_ASK_SELF;
  return CONTACTCHECK_OK;
}

static int32_t prepare(void* detector, const contactcheck_body* bodies, uint32_t count,
                       char* message) {
  (void)detector, (void)bodies, (void)count, (void)message;
  return CONTACTCHECK_OK;
}

static int32_t update(void* detector, const contactcheck_frame* frame, char* message) {
  (void)detector, (void)frame, (void)message;
  return CONTACTCHECK_OK;
}

static int32_t query(void* detector, uint32_t question, const contactcheck_answer* answer,
                     char* message) {
  (void)message;
  if (question != CONTACTCHECK_ASK_SELF) return CONTACTCHECK_ERROR;
  const contactcheck_element_pair pair = {0, is(detector, "others"), 1, 0};
  const contactcheck_body_pair body = {0, 0};
  if (is(detector, "body"))
    answer->bodies(answer->host, &body, 1);
  else
    answer->triangles(answer->host, &pair, 1);
  return CONTACTCHECK_OK;
}

static const char* const kChoices[] = {"pair", "body", "others", NULL};
static const contactcheck_option kOptions[] = {
    {.name = "says", .default_value = "pair", .choices = kChoices}};

static const contactcheck_plugin kTable = {.id = "knows-itself", ONE_WORD_TABLE};

const contactcheck_plugin* contactcheck_plugin_entry(void) { return &kTable; }
