# The page of `sonarsim gallery`, into the program as text.
set(SONARSIM_PAGE ${PROJECT_SOURCE_DIR}/lib/gallery)
foreach(PART html css js)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${SONARSIM_PAGE}/page.${PART})
    string(TOUPPER ${PART} PART_NAME)
    file(READ ${SONARSIM_PAGE}/page.${PART} SONARSIM_PAGE_${PART_NAME})
endforeach()
configure_file(${SONARSIM_PAGE}/page.cpp.in ${PROJECT_BINARY_DIR}/gallery_page.cpp @ONLY)
target_sources(sonarsim_lib PRIVATE ${PROJECT_BINARY_DIR}/gallery_page.cpp)
