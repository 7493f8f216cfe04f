# OpenImageIO::OpenImageIO by headers and libraries: the package file of some distributions names include folders of
# packages that need not be installed.
find_path(OpenImageIO_INCLUDE_DIR OpenImageIO/imageio.h)
find_library(OpenImageIO_LIBRARY OpenImageIO)
find_library(OpenImageIO_UTIL_LIBRARY OpenImageIO_Util)
if(OpenImageIO_INCLUDE_DIR)
    foreach(part MAJOR MINOR)
        file(STRINGS ${OpenImageIO_INCLUDE_DIR}/OpenImageIO/oiioversion.h line REGEX "define OIIO_VERSION_${part} ")
        string(REGEX REPLACE ".* ([0-9]+).*" "\\1" version_${part} "${line}")
    endforeach()
    set(OpenImageIO_VERSION ${version_MAJOR}.${version_MINOR})
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenImageIO
    REQUIRED_VARS OpenImageIO_LIBRARY OpenImageIO_UTIL_LIBRARY OpenImageIO_INCLUDE_DIR
    VERSION_VAR OpenImageIO_VERSION)
if(OpenImageIO_FOUND AND NOT TARGET OpenImageIO::OpenImageIO)
    add_library(OpenImageIO::OpenImageIO INTERFACE IMPORTED)
    target_include_directories(OpenImageIO::OpenImageIO INTERFACE ${OpenImageIO_INCLUDE_DIR})
    target_link_libraries(OpenImageIO::OpenImageIO INTERFACE ${OpenImageIO_LIBRARY} ${OpenImageIO_UTIL_LIBRARY})
endif()
