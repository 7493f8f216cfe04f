# Finds an OpenUSD of any version from 20.08 up and hides how it was built.
#
#   find_package(OpenUSD 20.08 REQUIRED)          with -Dpxr_ROOT=<install prefix> (or the environment variable pxr_ROOT)
#
# Targets:   OpenUSD::hydra    what a render delegate links: hd, hf, cameraUtil, pxOsd, ar, sdf, vt, gf, work, plug, trace, tf, arch
#            OpenUSD::imaging  hydra plus what a host without a window links: usd, usdGeom, usdShade, usdImaging and friends
#            OpenUSD::registry hydra plus the shader registry, sdr and ndr (not from 25.05 on, which has one library)
# Variables: OpenUSD_VERSION, OpenUSD_PREFIX, OpenUSD_PYTHON (built with Python support), OpenUSD_HAS_IMAGING
#
# Three kinds of install are understood: one that exports working CMake targets (pxrConfig.cmake), a monolithic library
# without targets (usd_ms, usd_m), and plain lib[usd_]<name> libraries, even when only some of them are there.
set(_usd_hydra_libs hd hf cameraUtil pxOsd ar sdf vt gf work plug trace tf arch)
set(_usd_imaging_libs usdImaging usdVolImaging usdSkelImaging usdSkel usdVol usdRender usdLux usdShade usdGeom usdUtils
    usd pcp kind)

set(_usd_hints ${pxr_ROOT} $ENV{pxr_ROOT} ${OpenUSD_ROOT} ${pxr_DIR})
# Another prefix in the same build tree: what was found below the old one is of no use.
if(DEFINED OpenUSD_SEARCHED AND NOT "${OpenUSD_SEARCHED}" STREQUAL "${_usd_hints}")
    get_cmake_property(_usd_cached CACHE_VARIABLES)
    list(FILTER _usd_cached INCLUDE REGEX "^OpenUSD_.*_(DIR|LIBRARY)$")
    foreach(_variable ${_usd_cached})
        unset(${_variable} CACHE)
    endforeach()
endif()
set(OpenUSD_SEARCHED "${_usd_hints}" CACHE INTERNAL "Prefixes of the last search for OpenUSD")
# _usd_defined(<out> <macro>): whether pxr.h defines it; the define may stand below an "#if 0".
function(_usd_defined out macro)
    set(defined FALSE)
    if("${_usd_defines}" MATCHES "#if ([^\n]*)\n#define ${macro}\n")
        set(defined ${CMAKE_MATCH_1})
    elseif("${_usd_defines}" MATCHES "#define ${macro}\n")
        set(defined TRUE)
    endif()
    set(${out} ${defined} PARENT_SCOPE)
endfunction()

find_path(OpenUSD_INCLUDE_DIR pxr/pxr.h HINTS ${_usd_hints} PATH_SUFFIXES include
          DOC "Folder that holds pxr/pxr.h of OpenUSD")
mark_as_advanced(OpenUSD_INCLUDE_DIR)

set(_usd_advice "Give an OpenUSD install (20.08 or newer, with imaging) as -Dpxr_ROOT=<prefix>, let `./hipr setup` build one, \
or configure with -DHIPR_BUILD_PLUGIN=OFF for the renderer alone.")
set(_usd_failure "")
if(OpenUSD_INCLUDE_DIR)
    get_filename_component(OpenUSD_PREFIX ${OpenUSD_INCLUDE_DIR} DIRECTORY)
    file(READ ${OpenUSD_INCLUDE_DIR}/pxr/pxr.h _usd_defines)
    if("${_usd_defines}" MATCHES "#define PXR_VERSION ([0-9]+)([0-9][0-9])\n")
        set(OpenUSD_VERSION ${CMAKE_MATCH_1}.${CMAKE_MATCH_2})
    endif()
    _usd_defined(OpenUSD_PYTHON PXR_PYTHON_SUPPORT_ENABLED)
    _usd_defined(_usd_own_boost PXR_USE_INTERNAL_BOOST_PYTHON)
else()
    set(_usd_failure "No pxr/pxr.h below pxr_ROOT='${pxr_ROOT}'. ${_usd_advice}")
endif()

# Exported targets, when the install has a complete set of them: their libraries must exist, or CMake would stop here.
set(_usd_config FALSE)
if(OpenUSD_PREFIX AND EXISTS ${OpenUSD_PREFIX}/pxrConfig.cmake AND EXISTS ${OpenUSD_PREFIX}/cmake/pxrTargets.cmake)
    set(_usd_config TRUE)
    file(GLOB _usd_target_files ${OpenUSD_PREFIX}/cmake/pxrTargets-*.cmake)
    foreach(_file ${_usd_target_files})
        file(STRINGS ${_file} _locations REGEX "IMPORTED_LOCATION")
        foreach(_line ${_locations})
            if(_line MATCHES "\"\\\${_IMPORT_PREFIX}/([^\"]+)\"" AND NOT EXISTS ${OpenUSD_PREFIX}/${CMAKE_MATCH_1})
                set(_usd_config FALSE)
            endif()
        endforeach()
    endforeach()
endif()
if(_usd_config)
    # OpenUSD's config knows nothing of the packages its targets name in their link lines.
    find_package(pxr CONFIG QUIET PATHS ${OpenUSD_PREFIX} NO_DEFAULT_PATH)
endif()

# _usd_resolve(<out> <names>...): link items for OpenUSD libraries; names that are absent go to <out>_MISSING.
function(_usd_resolve out)
    set(items)
    set(missing)
    foreach(whole usd_ms usd_m)
        if(TARGET ${whole})
            set(items ${whole})
        elseif(OpenUSD_PREFIX AND NOT items)
            find_library(OpenUSD_${whole}_LIBRARY ${whole} PATHS ${OpenUSD_PREFIX}/lib ${OpenUSD_PREFIX}/lib64
                         NO_DEFAULT_PATH)
            mark_as_advanced(OpenUSD_${whole}_LIBRARY)
            if(OpenUSD_${whole}_LIBRARY)
                set(items ${OpenUSD_${whole}_LIBRARY})
            endif()
        endif()
    endforeach()
    if(NOT items)
        foreach(name ${ARGN})
            if(TARGET ${name})
                list(APPEND items ${name})
                continue()
            endif()
            find_library(OpenUSD_${name}_LIBRARY NAMES usd_${name} ${name} PATHS ${OpenUSD_PREFIX}/lib
                         ${OpenUSD_PREFIX}/lib64 NO_DEFAULT_PATH)
            mark_as_advanced(OpenUSD_${name}_LIBRARY)
            if(OpenUSD_${name}_LIBRARY)
                list(APPEND items ${OpenUSD_${name}_LIBRARY})
            else()
                list(APPEND missing ${name})
            endif()
        endforeach()
    endif()
    set(${out} ${items} PARENT_SCOPE)
    set(${out}_MISSING ${missing} PARENT_SCOPE)
endfunction()

set(OpenUSD_HAS_IMAGING FALSE)
if(NOT _usd_failure)
    if(OpenUSD_VERSION VERSION_GREATER_EQUAL 22.08)
        list(APPEND _usd_hydra_libs hdsi) # scene indices that renderers share
    endif()
    _usd_resolve(_usd_hydra ${_usd_hydra_libs})
    _usd_resolve(_usd_imaging ${_usd_imaging_libs})
    if(_usd_hydra_MISSING)
        set(_usd_failure "OpenUSD ${OpenUSD_VERSION} in ${OpenUSD_PREFIX} lacks the libraries: ${_usd_hydra_MISSING}. \
It may have been built without imaging (PXR_BUILD_IMAGING). ${_usd_advice}")
    elseif(NOT _usd_imaging_MISSING)
        set(OpenUSD_HAS_IMAGING TRUE)
    endif()
endif()

# What OpenUSD's public headers include: TBB always (its own copy first), boost up to 24.03 and in the Python bindings up
# to 24.08 (later ones carry their own), Python when built with it.
set(_usd_includes ${OpenUSD_INCLUDE_DIR})
set(_usd_extra)
if(NOT _usd_failure)
    find_path(OpenUSD_TBB_INCLUDE_DIR tbb/blocked_range.h HINTS ${OpenUSD_INCLUDE_DIR})
    find_library(OpenUSD_TBB_LIBRARY tbb HINTS ${OpenUSD_PREFIX}/lib ${OpenUSD_PREFIX}/lib64)
    mark_as_advanced(OpenUSD_TBB_INCLUDE_DIR OpenUSD_TBB_LIBRARY)
    if(NOT OpenUSD_TBB_INCLUDE_DIR OR NOT OpenUSD_TBB_LIBRARY)
        set(_usd_failure "OpenUSD needs TBB: neither ${OpenUSD_PREFIX} nor the system has its headers and library \
(Debian: libtbb-dev).")
    else()
        list(APPEND _usd_includes ${OpenUSD_TBB_INCLUDE_DIR})
        list(APPEND _usd_extra ${OpenUSD_TBB_LIBRARY})
    endif()
    if(OpenUSD_VERSION VERSION_LESS 24.05 OR (OpenUSD_PYTHON AND NOT _usd_own_boost))
        find_path(OpenUSD_BOOST_INCLUDE_DIR boost/version.hpp HINTS ${OpenUSD_INCLUDE_DIR}
                  PATH_SUFFIXES boost-1_70 boost-1_76 boost-1_78)
        mark_as_advanced(OpenUSD_BOOST_INCLUDE_DIR)
        if(OpenUSD_BOOST_INCLUDE_DIR)
            list(APPEND _usd_includes ${OpenUSD_BOOST_INCLUDE_DIR})
        else()
            set(_usd_failure "The headers of OpenUSD ${OpenUSD_VERSION} need boost (Debian: libboost-dev).")
        endif()
    endif()
    if(OpenUSD_PYTHON)
        # Not find_package(Python3): the interpreter of the shell may have no headers and need not be OpenUSD's.
        find_path(OpenUSD_PYTHON_INCLUDE_DIR Python.h HINTS ${OpenUSD_INCLUDE_DIR} ${Python3_ROOT_DIR}/include
                  PATH_SUFFIXES python3.7m python3.8 python3.9 python3.10 python3.11 python3.12 python3.13 python3.14)
        mark_as_advanced(OpenUSD_PYTHON_INCLUDE_DIR)
        if(OpenUSD_PYTHON_INCLUDE_DIR)
            list(APPEND _usd_includes ${OpenUSD_PYTHON_INCLUDE_DIR})
            # Inline functions of VtValue call both libraries: programs (not modules) must name them to the linker.
            get_filename_component(_usd_python ${OpenUSD_PYTHON_INCLUDE_DIR} NAME)
            string(REGEX REPLACE "[^0-9]" "" _usd_python_digits ${_usd_python})
            find_library(OpenUSD_PYTHON_LIBRARY ${_usd_python} HINTS ${OpenUSD_PREFIX}/lib)
            mark_as_advanced(OpenUSD_PYTHON_LIBRARY OpenUSD_BOOST_PYTHON_LIBRARY)
            set(_usd_bindings ${OpenUSD_PYTHON_LIBRARY})
            if(NOT _usd_own_boost)
                find_library(OpenUSD_BOOST_PYTHON_LIBRARY boost_python${_usd_python_digits} HINTS ${OpenUSD_PREFIX}/lib)
                list(APPEND _usd_bindings ${OpenUSD_BOOST_PYTHON_LIBRARY})
            endif()
            foreach(_library ${_usd_bindings})
                if(_library)
                    list(APPEND _usd_extra ${_library})
                endif()
            endforeach()
        else()
            set(_usd_failure "This OpenUSD was built with Python, whose headers its own headers include (Debian: \
python3-dev).")
        endif()
    endif()
endif()

include(FindPackageHandleStandardArgs)
if(_usd_failure)
    set(OpenUSD_FOUND FALSE)
    find_package_handle_standard_args(OpenUSD REQUIRED_VARS OpenUSD_READY VERSION_VAR OpenUSD_VERSION
                                      REASON_FAILURE_MESSAGE "${_usd_failure}")
else()
    set(OpenUSD_READY TRUE)
    find_package_handle_standard_args(OpenUSD REQUIRED_VARS OpenUSD_PREFIX OpenUSD_READY VERSION_VAR OpenUSD_VERSION
                                      REASON_FAILURE_MESSAGE "${_usd_advice}")
endif()

if(OpenUSD_FOUND AND NOT TARGET OpenUSD::hydra)
    add_library(OpenUSD::hydra INTERFACE IMPORTED)
    target_include_directories(OpenUSD::hydra SYSTEM INTERFACE ${_usd_includes})
    target_link_libraries(OpenUSD::hydra INTERFACE ${_usd_hydra} ${_usd_extra})
    # Old boost, old TBB and old hash containers announce their age on every include.
    target_compile_definitions(OpenUSD::hydra INTERFACE BOOST_BIND_GLOBAL_PLACEHOLDERS BOOST_ALLOW_DEPRECATED_HEADERS
                               TBB_SUPPRESS_DEPRECATED_MESSAGES=1)
    target_compile_options(OpenUSD::hydra INTERFACE -Wno-deprecated)
    if(OpenUSD_HAS_IMAGING)
        add_library(OpenUSD::imaging INTERFACE IMPORTED)
        target_link_libraries(OpenUSD::imaging INTERFACE OpenUSD::hydra ${_usd_imaging})
    endif()
    _usd_resolve(_usd_registry sdr ndr)
    if(NOT _usd_registry_MISSING)
        add_library(OpenUSD::registry INTERFACE IMPORTED)
        target_link_libraries(OpenUSD::registry INTERFACE OpenUSD::hydra ${_usd_registry})
    endif()
endif()
