# SPDX-License-Identifier: Apache-2.0
# Debian packages: `./run package`, or `cpack` in a build folder. Each component that files are
# installed for is one package.
set(CORTEX_MAINTAINER "CorteX developers <developers@cortex.invalid>" CACHE STRING
    "Who maintains the Debian packages, with an address")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/finish.cmake)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER ${CORTEX_MAINTAINER})
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)  # who links with the library needs the same version
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")     # each package has one of its own
set(CPACK_COMPONENTS_ALL)
set(same "(= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")

# cortex_package(COMPONENT NAME SECTION SUMMARY TEXT): as `apt show` prints it.
macro(cortex_package component name section summary text)
    string(TOUPPER ${component} upper)
    list(APPEND CPACK_COMPONENTS_ALL ${component})
    set(CPACK_DEBIAN_${upper}_DESCRIPTION "${summary}\n${text}")
    set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
    set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
endmacro()

cortex_package(library libcortex0 libs "Self-describing, deterministic control systems: library"
"CorteX builds robotic control systems of named objects with types, which other
programs discover, check, show and command without prior knowledge. This
package has the shared libraries, and the types and rules for robots.")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_LIST_DIR}/triggers)

cortex_package(dev libcortex-dev libdevel "Self-describing, deterministic control systems: headers"
"This package has what programs and plug-ins are compiled against: headers, and
files for CMake and pkg-config.")
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libcortex0 ${same}")
set(CPACK_DEBIAN_DEV_PACKAGE_RECOMMENDS "libeigen3-dev")

cortex_package(tools cortex-tools science "Self-describing, deterministic control systems: programs"
"The program cortex finds, checks, shows and commands the agents of a network.
The program cortex-agent runs a control system from an XML file, and
cortex-ds402-sim and cortex-gripper-sim simulate a CiA 402 drive and a Robotiq
gripper behind Modbus/TCP. Examples are in /usr/share/cortex/examples.")
set(CPACK_DEBIAN_TOOLS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_TOOLS_PACKAGE_DEPENDS "libcortex0 ${same}")
set(CPACK_DEBIAN_TOOLS_PACKAGE_SUGGESTS "cortex-modbus, cortex-mujoco")

if(TARGET cortex-modbus)
    cortex_package(modbus cortex-modbus science
        "Self-describing, deterministic control systems: Modbus/TCP"
"This package has the behaviour of devices behind Modbus/TCP, such as IO
couplers, CiA 402 drives and a gripper. The program cortex-agent loads it when a
system has one of them.")
    set(CPACK_DEBIAN_MODBUS_PACKAGE_SHLIBDEPS ON)
    set(CPACK_DEBIAN_MODBUS_PACKAGE_DEPENDS "libcortex0 ${same}")
    set(CPACK_DEBIAN_MODBUS_PACKAGE_RECOMMENDS "cortex-tools")
endif()
if(TARGET cortex-mujoco)
    cortex_package(mujoco cortex-mujoco science
        "Self-describing, deterministic control systems: physics"
"This package has the behaviour of worlds in which manipulators, grippers and
bodies have masses and touch each other, computed by MuJoCo. The program
cortex-agent loads it when a system has one of them.")
    set(CPACK_DEBIAN_MUJOCO_PACKAGE_SHLIBDEPS ON)
    set(CPACK_DEBIAN_MUJOCO_PACKAGE_DEPENDS "libcortex0 ${same}")
    set(CPACK_DEBIAN_MUJOCO_PACKAGE_RECOMMENDS "cortex-tools")
endif()
if(TARGET cortex-explorer)
    cortex_package(explorer cortex-explorer science
        "Self-describing, deterministic control systems: the window"
"This program shows every agent of a network in a window, whatever its types:
a tree of all objects with their states, values, relations and events.")
    set(CPACK_DEBIAN_EXPLORER_PACKAGE_SHLIBDEPS ON)
    set(CPACK_DEBIAN_EXPLORER_PACKAGE_DEPENDS "libcortex0 ${same}")
    set(CPACK_DEBIAN_EXPLORER_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_LIST_DIR}/triggers)
    set(CPACK_DEBIAN_EXPLORER_PACKAGE_RECOMMENDS "fonts-open-sans")
endif()
include(CPack)
