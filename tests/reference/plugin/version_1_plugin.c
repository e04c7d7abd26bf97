/* A plug-in as version 1 of contactcheck_plugin.h had it: its table ends with query(); or, with
 * TABLE_VERSION 3, with own_ms(). The table lies at the end of a page behind which there is
 * nothing: a host that reads on dies. */
#define _DEFAULT_SOURCE
#include <stdint.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "contactcheck_plugin.h"

/* Written out, so that it stays as it was. */
typedef struct {
  uint32_t abi_version;
  uint32_t struct_sizes[15];
  const char *id, *summary, *version;
  const contactcheck_option* options;
  uint32_t option_count, reserved;
  int32_t (*create)(const contactcheck_setting*, uint32_t, void**, char*);
  void (*destroy)(void*);
  int32_t (*declare)(void*, contactcheck_semantics*, char*);
  int32_t (*prepare)(void*, const contactcheck_body*, uint32_t, char*);
  int32_t (*update)(void*, const contactcheck_frame*, char*);
  int32_t (*query)(void*, uint32_t, const contactcheck_answer*, char*);
#if TABLE_VERSION == 3
  uint32_t told_sizes[3], reserved_2;
  int32_t (*trace)(void*, const contactcheck_trace*, char*);
  int32_t (*counts)(void*, const contactcheck_counts*, char*);
  double (*own_ms)(void*);
#endif
} Table;

/* Of a 64-bit machine, in the header's order; the first is Table's. */
#if TABLE_VERSION == 3
#define TABLE_SIZE 192
#else
#define TABLE_VERSION 1
#define TABLE_SIZE 152
#endif
static const uint32_t kSizes[15] = {TABLE_SIZE, 80, 56, 16, 56, 40, 16, 32,
                                    8,          16, 16, 16, 48, 48, 64};

static int32_t create(const contactcheck_setting* s, uint32_t n, void** detector, char* message) {
  static int something;
  (void)s, (void)n, (void)message;
  *detector = &something;
  return CONTACTCHECK_OK;
}
static void destroy(void* detector) { (void)detector; }
static int32_t declare(void* detector, contactcheck_semantics* s, char* message) {
  (void)detector, (void)message;
  s->levels = CONTACTCHECK_LEVEL_TRIANGLE;
  s->question_count = 1;
  return CONTACTCHECK_OK;
}
static int32_t prepare(void* d, const contactcheck_body* b, uint32_t n, char* message) {
  (void)d, (void)b, (void)n, (void)message;
  return CONTACTCHECK_OK;
}
static int32_t update(void* d, const contactcheck_frame* f, char* message) {
  (void)d, (void)f, (void)message;
  return CONTACTCHECK_OK;
}
static int32_t query(void* d, uint32_t question, const contactcheck_answer* a, char* message) {
  (void)d, (void)question, (void)a, (void)message;
  return CONTACTCHECK_OK;
}

CONTACTCHECK_PLUGIN_EXPORT const void* contactcheck_version_1_entry(void) __asm__(
    "contactcheck_plugin_entry");

const void* contactcheck_version_1_entry(void) {
  const size_t page = (size_t)sysconf(_SC_PAGESIZE);
  char* const pages =
      mmap(NULL, 2 * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  Table table = {.abi_version = TABLE_VERSION,
                 .id = TABLE_VERSION == 1 ? "version-1" : "version-3",
                 .version = "1.0",
                 .create = create,
                 .destroy = destroy,
                 .declare = declare,
                 .prepare = prepare,
                 .update = update,
                 .query = query};
  memcpy(table.struct_sizes, kSizes, sizeof kSizes);
  mprotect(pages + page, page, PROT_NONE);
  return memcpy(pages + page - sizeof table, &table, sizeof table);
}
