# The Python package of apps/python, in build/python: `PYTHONPATH=build/python python3 -c "import sonarsim"`.
# The tools in it run without the compiled module.
set(SONARSIM_PYTHON_FOLDER ${PROJECT_BINARY_DIR}/python/sonarsim)
file(GLOB_RECURSE SONARSIM_PYTHON_FILES CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}/apps/python/sonarsim
     apps/python/sonarsim/*)
list(FILTER SONARSIM_PYTHON_FILES EXCLUDE REGEX __pycache__)
foreach(FILE ${SONARSIM_PYTHON_FILES})
    configure_file(apps/python/sonarsim/${FILE} ${SONARSIM_PYTHON_FOLDER}/${FILE} COPYONLY)
endforeach()
# Where Debian's Python looks.
install(DIRECTORY apps/python/sonarsim DESTINATION lib/python3/dist-packages COMPONENT program
        PATTERN "__pycache__" EXCLUDE)

set(SONARSIM_PYTHON AUTO CACHE STRING
    "Build the Python package: AUTO (where pybind11 and Python's headers are found), ON or OFF")
set_property(CACHE SONARSIM_PYTHON PROPERTY STRINGS AUTO ON OFF)

# Python would have to load the sanitizer's library before the module.
set(SONARSIM_HAS_PYTHON OFF)
if(SONARSIM_PYTHON AND NOT SONARSIM_SANITIZE)
    # Debian's numpy belongs to Debian's Python, which need not be the first in the path.
    foreach(CANDIDATE python3 /usr/bin/python3)
        if(NOT Python3_EXECUTABLE)
            execute_process(COMMAND ${CANDIDATE} -c "import numpy, sys; print(sys.executable, sys.prefix, sep=';')"
                            OUTPUT_VARIABLE FOUND RESULT_VARIABLE FAILED ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
            if(NOT FAILED)
                list(GET FOUND 0 Python3_EXECUTABLE)
                list(GET FOUND 1 Python3_ROOT_DIR)
            endif()
        endif()
    endforeach()
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
        message(STATUS "No Python package: pybind11-dev or python3-dev is missing")
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
install(TARGETS sonarsim_python LIBRARY DESTINATION lib/python3/dist-packages/sonarsim COMPONENT python)
