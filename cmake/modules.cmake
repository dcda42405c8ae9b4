# Shared objects that the program loads when a mission first needs one (lib/core/module.h). Each links
# a library that the program itself is not linked with.
find_library(ASSIMP_LIBRARY assimp)
find_path(ASSIMP_INCLUDE_DIR assimp/Importer.hpp)
if(ASSIMP_LIBRARY AND ASSIMP_INCLUDE_DIR)
    # Debian's CMake target of assimp asks for draco's files, which only its static library needs.
    add_library(sonarsim_meshes MODULE apps/modules/meshes.cpp)
    target_include_directories(sonarsim_meshes PRIVATE lib)
    target_include_directories(sonarsim_meshes SYSTEM PRIVATE ${ASSIMP_INCLUDE_DIR})
    target_link_libraries(sonarsim_meshes PRIVATE ${ASSIMP_LIBRARY})
    list(APPEND SONARSIM_MODULES sonarsim_meshes)
else()
    message(WARNING "libassimp-dev is not installed: this build will not read OBJ, STL and PLY")
endif()

find_library(OPENIMAGEIO_LIBRARY OpenImageIO)
find_library(OPENIMAGEIO_UTIL_LIBRARY OpenImageIO_Util)
find_path(OPENIMAGEIO_INCLUDE_DIR OpenImageIO/imageio.h)
find_package(TIFF)
if(OPENIMAGEIO_LIBRARY AND OPENIMAGEIO_UTIL_LIBRARY AND OPENIMAGEIO_INCLUDE_DIR AND TIFF_FOUND)
    add_library(sonarsim_images MODULE apps/modules/images.cpp apps/modules/tiff_header.cpp)
    target_include_directories(sonarsim_images PRIVATE lib)
    target_include_directories(sonarsim_images SYSTEM PRIVATE ${OPENIMAGEIO_INCLUDE_DIR} ${TIFF_INCLUDE_DIRS})
    target_link_libraries(sonarsim_images PRIVATE ${OPENIMAGEIO_LIBRARY} ${OPENIMAGEIO_UTIL_LIBRARY}
                          ${TIFF_LIBRARIES})
    list(APPEND SONARSIM_MODULES sonarsim_images)
else()
    message(STATUS "heightmaps and maps will not be read: libopenimageio-dev or libtiff-dev is missing")
endif()

foreach(module ${SONARSIM_MODULES})
    set_target_properties(${module} PROPERTIES CXX_VISIBILITY_PRESET hidden
                          LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib/sonarsim)
    # The sanitizers' functions are those of the program, which need not export all of them.
    target_compile_options(${module} PRIVATE -fno-sanitize=all)
    target_link_options(${module} PRIVATE -fno-sanitize=all)
    # Where lib/core/module.cpp looks, whatever CMAKE_INSTALL_LIBDIR is.
    install(TARGETS ${module} LIBRARY DESTINATION lib/sonarsim COMPONENT program)
    add_dependencies(sonarsim_lib ${module})
endforeach()
set_source_files_properties(lib/core/module.cpp PROPERTIES
    COMPILE_DEFINITIONS SONARSIM_PREFIX="${CMAKE_INSTALL_PREFIX}" SKIP_UNITY_BUILD_INCLUSION ON)
