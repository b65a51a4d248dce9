# SPDX-License-Identifier: Apache-2.0
# A man page for each program and verb, made from its own help. A build for tests has none.
find_package(Python3 COMPONENTS Interpreter)
set(programs)
foreach(program cortex-cli cortex-agent cortex-ds402-sim cortex-gripper-sim cortex-explorer)
    if(TARGET ${program})
        list(APPEND programs ${program})
    endif()
endforeach()
if(NOT Python3_FOUND OR CORTEX_SANITIZE OR CMAKE_CROSSCOMPILING OR NOT PROJECT_IS_TOP_LEVEL)
    return()
endif()

set(files)
foreach(program ${programs})
    list(APPEND files $<TARGET_FILE:${program}>)
endforeach()
set(pages ${CMAKE_CURRENT_BINARY_DIR}/man1)
add_custom_command(OUTPUT ${pages}.made
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${pages}
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_LIST_DIR}/man_pages.py ${PROJECT_VERSION} ${pages}
        ${files}
    COMMAND ${CMAKE_COMMAND} -E touch ${pages}.made
    DEPENDS ${CMAKE_CURRENT_LIST_DIR}/man_pages.py ${programs}
    COMMENT "Making the man pages")
add_custom_target(cortex-man ALL DEPENDS ${pages}.made)

install(DIRECTORY ${pages}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT tools
    FILES_MATCHING PATTERN "*.1" PATTERN cortex-explorer.1 EXCLUDE)
install(DIRECTORY ${pages}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT explorer
    FILES_MATCHING PATTERN cortex-explorer.1)
