/* A plug-in that does what its option `fault` says, in frame 2 of query, update or prepare, or in
 * its declaration; it leaks in every frame. The environment variable CONTACTCHECK_PLUGIN_FAULT
 * chooses what it does when it is loaded: before there are options. Otherwise it reports no
 * contacts, which is its claim. */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "contactcheck_plugin.h"
#include "one_word_plugin.h"

typedef struct {
  Word fault;
  uint64_t frame, hash; /* hash: of each body's first node */
  int first, declared;  /* first: of the first process that is asked */
} State;

static const char* at_load(void) {
  const char* const fault = getenv("CONTACTCHECK_PLUGIN_FAULT");
  return fault == NULL ? "" : fault;
}

static void die(int number) {
  signal(number, SIG_DFL);
  raise(number);
}

static void hang(void) {
  for (;;) pause();
}

/* 2 ms of work, which a detector that misbehaves would rather not be seen doing. */
static void work(void) {
  struct timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  const double end = 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec + 2.0;
  do clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  while (1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec < end);
}

static void* work_in_thread(void* nothing) {
  work();
  return nothing;
}

/* Whether it has been asked for this before. */
static int remembers(uint64_t what) {
  static uint64_t known[1024];
  static int count;
  for (int i = 0; i < count; ++i)
    if (known[i] == what) return 1;
  if (count < 1024) known[count++] = what;
  return 0;
}

/* The same through files that outlive it, in the folder that a variable names. */
static int is_in_a_file(const char* variable, uint64_t what, int remember) {
  char path[4096];
  const char* const folder = getenv(variable);
  snprintf(path, sizeof path, "%s/misbehaving-%llu", folder == NULL ? "/tmp" : folder,
           (unsigned long long)what);
  if (access(path, F_OK) == 0) return 1;
  FILE* const file = remember ? fopen(path, "w") : NULL;
  if (file != NULL) fclose(file);
  return 0;
}

/* How many processes have been asked about frames before this one. */
static int processes_before(void) {
  static int count = -1;
  if (count < 0)
    for (count = 0; is_in_a_file("CONTACTCHECK_PLUGIN_FOLDER", (uint64_t)count, 1);) ++count;
  return count;
}

/* One has judged, and of each pass there are two: its question's, and that of the cold frames. */
static int is_second_pass(void) { return processes_before() >= 3; }

static int32_t create(const contactcheck_setting* settings, uint32_t count, void** detector,
                      char* message) {
  State* const state = calloc(1, sizeof *state);
  take_word(settings, count, &state->fault);
  if (is(state, "create-fails")) {
    free(state);
    snprintf(message, CONTACTCHECK_MESSAGE_SIZE, "no licence for this machine");
    return CONTACTCHECK_ERROR;
  }
  state->first =
      is(state, "lies-in-the-first-process") && !is_in_a_file("CONTACTCHECK_PLUGIN_FOLDER", 0, 0);
  *detector = state;
  return CONTACTCHECK_OK;
}

static void destroy(void* detector) {
  if (is(detector, "crash-when-destroyed")) die(SIGSEGV);
  free(detector);
}

static int32_t declare(void* detector, contactcheck_semantics* s, char* message) {
  State* const state = detector;
  const int again = state->declared;
  (void)message;
  state->declared = 1;
  s->levels = CONTACTCHECK_LEVEL_BODY | CONTACTCHECK_LEVEL_TRIANGLE;
  s->question_count = 1;
  s->questions[0] = CONTACTCHECK_ASK_TRIANGLES;
  if (is(state, "nan-depth")) {
    s->questions[s->question_count++] = CONTACTCHECK_ASK_CONTACTS;
    s->depth_kind = CONTACTCHECK_DEPTH_CONVEX_PAIR;
  }
  if (is(state, "exact-later")) s->exact = again;
  if (is(state, "nodes-later")) s->needs_vertices = !again;
  if (is(state, "scale-later")) {
    s->precision = CONTACTCHECK_SINGLE;
    s->scale = again ? 2.0 : 1.0;
  }
  if (is(state, "unknown-level")) s->levels = 1u << 20;
  if (is(state, "no-question") || strcmp(at_load(), "no-question") == 0) s->question_count = 0;
  return CONTACTCHECK_OK;
}

static int32_t prepare(void* detector, const contactcheck_body* bodies, uint32_t count,
                       char* message) {
  (void)bodies;
  (void)count;
  if (is(detector, "refuses")) {
    snprintf(message, CONTACTCHECK_MESSAGE_SIZE, "bodies without a licence");
    return CONTACTCHECK_REFUSED;
  }
  return CONTACTCHECK_OK;
}

/* Kept where a compiler must take it for used: clang leaves out memory that nobody reads. */
static void* volatile leaked;
static void leak(void) {
  leaked = malloc(1 << 24);
  if (leaked) memset(leaked, 1, 1 << 24);
}

static int32_t update(void* detector, const contactcheck_frame* frame, char* message) {
  State* const state = detector;
  state->frame = frame->index;
  state->hash = 0;
  for (uint32_t b = 0; b < frame->body_count; ++b)
    for (uint32_t i = 0; i < 3; ++i) {
      uint64_t bits;
      memcpy(&bits, &frame->bodies[b].nodes[i], sizeof bits);
      state->hash = 31 * state->hash + bits;
    }
  if (is(state, "works-in-a-thread")) {
    pthread_t thread;
    if (pthread_create(&thread, NULL, work_in_thread, NULL) == 0) pthread_detach(thread);
  }
  if (is(state, "leaks")) leak();
  if (frame->index != 2) return CONTACTCHECK_OK;
  if (is(state, "crash")) die(SIGSEGV);
  if (is(state, "exit")) exit(0);
  if (is(state, "aborts-in-its-second-pass") && is_second_pass()) die(SIGABRT);
  if (is(state, "leaves-in-its-second-pass") && is_second_pass()) _exit(0);
  if (is(state, "hang")) hang();
  if (is(state, "fails")) {
    memset(message, 'x', CONTACTCHECK_MESSAGE_SIZE); /* not ended by a zero byte */
    return CONTACTCHECK_ERROR;
  }
  if (is(state, "strange-status")) return 77;
  if (is(state, "memory"))
    for (;;) leak();
  return CONTACTCHECK_OK;
}

static void add_triangles(const contactcheck_answer* answer, uint32_t body, uint32_t triangle,
                          int count) {
  const contactcheck_element_pair pair = {0, body, 0, triangle};
  for (int i = 0; i < count; ++i) answer->triangles(answer->host, &pair, 1);
}

static int32_t query(void* detector, uint32_t question, const contactcheck_answer* answer,
                     char* message) {
  State* const state = detector;
  (void)message;
  if (is(state, "always-lies") || state->first) add_triangles(answer, 1, 0, 1);
  if (state->first) is_in_a_file("CONTACTCHECK_PLUGIN_FOLDER", 0, 1);
  if (is(state, "works") || (is(state, "remembers-frames") && !remembers(state->frame)) ||
      (is(state, "remembers-nodes") && !remembers(state->hash)) ||
      (is(state, "remembers-in-a-file") && !is_in_a_file("TMPDIR", state->frame, 1)))
    work();
  if (state->frame != 2) return CONTACTCHECK_OK;
  if (is(state, "no-such-body")) add_triangles(answer, 7, 0, 1);
  if (is(state, "no-such-triangle")) add_triangles(answer, 1, 1000000, 1);
  if (is(state, "lies")) add_triangles(answer, 1, 0, 1);
  if (is(state, "repeats")) add_triangles(answer, 1, 0, 100000);
  if (is(state, "endless-answer"))
    for (;;) add_triangles(answer, 1, 0, 1);
  if (is(state, "nan-depth") && question == CONTACTCHECK_ASK_CONTACTS) {
    const contactcheck_piece_contact contact = {{0, 1, 0, 0}, NAN, {1.0, 0.0, 0.0}};
    answer->piece_contacts(answer->host, &contact, 1);
  }
  if (is(state, "null-items")) answer->triangles(answer->host, NULL, 3);
  if (is(state, "prints")) puts("garbage on standard output");
  return CONTACTCHECK_OK;
}

static const char* const kFaults[] = {"none",
                                      "always-lies",
                                      "lies-in-the-first-process",
                                      "works",
                                      "remembers-frames",
                                      "remembers-nodes",
                                      "remembers-in-a-file",
                                      "works-in-a-thread",
                                      "exact-later",
                                      "nodes-later",
                                      "scale-later",
                                      "create-fails",
                                      "unknown-level",
                                      "no-question",
                                      "refuses",
                                      "crash",
                                      "exit",
                                      "aborts-in-its-second-pass",
                                      "leaves-in-its-second-pass",
                                      "hang",
                                      "fails",
                                      "strange-status",
                                      "memory",
                                      "leaks",
                                      "crash-when-destroyed",
                                      "no-such-body",
                                      "lies",
                                      "repeats",
                                      "endless-answer",
                                      "nan-depth",
                                      "null-items",
                                      "prints",
                                      "no-such-triangle",
                                      NULL};
static const contactcheck_option kOptions[] = {
    {"fault", "none", "what it does", kFaults, 0.0, 0.0, 0, 0}};

static contactcheck_plugin plugin = {
    ONE_WORD_TABLE,
    .id = "misbehaving",
    .summary = "misbehaves",
    .version = "0",
};

const contactcheck_plugin* contactcheck_plugin_entry(void) {
  const char* const fault = at_load();
  if (strcmp(fault, "version") == 0) plugin.abi_version = 99;
  if (strcmp(fault, "size") == 0) plugin.struct_sizes[5] += 8;
  if (strcmp(fault, "no-table") == 0) return NULL;
  if (strcmp(fault, "no-function") == 0) plugin.update = NULL;
  if (strcmp(fault, "built-in-id") == 0) plugin.id = "ffd-lazy";
  if (strcmp(fault, "library-id") == 0) plugin.id = "fcl-mine";
  if (strcmp(fault, "bad-id") == 0) plugin.id = "two words";
  if (strcmp(fault, "no-id") == 0) plugin.id = NULL;
  if (strcmp(fault, "bad-default") == 0) {
    static const contactcheck_option bad = {"fault", "nonsense", "", kFaults, 0, 0, 0, 0};
    plugin.options = &bad;
  }
  if (strcmp(fault, "crash") == 0) die(SIGSEGV);
  if (strcmp(fault, "exit") == 0) exit(0);
  if (strcmp(fault, "hang") == 0) hang();
  if (strcmp(fault, "memory") == 0)
    for (;;) leak();
  return &plugin;
}
