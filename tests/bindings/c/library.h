/* The library opened by dlopen: es_NAME is its function edgescout_NAME. */
#ifndef EDGESCOUT_TESTS_LIBRARY_H
#define EDGESCOUT_TESTS_LIBRARY_H

#include "host/bindings/c/edgescout.h"

/* clang-format off */
#define EACH_FUNCTION(F)                                                                        \
  F(version) F(abi) F(require_abi) F(last_error) F(status_name) F(set_log_sink) F(free)         \
  F(handle_count) F(canceller_create) F(cancel) F(canceller_reset) F(options_create)            \
  F(options_copy) F(options_set) F(options_get) F(options_count) F(options_at)                  \
  F(backend_create) F(backend_name) F(device_count) F(device_at) F(camera_create)               \
  F(camera_load) F(camera_get) F(picture_load) F(picture_grey) F(picture_undistorted)           \
  F(picture_get) F(picture_save_png) F(mesh_load) F(mesh_create) F(mesh_get) F(mesh_copy)       \
  F(templates_build) F(templates_join) F(templates_load) F(templates_save) F(templates_count)   \
  F(templates_at) F(detect) F(detect_jointly) F(register) F(detections_get) F(detections_at)    \
  F(detections_alternative) F(detections_stage) F(overlay) F(scout_create) F(scout_propose)     \
  F(scout_expectation) F(scout_give) F(scout_unreachable) F(scout_get) F(scout_step_at)         \
  F(scout_detections) F(scout_save) F(scout_resume) F(look_at) F(hemisphere_views)              \
  F(tracker_create) F(tracker_add) F(tracker_remove) F(tracker_update) F(tracker_search)        \
  F(tracker_count) F(tracker_at)
/* clang-format on */

#define DECLARE_FUNCTION(name) extern __typeof__(edgescout_##name)* es_##name;
EACH_FUNCTION(DECLARE_FUNCTION)

/* Ends the program where the library or a function is missing. */
void open_library(const char* file);

/* What a test expects; `checks_failed` counts what was otherwise. */
extern int checks_failed;
void check_that(int holds, const char* text, const char* file, int line);
void check_status(edgescout_status found, edgescout_status expected, const char* text,
                  const char* file, int line);
#define CHECK(condition) check_that((condition) != 0, #condition, __FILE__, __LINE__)
#define EXPECT(status, call) check_status((call), (status), #call, __FILE__, __LINE__)
#define OK(call) EXPECT(EDGESCOUT_OK, call)
/* The last message has this part. */
void check_message(const char* part, const char* file, int line);
#define SAYS(part) check_message((part), __FILE__, __LINE__)

#endif
