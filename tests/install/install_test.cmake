# Installs BUILD_DIR into an empty prefix under WORK_DIR, then configures, builds and runs the
# project in CONSUMER_DIR against it. CXX_FLAGS: what the library was built with beyond the build
# type (sanitizers).
cmake_minimum_required(VERSION 3.25)
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${WORK_DIR})
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/prefix)
run(${CMAKE_COMMAND} -S ${CONSUMER_DIR} -B ${WORK_DIR}/build -G Ninja -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix -DCMAKE_CXX_COMPILER=${CXX_COMPILER}
    -DCMAKE_CXX_FLAGS=${CXX_FLAGS})
run(${CMAKE_COMMAND} --build ${WORK_DIR}/build)
# The C interface by its CMake package and by pkg-config, each from C.
file(GLOB_RECURSE c_library ${WORK_DIR}/prefix/lib*/libedgescout_c.so)
if(c_library)
  run(${CMAKE_COMMAND} -S ${CONSUMER_DIR}/../c_consumer -B ${WORK_DIR}/c_build -G Ninja
      -DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix -DCMAKE_C_FLAGS=${CXX_FLAGS})
  run(${CMAKE_COMMAND} --build ${WORK_DIR}/c_build)
  run(${WORK_DIR}/c_build/by_package)
  if(EXISTS ${WORK_DIR}/c_build/by_pkg_config)
    run(${WORK_DIR}/c_build/by_pkg_config)
  endif()
endif()
# The product needs nothing of the simulator, the laboratory and their packages.
file(GLOB_RECURSE library ${WORK_DIR}/prefix/lib*/libedgescout.so)
execute_process(COMMAND readelf -d ${library} OUTPUT_VARIABLE needed
  COMMAND_ERROR_IS_FATAL ANY)
foreach(forbidden opencv_rgbd edgescout_sim edgescout_lab)
  if(needed MATCHES ${forbidden})
    message(FATAL_ERROR "libedgescout.so needs ${forbidden}: ${needed}")
  endif()
endforeach()
execute_process(COMMAND nm -DC --defined-only ${library} OUTPUT_VARIABLE symbols
  COMMAND_ERROR_IS_FATAL ANY)
foreach(forbidden render run_experiments prepare_dc_icp evaluate_by_object)
  if(symbols MATCHES "edgescout::${forbidden}[(]")
    message(FATAL_ERROR "libedgescout.so holds ${forbidden} of the simulator or the laboratory")
  endif()
endforeach()
set(examples ${CONSUMER_DIR}/../../../docs/examples)
run(${WORK_DIR}/build/consumer ${examples}/scenes/000000 ${examples}/parts/obj_000001.ply 1)
run(${WORK_DIR}/build/find_part ${examples}/scenes/000000/gray/000000.png
    ${examples}/scenes/000000/scene_camera.json ${examples}/parts/obj_000001.ply 0.32 0.36)
run(${WORK_DIR}/prefix/bin/edgescout --version)
# docs/robot.md copies the types of the requests from here.
if(EXISTS ${WORK_DIR}/prefix/bin/edgescout_ros2 AND
   NOT EXISTS ${WORK_DIR}/prefix/share/edgescout/edgescout_msgs/package.xml)
  message(FATAL_ERROR "edgescout_msgs is not installed")
endif()

# The pages on the interfaces show the programs as they are.
foreach(shown "cpp_api.md;embedding/find_part.cpp" "c.md;c/find_part.c")
  list(GET shown 0 page_file)
  list(GET shown 1 program_file)
  file(READ ${examples}/${program_file} program)
  file(READ ${examples}/../${page_file} page)
  string(FIND "${page}" "${program}" place)
  if(place EQUAL -1)
    message(FATAL_ERROR "docs/${page_file} does not show docs/examples/${program_file} as it is")
  endif()
endforeach()

# The links of the installed documents lead to installed files and their headings.
file(GLOB readme ${WORK_DIR}/prefix/share/doc/*/README.md)
get_filename_component(folder ${readme} DIRECTORY)
find_program(python3 python3 REQUIRED)
run(${python3} ${CONSUMER_DIR}/../../../scripts/check_links.py --below ${folder})
