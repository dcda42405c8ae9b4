# The page of `sonarsim gallery`, into the program as text.
set(SONARSIM_PAGE ${PROJECT_SOURCE_DIR}/lib/gallery/page)
# One script, in this order.
set(SONARSIM_PAGE_SCRIPTS data.js boxes.js names.js images.js canvas.js picture.js plan.js
    objects.js statistics.js controls.js)

function(read_page_files TEXT)
    foreach(PART ${ARGN})
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${SONARSIM_PAGE}/${PART})
        file(READ ${SONARSIM_PAGE}/${PART} PART_TEXT)
        string(APPEND ALL "${PART_TEXT}\n")
    endforeach()
    set(${TEXT} "${ALL}" PARENT_SCOPE)
endfunction()

read_page_files(SONARSIM_PAGE_HTML page.html)
read_page_files(SONARSIM_PAGE_CSS page.css)
read_page_files(SONARSIM_PAGE_JS ${SONARSIM_PAGE_SCRIPTS})
configure_file(${PROJECT_SOURCE_DIR}/lib/gallery/page.cpp.in ${PROJECT_BINARY_DIR}/gallery_page.cpp
               @ONLY)
target_sources(sonarsim_lib PRIVATE ${PROJECT_BINARY_DIR}/gallery_page.cpp)
