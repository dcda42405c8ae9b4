# The Python package of apps/python, in build/python: `PYTHONPATH=build/python /usr/bin/python3 -c "import sonarsim"`.
# Its commands (`sonarsim export` and others) need no compiled module; `import sonarsim` for rendering does.
set(SONARSIM_PYTHON AUTO CACHE STRING
    "Build the module of the Python package: AUTO (where pybind11 and Python's headers are found), ON or OFF")
set_property(CACHE SONARSIM_PYTHON PROPERTY STRINGS AUTO ON OFF)

# Links, so that a change of a file needs no build.
set(SONARSIM_PYTHON_FOLDER ${PROJECT_BINARY_DIR}/python/sonarsim)
file(MAKE_DIRECTORY ${SONARSIM_PYTHON_FOLDER})
file(GLOB SONARSIM_PYTHON_FILES CONFIGURE_DEPENDS apps/python/sonarsim/*)
list(FILTER SONARSIM_PYTHON_FILES EXCLUDE REGEX "__pycache__|\\.so$")
foreach(FILE ${SONARSIM_PYTHON_FILES})
    get_filename_component(NAME ${FILE} NAME)
    file(CREATE_LINK ${FILE} ${SONARSIM_PYTHON_FOLDER}/${NAME} SYMBOLIC)
endforeach()

# The package comes with the program, its compiled module in a package of its own (cmake/package.cmake).
# Debian's Python finds it through a link.
set(SONARSIM_PYTHON_INSTALL lib/sonarsim/python/sonarsim)
install(DIRECTORY apps/python/sonarsim/ DESTINATION ${SONARSIM_PYTHON_INSTALL} COMPONENT program
        PATTERN "__pycache__" EXCLUDE)
install(CODE "set(FOLDER \$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/lib/python3/dist-packages)
file(MAKE_DIRECTORY \${FOLDER})
file(CREATE_LINK ../../sonarsim/python/sonarsim \${FOLDER}/sonarsim SYMBOLIC)" COMPONENT program)

# Python would have to load the sanitizer's library before the module.
set(SONARSIM_HAS_PYTHON OFF)
if(SONARSIM_PYTHON AND NOT SONARSIM_SANITIZE)
    find_package(Python3 QUIET COMPONENTS Interpreter Development.Module)
    if(Python3_Development.Module_FOUND)
        find_package(pybind11 2.10 QUIET CONFIG)
    endif()
    if(pybind11_FOUND)
        set(SONARSIM_HAS_PYTHON ON)
    elseif(NOT SONARSIM_PYTHON STREQUAL "AUTO")
        message(FATAL_ERROR "SONARSIM_PYTHON=ON takes the packages pybind11-dev and python3-dev; "
                            "-DPython3_EXECUTABLE=/usr/bin/python3 chooses a Python")
    else()
        message(STATUS "`import sonarsim` will not render: pybind11-dev or python3-dev is missing")
    endif()
endif()
if(NOT SONARSIM_HAS_PYTHON)
    return()
endif()

# NO_EXTRAS: the library is not compiled for link time optimisation.
pybind11_add_module(sonarsim_python MODULE NO_EXTRAS apps/python/module.cpp)
target_link_libraries(sonarsim_python PRIVATE sonarsim_lib)
target_compile_options(sonarsim_python PRIVATE $<$<CONFIG:Release>:-O1>)
set_target_properties(sonarsim_python PROPERTIES OUTPUT_NAME _sonarsim
                      LIBRARY_OUTPUT_DIRECTORY ${SONARSIM_PYTHON_FOLDER})
install(TARGETS sonarsim_python LIBRARY DESTINATION ${SONARSIM_PYTHON_INSTALL} COMPONENT python)
