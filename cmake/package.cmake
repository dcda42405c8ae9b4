# `cpack -G DEB` in a build folder, as scripts/package.sh does: sonarsim_*.deb, the program with examples
# and documents, libsonarsim-dev_*.deb, the library for find_package(sonarsim), and python3-sonarsim_*.deb.
set(DEBIAN ${PROJECT_BINARY_DIR}/debian)
set(SONARSIM_PACKAGES sonarsim libsonarsim-dev)
set(CPACK_COMPONENTS_ALL program development)
if(SONARSIM_HAS_PYTHON)
    list(APPEND SONARSIM_PACKAGES python3-sonarsim)
    list(APPEND CPACK_COMPONENTS_ALL python)
endif()
foreach(package ${SONARSIM_PACKAGES})
    configure_file(cmake/debian/changelog.in ${DEBIAN}/${package}/changelog @ONLY)
    add_custom_command(OUTPUT ${DEBIAN}/${package}/changelog.gz DEPENDS ${DEBIAN}/${package}/changelog
                       VERBATIM COMMAND gzip -9nkf ${DEBIAN}/${package}/changelog)
    list(APPEND SONARSIM_CHANGELOGS ${DEBIAN}/${package}/changelog.gz)
    set(component program)
    if(package STREQUAL "libsonarsim-dev")
        set(component development)
    elseif(package STREQUAL "python3-sonarsim")
        set(component python)
    endif()
    install(FILES ${DEBIAN}/${package}/changelog.gz cmake/debian/copyright
            DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component})
endforeach()
add_custom_target(changelogs ALL DEPENDS ${SONARSIM_CHANGELOGS})

# The manual page, from --help.
find_program(HELP2MAN help2man)
if(HELP2MAN AND NOT SONARSIM_SANITIZE)
    set(MANUAL ${PROJECT_BINARY_DIR}/sonarsim.1)
    add_custom_command(OUTPUT ${MANUAL}.gz DEPENDS sonarsim VERBATIM
        COMMAND ${HELP2MAN} --no-info --name "simulator of sonars that writes datasets" --output ${MANUAL}
                $<TARGET_FILE:sonarsim>
        COMMAND gzip -9nkf ${MANUAL})
    add_custom_target(manual ALL DEPENDS ${MANUAL}.gz)
    install(FILES ${MANUAL}.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_CONTACT "the sonarsim authors <sonarsim@users.noreply.github.com>")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
# The licence is in the copyright file.
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)  # the scenes take half of the bytes of gzip, the default

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME sonarsim)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS python3)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS
    "python3-numpy, python3-pil, python3-scipy, python3-yaml")
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "simulator of sonars that writes datasets
Turns a mission (a glTF scene, a trajectory and sonars) into a dataset of
imaging, profiling, side-scan, scanning and echosounder data that can be
made again to the byte, on the processor alone.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libsonarsim-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libeigen3-dev, libembree-dev, libtbb-dev, libspdlog-dev, libyaml-cpp-dev, nlohmann-json3-dev, libtinygltf-dev, libdeflate-dev, nettle-dev")
# The modules that the library loads come with the program.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS sonarsim)
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "simulator of sonars, as a library
Headers and a static library, for projects that say find_package(sonarsim)
in CMake. The package sonarsim holds the program.")
if(SONARSIM_HAS_PYTHON)
    # The module is compiled for this version of Python alone.
    math(EXPR NEXT "${Python3_VERSION_MINOR} + 1")
    set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-sonarsim)
    set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
    set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
    set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
        "sonarsim (= ${PROJECT_VERSION}), python3 (>= 3.${Python3_VERSION_MINOR}), python3 (<< 3.${NEXT}), python3-numpy")
    set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS python3-torch)
    set(CPACK_DEBIAN_PYTHON_DESCRIPTION "simulator of sonars, for Python
The compiled module with which `import sonarsim` renders the pings of a
mission into numpy arrays and feeds them to PyTorch. The rest of the Python
package comes with the program, in the package sonarsim.")
endif()
include(CPack)
