# Precompiled headers.  Parsing headers is four fifths of the compile time of this code base; OpenUSD's own
# precompiled headers are one per library (about a hundred, each with Boost.Python in it), which costs more than
# it saves.  Few shared ones do better:
#   level 0  third-party headers only                   for the libraries of pxr/base
#   level 1  + the headers of pxr/base                  for pxr/usd up to `usd`, pxr/imaging, Python modules of base
#   level 2  + ar, sdf, pcp and usd                     for the schema libraries, usdImaging and their modules
# and a narrow one for two Python modules that do not stand all of Boost.Python.
# A library never gets a header that holds its own API macros: those differ inside and outside of it.
set(HIPR_PCH_DIR "${CMAKE_CURRENT_LIST_DIR}")

function(hipr_add_precompiled level header dependencies)
    set(name hipr_precompiled_${level})
    file(CONFIGURE OUTPUT "${CMAKE_BINARY_DIR}/${name}.cpp" CONTENT "// Carries the precompiled header.\n")
    add_library(${name} OBJECT "${CMAKE_BINARY_DIR}/${name}.cpp")
    set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_include_directories(${name} PRIVATE "${CMAKE_BINARY_DIR}/include")
    target_include_directories(${name} SYSTEM PRIVATE ${TBB_INCLUDE_DIRS} ${PYTHON_INCLUDE_DIRS})
    target_link_libraries(${name} PRIVATE ${Boost_PYTHON_LIBRARY})
    target_compile_definitions(${name} PRIVATE PXR_PYTHON_ENABLED=1)
    target_precompile_headers(${name} PRIVATE "${HIPR_PCH_DIR}/${header}")
    foreach(library IN LISTS dependencies)
        add_dependencies(${name} ${library}_headerfiles)
    endforeach()
endfunction()

function(hipr_precompile targets)
    set(base tf gf js trace work plug vt)
    set(core ar kind sdf ndr sdr pcp usd)
    hipr_add_precompiled(0 level0.h "arch")
    hipr_add_precompiled(1 level1.h "arch;${base}")
    hipr_add_precompiled(2 level2.h "arch;${base};${core}")
    hipr_add_precompiled(narrow narrow.h "arch;${base}")
    foreach(target IN LISTS targets)
        get_target_property(type ${target} TYPE)
        get_target_property(source ${target} SOURCE_DIR)
        if(NOT type STREQUAL "SHARED_LIBRARY" OR target STREQUAL "arch")
            continue()
        endif()
        string(REGEX REPLACE "^_" "" library "${target}")
        if(target IN_LIST base)
            set(level 0)
        elseif(target STREQUAL "_gf" OR target STREQUAL "_pxOsd")
            set(level narrow)
        elseif(library IN_LIST base OR target IN_LIST core)
            set(level 1)
        elseif(source MATCHES "/pxr/(usd|usdImaging)/")
            set(level 2)
        else()
            set(level 1)
        endif()
        target_precompile_headers(${target} REUSE_FROM hipr_precompiled_${level})
    endforeach()
endfunction()
