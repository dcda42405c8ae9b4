# join_folders(BASE FILES RULES...): which files are one file to the compiler in a joined build. Those of a
# folder are, and those of the folders below BASE that match the expression of a rule NAME=EXPRESSION: to read
# the headers takes as long as to compile two or three folders.
function(join_folders base files)
    foreach(file ${files})
        cmake_path(RELATIVE_PATH file BASE_DIRECTORY ${base} OUTPUT_VARIABLE group)
        cmake_path(GET group PARENT_PATH group)
        foreach(rule ${ARGN})
            string(REPLACE "=" ";" rule ${rule})
            list(GET rule 0 name)
            list(GET rule 1 folders)
            string(REGEX REPLACE "^(${folders})$" "${name}" group "${group}")
        endforeach()
        string(REPLACE "/" "_" group "${group}")
        set_source_files_properties(${file} PROPERTIES UNITY_GROUP "${group}")
    endforeach()
endfunction()
