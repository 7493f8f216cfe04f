# hipr_compile_shaders(<target> SHADERS <file under shaders/>[:NAME[:DEFINE,DEFINE...]]>...)
#
# Compiles GLSL compute shaders to SPIR-V with glslangValidator and embeds them in a static library <target>. Each
# kernel becomes `const uint32_t NAME_spv[]` and `NAME_spv_size` (bytes) in namespace hipr::spirv, declared in
# <target>.h. One file may be listed several times with other names and defines.
find_program(HIPR_GLSLANG glslangValidator REQUIRED)
find_program(HIPR_SPIRV_OPT spirv-opt REQUIRED)
set(HIPR_EMBED_SPIRV ${CMAKE_CURRENT_LIST_DIR}/EmbedSpirv.cmake)

function(hipr_compile_shaders target)
    cmake_parse_arguments(ARG "" "" "SHADERS" ${ARGN})
    set(out ${CMAKE_BINARY_DIR}/generated/${target})
    file(MAKE_DIRECTORY ${out})
    set(header "// Generated. Embedded SPIR-V kernels.\n#pragma once\n#include <cstddef>\n#include <cstdint>\nnamespace hipr::spirv {\n")
    set(sources)
    foreach(entry ${ARG_SHADERS})
        string(REPLACE ":" ";" parts "${entry}")
        list(GET parts 0 file)
        list(LENGTH parts n)
        get_filename_component(name ${file} NAME_WE)
        set(defines)
        if(n GREATER 1)
            list(GET parts 1 name)
        endif()
        if(n GREATER 2)
            list(GET parts 2 defineText)
            string(REPLACE "," ";" defineList "${defineText}")
            foreach(d ${defineList})
                list(APPEND defines -D${d})
            endforeach()
        endif()
        set(inc ${out}/${name}.inc)
        set(spirv ${out}/${name}.spv)
        add_custom_command(
            OUTPUT ${spirv}
            COMMAND ${HIPR_GLSLANG} -V --target-env vulkan1.2 -I${CMAKE_SOURCE_DIR}/shaders ${defines}
                    --quiet --depfile ${spirv}.d -o ${spirv} ${CMAKE_SOURCE_DIR}/shaders/${file}
            DEPENDS ${CMAKE_SOURCE_DIR}/shaders/${file}
            DEPFILE ${spirv}.d
            COMMENT "Compiling kernel ${name}" VERBATIM)
        add_custom_command(
            OUTPUT ${inc}
            COMMAND ${CMAKE_COMMAND} -DSPIRV_OPT=${HIPR_SPIRV_OPT} -DINPUT=${spirv} -DOUTPUT=${inc} -P ${HIPR_EMBED_SPIRV}
            DEPENDS ${spirv} ${HIPR_EMBED_SPIRV}
            COMMENT "Optimizing kernel ${name}" VERBATIM)
        set(cpp ${out}/${name}.cpp)
        file(GENERATE OUTPUT ${cpp} CONTENT
"#include \"${target}.h\"
namespace hipr::spirv {
const uint32_t ${name}_spv[] = {
#include \"${name}.inc\"
};
const size_t ${name}_spv_size = sizeof(${name}_spv);
}
")
        set_source_files_properties(${cpp} PROPERTIES OBJECT_DEPENDS ${inc})
        list(APPEND sources ${cpp})
        string(APPEND header "extern const uint32_t ${name}_spv[];\nextern const size_t ${name}_spv_size;\n")
    endforeach()
    string(APPEND header "}\n")
    file(GENERATE OUTPUT ${out}/${target}.h CONTENT "${header}")
    add_library(${target} STATIC ${sources})
    target_include_directories(${target} PUBLIC ${out})
    set_target_properties(${target} PROPERTIES CXX_STANDARD 17)
endfunction()
