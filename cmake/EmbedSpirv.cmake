# cmake -DSPIRV_OPT=<spirv-opt> -DINPUT=<file.spv> -DOUTPUT=<file.inc> -P EmbedSpirv.cmake
#
# Inlines functions and takes structs apart, and writes the words as text for an initializer. Drivers turn SPIR-V into a
# form of their own whenever a process starts, whatever their caches hold; without all the copies of arguments that takes
# half as long (docs/measurements.md).
execute_process(
    COMMAND ${SPIRV_OPT} --target-env=vulkan1.2 --scalar-block-layout --eliminate-dead-branches
            --inline-entry-points-exhaustive --eliminate-dead-functions --private-to-local --scalar-replacement=0
            --ssa-rewrite --eliminate-dead-code-aggressive --ccp --eliminate-dead-branches --simplify-instructions
            --eliminate-dead-code-aggressive ${INPUT} -o ${OUTPUT}.opt
    RESULT_VARIABLE result
    OUTPUT_VARIABLE messages # it warns of every function that has to stay one
    ERROR_VARIABLE messages)
if(NOT result EQUAL 0)
    message(FATAL_ERROR "spirv-opt failed for ${INPUT}: ${messages}")
endif()
file(READ ${OUTPUT}.opt words HEX)
file(REMOVE ${OUTPUT}.opt)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1,\n" words "${words}")
file(WRITE ${OUTPUT} "${words}")
