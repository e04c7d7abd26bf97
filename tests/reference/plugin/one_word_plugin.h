/* What the plug-ins of these tests have in common: a single option, whose word says what they do,
 * and a table with every function of the header's first version, under the header's names. */
#ifndef CONTACTCHECK_TESTS_ONE_WORD_PLUGIN_H
#define CONTACTCHECK_TESTS_ONE_WORD_PLUGIN_H

#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "contactcheck_plugin.h"

/* The first member of every detector's state. */
typedef struct {
  char text[32];
} Word;

static inline void take_word(const contactcheck_setting* settings, uint32_t count, Word* word) {
  if (count > 0) snprintf(word->text, sizeof word->text, "%s", settings[0].value);
}

static inline int is(const void* detector, const char* text) {
  const Word* const word = detector;
  return strcmp(word->text, text) == 0;
}

/* Of a contactcheck_plugin, with what the file around it calls kOptions, create(), destroy()... */
#define ONE_WORD_TABLE                                                               \
  .abi_version = CONTACTCHECK_PLUGIN_ABI, .struct_sizes = CONTACTCHECK_STRUCT_SIZES, \
  .options = kOptions, .option_count = 1, .create = create, .destroy = destroy,      \
  .declare = declare, .prepare = prepare, .update = update, .query = query

#endif
