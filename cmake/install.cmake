# `cmake --install`: the library, its public headers and the package that find_package(edgescout) reads. The kernels are
# object code inside the library, so the package has one target: edgescout::edgescout.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/edgescout)
install(TARGETS edgescout EXPORT edgescout-targets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT edgescout-targets NAMESPACE edgescout:: DESTINATION ${package_dir})

# Headers keep their paths, so that `#include "host/core/types.h"` reads the same inside and outside.
include(cmake/public_headers.cmake)
foreach(header IN LISTS EDGESCOUT_INSTALLED_HEADERS)
  get_filename_component(folder ${header} DIRECTORY)
  install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/edgescout/${folder})
endforeach()

configure_package_config_file(cmake/edgescout-config.cmake.in ${PROJECT_BINARY_DIR}/edgescout-config.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/edgescout-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/edgescout-config.cmake ${PROJECT_BINARY_DIR}/edgescout-config-version.cmake
        DESTINATION ${package_dir})
# The documents keep their places to each other, so that their links work.
install(FILES LICENSE README.md CHANGELOG.md CONTRIBUTING.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR})

# `cpack` in the build folder makes a Debian package.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "the edgescout authors")
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "the edgescout authors <edgescout@localhost>")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libeigen3-dev")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
include(CPack)
