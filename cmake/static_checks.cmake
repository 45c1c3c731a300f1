# `format-check` and `tidy`: the static checks of the tree, as build targets.
file(GLOB_RECURSE EYEPOINT_SOURCES CONFIGURE_DEPENDS
    ${CMAKE_SOURCE_DIR}/config/*.[ch]pp ${CMAKE_SOURCE_DIR}/net/*.[ch]pp ${CMAKE_SOURCE_DIR}/terrain/*.[ch]pp
    ${CMAKE_SOURCE_DIR}/ig/*.[ch]pp ${CMAKE_SOURCE_DIR}/tools/*.[ch]pp ${CMAKE_SOURCE_DIR}/tests/*.[ch]pp)
find_program(CLANG_FORMAT clang-format)
find_program(RUN_CLANG_TIDY NAMES run-clang-tidy run-clang-tidy-14)
if(CLANG_FORMAT)
    add_custom_target(format-check COMMAND ${CLANG_FORMAT} --dry-run --Werror ${EYEPOINT_SOURCES} VERBATIM)
    add_custom_target(format COMMAND ${CLANG_FORMAT} -i ${EYEPOINT_SOURCES} VERBATIM)
endif()
if(RUN_CLANG_TIDY)
    add_custom_target(tidy COMMAND ${RUN_CLANG_TIDY} -quiet -p ${CMAKE_BINARY_DIR}
        "${CMAKE_SOURCE_DIR}/(config|net|terrain|ig|tools)/.*" VERBATIM)
endif()
