# `cmake --install`: the program, its documents and examples, and the library as sonarsim::sonarsim.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# Whoever includes the headers is compiled as the library is: inline functions and the alignment of
# Eigen's types follow the instruction set. Warnings and sanitizers stay behind.
get_directory_property(SONARSIM_CODE_OPTIONS COMPILE_OPTIONS)
list(FILTER SONARSIM_CODE_OPTIONS INCLUDE REGEX "(^|:)-[fm]")
list(FILTER SONARSIM_CODE_OPTIONS EXCLUDE REGEX "sanitize|frame-pointer")
target_compile_options(sonarsim_lib INTERFACE "$<INSTALL_INTERFACE:${SONARSIM_CODE_OPTIONS}>")
target_compile_features(sonarsim_lib PUBLIC cxx_std_20)
target_include_directories(sonarsim_lib INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/sonarsim>)
set_target_properties(sonarsim_lib PROPERTIES OUTPUT_NAME sonarsim EXPORT_NAME sonarsim)
add_library(sonarsim::sonarsim ALIAS sonarsim_lib)

# In two components, as Debian has them: the program with its data, and the library.
install(TARGETS sonarsim RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(TARGETS sonarsim_lib EXPORT sonarsim
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
# All headers, since they include each other. The API is the few that tests/consumer includes and
# docs/development.md lists. embree.h needs a definition that only the library's own files get, and its
# neighbours include it.
install(DIRECTORY lib/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/sonarsim COMPONENT development
        FILES_MATCHING PATTERN "*.h" PATTERN "embree*.h" EXCLUDE)
install(FILES README.md CHANGELOG.md CONTRIBUTING.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT licence)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(PROGRAMS scripts/make_scenes.py
        DESTINATION ${CMAKE_INSTALL_DATADIR}/sonarsim/scripts COMPONENT program)
install(FILES scripts/sweep.mk scripts/shards.mk
        DESTINATION ${CMAKE_INSTALL_DATADIR}/sonarsim/scripts COMPONENT program)
install(DIRECTORY scripts/slurm scripts/kubernetes scripts/scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/sonarsim/scripts
        USE_SOURCE_PERMISSIONS COMPONENT program PATTERN "__pycache__" EXCLUDE)
# The motorbike's mesh comes from another package, so its mission stays in the checkout.
install(DIRECTORY configs scenes trajectories DESTINATION ${CMAKE_INSTALL_DATADIR}/sonarsim COMPONENT program
        PATTERN "generated" EXCLUDE PATTERN "motorbike*" EXCLUDE)
# Users cannot write where the missions are installed, so their scenes are installed, too.
install(CODE "execute_process(COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET
    COMMAND /usr/bin/python3 -B \"${PROJECT_SOURCE_DIR}/scripts/make_scenes.py\"
            seafloor wreck close_bottom lifeboat bathymetry sediments basin stock
            --out \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}/sonarsim/scenes/generated\")"
        COMPONENT program)

set(SONARSIM_PACKAGE ${CMAKE_INSTALL_LIBDIR}/cmake/sonarsim)
install(EXPORT sonarsim FILE sonarsimTargets.cmake NAMESPACE sonarsim:: DESTINATION ${SONARSIM_PACKAGE}
        COMPONENT development)
write_basic_package_version_file(sonarsimConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES cmake/sonarsimConfig.cmake ${PROJECT_BINARY_DIR}/sonarsimConfigVersion.cmake
        DESTINATION ${SONARSIM_PACKAGE} COMPONENT development)
