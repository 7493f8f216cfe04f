# Divides the installation into two components, so that rendering need not wait for Python, Storm and usdview:
#   core  the libraries in HIPR_CORE_LIBRARIES with their headers and resources
#   full  all else
# OpenUSD 20.08 names no components; every install() call of its CMake files passes through here.
macro(install)
    get_filename_component(hipr_here "${CMAKE_CURRENT_SOURCE_DIR}" NAME)
    set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME full)
    if("${ARGV0}" STREQUAL "TARGETS")
        if(";${HIPR_CORE_LIBRARIES};" MATCHES ";${ARGV1};")
            set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME core)
        endif()
    elseif("${ARGN}" MATCHES "include/pxr|lib/usd;|plugin/usd;")
        # pxr.h and the two files at the top that include all plugInfo.json below them
        set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME core)
    elseif("${ARGV0}" STREQUAL "FILES" AND ";${HIPR_CORE_LIBRARIES};" MATCHES ";${hipr_here};"
           AND NOT "${ARGN}" MATCHES "lib/python")
        set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME core)
    endif()
    _install(${ARGN})
endmacro()
