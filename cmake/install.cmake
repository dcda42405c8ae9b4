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

install(TARGETS sonarsim RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS sonarsim_lib EXPORT sonarsim ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
# embree.h needs a definition that only the library's own files get.
install(DIRECTORY lib/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/sonarsim
        FILES_MATCHING PATTERN "*.h" PATTERN "embree.h" EXCLUDE)
install(FILES README.md CHANGELOG.md CITATION.cff LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(PROGRAMS scripts/sonarsim_data.py scripts/sweep.mk scripts/contact_sheet.py
        DESTINATION ${CMAKE_INSTALL_DATADIR}/sonarsim/scripts)
install(DIRECTORY scripts/slurm DESTINATION ${CMAKE_INSTALL_DATADIR}/sonarsim/scripts
        USE_SOURCE_PERMISSIONS)
install(DIRECTORY configs scenes trajectories DESTINATION ${CMAKE_INSTALL_DATADIR}/sonarsim
        PATTERN "generated" EXCLUDE)

set(SONARSIM_PACKAGE ${CMAKE_INSTALL_LIBDIR}/cmake/sonarsim)
install(EXPORT sonarsim FILE sonarsimTargets.cmake NAMESPACE sonarsim:: DESTINATION ${SONARSIM_PACKAGE})
write_basic_package_version_file(sonarsimConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES cmake/sonarsimConfig.cmake ${PROJECT_BINARY_DIR}/sonarsimConfigVersion.cmake
        DESTINATION ${SONARSIM_PACKAGE})
