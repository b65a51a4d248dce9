# SPDX-License-Identifier: Apache-2.0
# Run by CPack when the files of all packages are in place: what Debian wants of each of them.
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)
foreach(component ${CPACK_COMPONENTS_ALL})
    string(TOUPPER ${component} upper)
    set(name ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
    set(root ${CPACK_TEMPORARY_DIRECTORY}/${component}/usr)

    # In /usr the loader finds libcortex by itself.
    file(GLOB binaries ${root}/bin/* ${root}/lib/*.so.*.*.* ${root}/lib/cortex/agent/*.so)
    foreach(binary ${binaries})
        if(NOT IS_SYMLINK ${binary})
            file(RPATH_REMOVE FILE ${binary})
        endif()
    endforeach()

    file(COPY ${CMAKE_CURRENT_LIST_DIR}/copyright DESTINATION ${root}/share/doc/${name})
    set(version ${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})
    file(WRITE ${root}/share/doc/${name}/changelog.Debian
"cortex (${version}) unstable; urgency=medium

  * The first release.

 -- ${CPACK_DEBIAN_PACKAGE_MAINTAINER}  ${now}
")
    file(GLOB pages ${root}/share/doc/${name}/changelog.Debian ${root}/share/man/man1/*.1)
    execute_process(COMMAND gzip -9n ${pages} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
