# What `cmake --install` installs of the headers, and what the API pages show.
#
# Public headers are for users; each says so in its first comment. Support headers are installed
# only because public ones include them: a program should not include them itself, and they may
# change in any version.
set(EDGESCOUT_PUBLIC_HEADERS
  host/edgescout.h host/pipeline.h host/register_objects.h host/overlay.h
  host/core/camera.h host/core/camera_check.h host/core/depth_image.h host/core/grid.h
  host/core/kernel_types.h host/core/lens.h host/core/log.h
  host/core/option_names.h host/core/option_text.h host/core/options.h host/core/pose_error.h
  host/core/pose_matrix.h host/core/se3.h
  host/core/stopwatch.h host/core/time_limit.h host/core/types.h
  host/io/bop.h host/io/bop_targets.h host/io/camera_file.h host/io/depth_file.h
  host/io/depth_options.h host/io/depth_registration.h host/io/image.h
  host/io/image_options.h host/io/mesh.h host/io/pixels.h
  host/io/poses.h host/io/results.h
  host/model/axis_symmetry.h host/model/edge_model.h host/model/mesh_quality.h
  host/model/template_cache.h host/model/template_set.h host/model/viewpoints.h
  host/edge/edges.h
  host/register/d2co_options.h host/register/edge_icp_options.h
  host/register/measured_depth.h host/register/object_view.h
  host/register/pose_classifier.h host/register/pose_estimate.h host/register/pose_features.h
  host/register/refine.h host/register/scene.h
  host/detect/detect_options.h host/detect/detect_trace.h host/detect/explain.h
  host/detect/same_pose.h host/detect/searched_sizes.h host/detect/world_prior.h
  host/active/camera_geometry_check.h host/active/next_view.h host/active/recorded_views.h
  host/active/scout.h host/active/scout_state.h host/active/source.h host/active/views.h
  host/track/track_options.h host/track/track_overlay.h host/track/tracker.h
  kernels/backend.h kernels/device_work.h kernels/error.h kernels/types.h)

# Every header that the given ones include, directly or not, below the project's root.
function(edgescout_header_closure variable)
  set(open ${ARGN})
  set(closed)
  while(open)
    list(POP_FRONT open header)
    if(header IN_LIST closed)
      continue()
    endif()
    list(APPEND closed ${header})
    get_filename_component(folder ${header} DIRECTORY)
    file(STRINGS ${PROJECT_SOURCE_DIR}/${header} lines REGEX "^#include \"")
    foreach(line IN LISTS lines)
      string(REGEX REPLACE "^#include \"([^\"]+)\".*" "\\1" included "${line}")
      if(NOT included MATCHES "/")
        set(included ${folder}/${included})  # headers that shaders read name their neighbours only
      endif()
      list(APPEND open ${included})
    endforeach()
  endwhile()
  list(SORT closed)
  set(${variable} ${closed} PARENT_SCOPE)
endfunction()

edgescout_header_closure(EDGESCOUT_INSTALLED_HEADERS ${EDGESCOUT_PUBLIC_HEADERS})
set(EDGESCOUT_SUPPORT_HEADERS ${EDGESCOUT_INSTALLED_HEADERS})
list(REMOVE_ITEM EDGESCOUT_SUPPORT_HEADERS ${EDGESCOUT_PUBLIC_HEADERS})
foreach(header IN LISTS EDGESCOUT_INSTALLED_HEADERS)
  if(header MATCHES "^(host/(render|eval|baselines|experiments|cli)|kernels/gpu)/")
    message(FATAL_ERROR "${header} is reached from a public header and must not be installed")
  endif()
endforeach()
foreach(header IN LISTS EDGESCOUT_PUBLIC_HEADERS)
  file(READ ${PROJECT_SOURCE_DIR}/${header} text LIMIT 2000)
  if(NOT text MATCHES "// Public header")
    message(FATAL_ERROR "${header} is public and does not say so")
  endif()
endforeach()
