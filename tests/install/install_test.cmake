# Installs BUILD_DIR into an empty prefix under WORK_DIR, then configures, builds and runs the project in CONSUMER_DIR
# against it. CXX_FLAGS: what the library was built with beyond the build type (sanitizers).
cmake_minimum_required(VERSION 3.25)
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${WORK_DIR})
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/prefix)
run(${CMAKE_COMMAND} -S ${CONSUMER_DIR} -B ${WORK_DIR}/build -G Ninja -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix -DCMAKE_CXX_COMPILER=${CXX_COMPILER} -DCMAKE_CXX_FLAGS=${CXX_FLAGS})
run(${CMAKE_COMMAND} --build ${WORK_DIR}/build)
# The product needs nothing of the simulator, the laboratory and their packages.
file(GLOB_RECURSE library ${WORK_DIR}/prefix/lib*/libedgescout.so)
execute_process(COMMAND readelf -d ${library} OUTPUT_VARIABLE needed
  COMMAND_ERROR_IS_FATAL ANY)
foreach(forbidden opencv_rgbd edgescout_sim edgescout_lab)
  if(needed MATCHES ${forbidden})
    message(FATAL_ERROR "libedgescout.so needs ${forbidden}: ${needed}")
  endif()
endforeach()
execute_process(COMMAND nm -DC --defined-only ${library} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
foreach(forbidden render run_experiments prepare_dc_icp evaluate_by_object)
  if(symbols MATCHES "edgescout::${forbidden}[(]")
    message(FATAL_ERROR "libedgescout.so holds ${forbidden} of the simulator or the laboratory")
  endif()
endforeach()
set(examples ${CONSUMER_DIR}/../../../docs/examples)
run(${WORK_DIR}/build/consumer ${examples}/scenes/000000 ${examples}/parts/obj_000001.ply 1)
run(${WORK_DIR}/build/look_around ${examples}/scenes/000001 ${examples}/parts/obj_000001.ply)
run(${WORK_DIR}/prefix/bin/edgescout --version)
