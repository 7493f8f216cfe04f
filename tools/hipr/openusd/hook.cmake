# Read by OpenUSD's own CMakeLists.txt right after project(), through CMAKE_PROJECT_INCLUDE, so that its CMake
# files stay as they are.
include_guard(GLOBAL)
cmake_policy(PUSH)
cmake_policy(VERSION 3.19)

include("${CMAKE_CURRENT_LIST_DIR}/components.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/precompiled.cmake")

function(hipr_collect_targets directory out)
    get_property(targets DIRECTORY "${directory}" PROPERTY BUILDSYSTEM_TARGETS)
    get_property(children DIRECTORY "${directory}" PROPERTY SUBDIRECTORIES)
    foreach(child IN LISTS children)
        hipr_collect_targets("${child}" found)
        list(APPEND targets ${found})
    endforeach()
    set(${out} "${targets}" PARENT_SCOPE)
endfunction()

# Runs when all of OpenUSD's targets are there.
function(hipr_finish)
    hipr_collect_targets("${CMAKE_SOURCE_DIR}" targets)
    hipr_precompile("${targets}")
    foreach(target IN LISTS targets)
        # TBB is installed beside the libraries, which find it through $ORIGIN: no path of this machine goes in.
        set_target_properties(${target} PROPERTIES INSTALL_RPATH_USE_LINK_PATH FALSE)
    endforeach()
    # Or the precompiled headers would hold the source tree's headers, and all else read the build tree's copies.
    set(CMAKE_INCLUDE_CURRENT_DIR OFF PARENT_SCOPE)
endfunction()

cmake_language(DEFER DIRECTORY "${CMAKE_SOURCE_DIR}" CALL hipr_finish)
cmake_policy(POP)
