# OpenVDB::openvdb from the header and the library: the module that comes with OpenVDB wants all its dependencies'
# development files, which its headers do not need.
find_path(OpenVDB_INCLUDE_DIR openvdb/openvdb.h)
find_library(OpenVDB_LIBRARY openvdb)
include(FindPackageHandleStandardArgs)
find_library(OpenVDB_Imath_LIBRARY NAMES Imath Imath-3_1) # its half is in OpenVDB's headers
find_package_handle_standard_args(OpenVDB REQUIRED_VARS OpenVDB_LIBRARY OpenVDB_INCLUDE_DIR OpenVDB_Imath_LIBRARY)
if(OpenVDB_FOUND AND NOT TARGET OpenVDB::openvdb)
    add_library(OpenVDB::openvdb UNKNOWN IMPORTED)
    set_target_properties(OpenVDB::openvdb PROPERTIES
        IMPORTED_LOCATION ${OpenVDB_LIBRARY}
        INTERFACE_INCLUDE_DIRECTORIES ${OpenVDB_INCLUDE_DIR}
        INTERFACE_LINK_LIBRARIES "TBB::tbb;${OpenVDB_Imath_LIBRARY}")
endif()
