# `cpack` in the build folder makes Debian packages, one for each component of the installed files:
#
#   libedgescout0     the libraries, for C++ and C
#   libedgescout-dev  headers, what find_package and pkg-config read, documents
#   edgescout         the program, its manual pages and the completion of its options in bash
#   python3-edgescout the Python package
#   edgescout-ros2    the ROS 2 node, and edgescout_msgs, the types of its requests
#
# A part that was left out of the build (a library it needs is missing) gets no package.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "the edgescout authors")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "the edgescout authors <edgescout@localhost>")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# The packages depend on each other's libraries by what libedgescout0 says of itself.
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY "=")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/host
  ${PROJECT_BINARY_DIR}/host/bindings/c)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)

function(edgescout_package component package section summary)
  string(TOUPPER ${component} name)
  set(CPACK_DEBIAN_${name}_PACKAGE_NAME ${package} PARENT_SCOPE)
  set(CPACK_DEBIAN_${name}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_COMPONENT_${name}_DESCRIPTION "${summary}
 edgescout finds textureless rigid objects in grey images from their CAD models and gives their
 6-DoF poses with covariances and probabilities." PARENT_SCOPE)
  set(packages ${packages} ${component} PARENT_SCOPE)
endfunction()

set(packages)
edgescout_package(library libedgescout0 libs "6-DoF poses of textureless objects: libraries")
edgescout_package(development libedgescout-dev libdevel
  "6-DoF poses of textureless objects: headers")
edgescout_package(program edgescout science "6-DoF poses of textureless objects: program")
set(CPACK_COMPONENT_DEVELOPMENT_DEPENDS library)
set(CPACK_COMPONENT_PROGRAM_DEPENDS library)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libeigen3-dev")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "mesa-vulkan-drivers")
if(TARGET edgescout_python)
  edgescout_package(python python3-edgescout python "6-DoF poses of textureless objects: Python")
  set(CPACK_COMPONENT_PYTHON_DEPENDS library)
  # The module is of one version of Python: that of Debian 12.
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11), python3 (<< 3.12), python3-numpy")
endif()
if(TARGET edgescout_ros2)
  edgescout_package(ros2 edgescout-ros2 science "6-DoF poses of textureless objects: ROS 2 node")
  set(CPACK_COMPONENT_ROS2_DEPENDS library)
endif()
set(CPACK_COMPONENTS_ALL ${packages})
include(CPack)
