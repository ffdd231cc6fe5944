# `cmake --install`: the library, its public headers and the package that find_package(edgescout)
# reads. The kernels are object code inside the library, so the package has one target:
# edgescout::edgescout.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/edgescout)
install(TARGETS edgescout EXPORT edgescout-targets 
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development)
install(EXPORT edgescout-targets NAMESPACE edgescout:: DESTINATION ${package_dir}
  COMPONENT development)

# Headers keep their paths, so that `#include "host/core/types.h"` reads the same inside and
# outside.
include(cmake/public_headers.cmake)
foreach(header IN LISTS EDGESCOUT_INSTALLED_HEADERS)
  get_filename_component(folder ${header} DIRECTORY)
  install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/edgescout/${folder}
    COMPONENT development)
endforeach()

configure_package_config_file(cmake/edgescout-config.cmake.in
  ${PROJECT_BINARY_DIR}/edgescout-config.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/edgescout-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/edgescout-config.cmake
  ${PROJECT_BINARY_DIR}/edgescout-config-version.cmake
        DESTINATION ${package_dir} COMPONENT development)
# The documents keep their places to each other, so that their links work. Some lead to reports.
install(FILES LICENSE README.md CHANGELOG.md CONTRIBUTING.md DESTINATION ${CMAKE_INSTALL_DOCDIR}
        COMPONENT development)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT development)
install(FILES bench/trust/README.md bench/trust/parts.csv bench/trust/photographs.csv
        DESTINATION ${CMAKE_INSTALL_DOCDIR}/bench/trust COMPONENT development)
install(DIRECTORY bench/results DESTINATION ${CMAKE_INSTALL_DOCDIR}/bench COMPONENT development
        FILES_MATCHING PATTERN "*.md" PATTERN "*.csv")

include(cmake/program_files.cmake)
include(cmake/packages.cmake)
