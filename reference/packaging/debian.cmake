# `cpack` in the build folder writes contactcheck_VERSION_ARCH.deb, libcontactcheck-dev_....deb and
# python3-contactcheck_....deb.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME contactcheck)
set(CPACK_PACKAGE_VENDOR contactcheck)
set(CPACK_PACKAGE_CONTACT "contactcheck maintainers <root@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/permissions.cmake)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program development)
if(NOT CONTACTCHECK_REFERENCE)
  set(CPACK_COMPONENTS_ALL development)
elseif(CONTACTCHECK_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION devel)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME contactcheck)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "The command line: gives the same deformed meshes, frame by frame, to many
collision detectors, judges every answer against an exact oracle, and reports
what was missed, what was invented and what it cost.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# The meshes of most scenes.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "libcgal-demo, povray-examples, python3")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-contactcheck)
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "The module for Python: exact contacts, distances and winding numbers of
meshes in numpy arrays, lattices, every detector of contactcheck, and runs that
judge detectors written in Python.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
# The module is of one version of Python.
if(CONTACTCHECK_PYTHON AND CONTACTCHECK_REFERENCE)
  math(EXPR next "${Python_VERSION_MINOR} + 1")
  string(JOIN ", " CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
         "python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}~)"
         "python3 (<< ${Python_VERSION_MAJOR}.${next}~)" "python3-numpy")
endif()
# What run() and gate() call.
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "contactcheck (= ${PROJECT_VERSION})")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libcontactcheck-dev)
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "Headers, static libraries, CMake and pkg-config files: the detectors under
test, and what judges detectors.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libeigen3-dev, libhwy-dev, libtbb-dev")
# What contactcheck::reference needs beside them; contactcheck::core alone does not.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS
    "libarchive-dev, libassimp-dev, libbullet-dev, libccd-dev, libcgal-dev, libcli11-dev, libembree-dev, libfcl-dev, libfmt-dev, libgmp-dev, libmeshoptimizer-dev, nlohmann-json3-dev, pkg-config, zlib1g-dev")
include(CPack)
