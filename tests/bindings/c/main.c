/* Runs tests in this order: c_interface_test LIBRARY EXAMPLES TEST... */
#include <stdio.h>
#include <string.h>

#include "tests/bindings/c/scene.h"

struct named_test {
  const char* name;
  void (*run)(void);
};

static const struct named_test tests[] = {
    {"versions", test_versions}, {"handles", test_handles}, {"nulls", test_nulls},
    {"structs", test_structs},   {"strings", test_strings}, {"options", test_options},
    {"images", test_images},     {"models", test_models},   {"limits", test_limits},
    {"busy", test_busy},         {"scout", test_scout},     {"memory", test_memory},
    {"log", test_log},           {"tracker", test_tracker}, {"depth", test_depth},
    {"results", print_results}};

static int run_test(const char* name) {
  for (size_t i = 0; i < sizeof tests / sizeof *tests; ++i) {
    if (strcmp(tests[i].name, name) != 0) continue;
    tests[i].run();
    CHECK(es_handle_count() == 0); /* tests free what they make */
    return checks_failed != 0;
  }
  fprintf(stderr, "no test %s\n", name);
  return 2;
}

int main(int argc, char** argv) {
  if (argc < 4) {
    fprintf(stderr, "usage: c_interface_test LIBRARY EXAMPLES TEST...\n");
    return 2;
  }
  open_library(argv[1]);
  examples_folder = argv[2];
  int result = 0;
  for (int i = 3; i < argc && result == 0; ++i) result = run_test(argv[i]);
  return result;
}
