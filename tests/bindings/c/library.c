#include "tests/bindings/c/library.h"

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DEFINE_FUNCTION(name) __typeof__(edgescout_##name)* es_##name;
EACH_FUNCTION(DEFINE_FUNCTION)

int checks_failed = 0;

static void* symbol(void* library, const char* name) {
  void* const found = dlsym(library, name);
  if (found) return found;
  fprintf(stderr, "%s: %s\n", name, dlerror());
  exit(2);
}

/* C has no cast from an object's address to a function's. */
#define LOAD_FUNCTION(name)                                    \
  {                                                            \
    void* const address = symbol(library, "edgescout_" #name); \
    memcpy(&es_##name, &address, sizeof address);              \
  }

void open_library(const char* file) {
  void* const library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
  if (!library) {
    fprintf(stderr, "%s\n", dlerror());
    exit(2);
  }
  EACH_FUNCTION(LOAD_FUNCTION)
}

void check_that(int holds, const char* text, const char* file, int line) {
  if (holds) return;
  ++checks_failed;
  fprintf(stderr, "%s:%d: not so: %s\n", file, line, text);
}

void check_status(edgescout_status found, edgescout_status expected, const char* text,
                  const char* file, int line) {
  if (found == expected) return;
  ++checks_failed;
  fprintf(stderr, "%s:%d: %s: found %s (%s), expected %s\n", file, line, text,
          es_status_name(found), es_last_error(), es_status_name(expected));
}

void check_message(const char* part, const char* file, int line) {
  if (strstr(es_last_error(), part) && !strchr(es_last_error(), '\n')) return;
  ++checks_failed;
  fprintf(stderr, "%s:%d: message: found \"%s\", expected \"%s\" in one line\n", file, line,
          es_last_error(), part);
}
