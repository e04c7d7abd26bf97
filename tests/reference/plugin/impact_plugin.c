/* A plug-in that answers queries of moving elements: contact at half the step, always. It does what
 * its option `fault` says in the third query that it is asked, or when it declares itself. The
 * environment variable CONTACTCHECK_PLUGIN_FAULT chooses what its table lacks. */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#ifdef __SSE__
#include <xmmintrin.h>
#endif

#include "contactcheck_plugin.h"
#include "one_word_plugin.h"

typedef struct {
  Word fault;
  int asked;
} State;

static int32_t create(const contactcheck_setting* settings, uint32_t count, void** detector,
                      char* message) {
  State* const state = calloc(1, sizeof *state);
  (void)message;
  take_word(settings, count, &state->fault);
  *detector = state;
  return CONTACTCHECK_OK;
}

static void destroy(void* detector) { free(detector); }

static int32_t declare_impacts(void* detector, contactcheck_impact_semantics* s, char* message) {
  s->kinds = CONTACTCHECK_VERTEX_FACE;
  s->tolerance = 0.25;
  if (is(detector, "both-kinds") || is(detector, "other-kinds")) s->kinds |= CONTACTCHECK_EDGE_EDGE;
  if (is(detector, "unknown-kind")) s->kinds |= 1u << 2;
  if (is(detector, "unknown-level")) s->levels = 1u << 6;
  if (is(detector, "last-level")) s->levels = CONTACTCHECK_IMPACT_SELF_EDGE_EDGE;
  if (is(detector, "unknown-precision")) s->precision = 2;
  if (is(detector, "single") || is(detector, "other-precision")) s->precision = CONTACTCHECK_SINGLE;
  if (is(detector, "nan-tolerance")) s->tolerance = NAN;
  if (is(detector, "negative-tolerance")) s->tolerance_of_start = -0.5;
  if (is(detector, "of-start")) s->tolerance = 0, s->tolerance_of_start = 0.5;
  if (is(detector, "declares-nothing")) s->kinds = 0;
  if (is(detector, "declare-fails")) {
    snprintf(message, CONTACTCHECK_MESSAGE_SIZE, "no licence");
    return CONTACTCHECK_ERROR;
  }
  return CONTACTCHECK_OK;
}

static void hang(void) {
  for (;;) pause();
}

static int32_t impact(void* detector, const contactcheck_impact_query* query,
                      contactcheck_impact* out, char* message) {
  State* const state = detector;
  out->contact = 1;
  out->has = CONTACTCHECK_HAS_TIME;
  out->time = 0.5;
  (void)query;
  if (++state->asked != 3) return CONTACTCHECK_OK;
  if (is(detector, "crash")) raise(SIGSEGV);
  if (is(detector, "exit")) _exit(0);
  if (is(detector, "hang")) hang();
  if (is(detector, "memory"))
    for (;;) memset(malloc(1 << 24), 1, 1 << 24);
  if (is(detector, "floods"))
    for (;;) puts("much to say"), fflush(stdout);
  if (is(detector, "nan-time")) out->time = NAN;
  if (is(detector, "late-time")) out->time = 1.5;
  if (is(detector, "bad-tolerance")) out->has |= CONTACTCHECK_HAS_TOLERANCE, out->tolerance = -1;
  if (is(detector, "own-tolerance")) out->has |= CONTACTCHECK_HAS_TOLERANCE, out->tolerance = 4;
#ifdef __SSE__
  if (is(detector, "flushes-to-zero")) _mm_setcsr(_mm_getcsr() | 0x8000u);
#endif
  if (is(detector, "refuses")) {
    snprintf(message, CONTACTCHECK_MESSAGE_SIZE, "not this one");
    return CONTACTCHECK_REFUSED;
  }
  if (is(detector, "fails")) {
    snprintf(message, CONTACTCHECK_MESSAGE_SIZE, "not today");
    return CONTACTCHECK_ERROR;
  }
  return CONTACTCHECK_OK;
}

static int32_t step(void* detector, const contactcheck_step* at, const contactcheck_step_answer* to,
                    char* message) {
  (void)detector, (void)at, (void)to, (void)message;
  return CONTACTCHECK_ERROR; /* nobody asks */
}

static const char* const kFaults[] = {"none",
                                      "both-kinds",
                                      "other-kinds",
                                      "other-precision",
                                      "unknown-kind",
                                      "unknown-level",
                                      "last-level",
                                      "unknown-precision",
                                      "single",
                                      "nan-tolerance",
                                      "negative-tolerance",
                                      "of-start",
                                      "declares-nothing",
                                      "declare-fails",
                                      "crash",
                                      "exit",
                                      "hang",
                                      "memory",
                                      "floods",
                                      "nan-time",
                                      "late-time",
                                      "bad-tolerance",
                                      "own-tolerance",
                                      "flushes-to-zero",
                                      "refuses",
                                      "fails",
                                      NULL};

static contactcheck_option kOptions[] = {
    {.name = "fault", .default_value = "none", .choices = kFaults}};

static contactcheck_plugin table = {.abi_version = CONTACTCHECK_PLUGIN_ABI,
                                    .struct_sizes = CONTACTCHECK_STRUCT_SIZES,
                                    .id = "impacts",
                                    .options = kOptions,
                                    .option_count = 1,
                                    .create = create,
                                    .destroy = destroy,
                                    .impact_sizes = CONTACTCHECK_IMPACT_SIZES,
                                    .declare_impacts = declare_impacts,
                                    .impact = impact,
                                    .step = step};

CONTACTCHECK_PLUGIN_EXPORT const contactcheck_plugin* contactcheck_plugin_entry(void) {
  const char* const fault = getenv("CONTACTCHECK_PLUGIN_FAULT");
  if (fault == NULL) return &table;
  if (strcmp(fault, "size") == 0) ++table.impact_sizes[1];
  if (strcmp(fault, "no-impact") == 0) table.impact = NULL;
  if (strcmp(fault, "no-impact-no-step") == 0) table.impact = NULL, table.step = NULL;
  if (strcmp(fault, "no-declare") == 0) table.declare_impacts = NULL;
  if (strcmp(fault, "default") == 0)
    kOptions[0].default_value = getenv("CONTACTCHECK_DEFAULT_FAULT");
  return &table;
}
