# OpenSubdiv's CPU library as OpenSubdiv::osdCPU. A module of our own because Debian's package config names static
# libraries that the package does not hold.
find_path(OpenSubdiv_INCLUDE_DIR opensubdiv/version.h)
find_library(OpenSubdiv_CPU_LIBRARY osdCPU)
if(OpenSubdiv_INCLUDE_DIR)
    file(STRINGS ${OpenSubdiv_INCLUDE_DIR}/opensubdiv/version.h version_line
         REGEX "#define[ \t]+OPENSUBDIV_VERSION_NUMBER[ \t]+[0-9]+")
    string(REGEX REPLACE ".*[ \t]([0-9]+)([0-9][0-9])([0-9][0-9])$" "\\1.\\2.\\3" OpenSubdiv_VERSION "${version_line}")
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenSubdiv REQUIRED_VARS OpenSubdiv_CPU_LIBRARY OpenSubdiv_INCLUDE_DIR
                                  VERSION_VAR OpenSubdiv_VERSION)
if(OpenSubdiv_FOUND AND NOT TARGET OpenSubdiv::osdCPU)
    add_library(OpenSubdiv::osdCPU UNKNOWN IMPORTED)
    set_target_properties(OpenSubdiv::osdCPU PROPERTIES IMPORTED_LOCATION ${OpenSubdiv_CPU_LIBRARY}
                          INTERFACE_INCLUDE_DIRECTORIES ${OpenSubdiv_INCLUDE_DIR})
endif()
mark_as_advanced(OpenSubdiv_INCLUDE_DIR OpenSubdiv_CPU_LIBRARY)
