# Does a program outside, built by pkg-config and by CMake, light a G-buffer with the installed library to the
# bits of the installed command?
# Run as a script: cmake -DBUILD=<build folder> -DCC=<compiler> -DGBUFFER=<G.exr> -DLIBDIR=<libraries in the
#     prefix> -DSCRATCH=<folder> -P <this>
cmake_minimum_required(VERSION 3.22)
set(source ${CMAKE_CURRENT_LIST_DIR}/../../docs/library)
set(prefix ${SCRATCH}/prefix)

function(run)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE out ERROR_VARIABLE out)
    if(NOT result EQUAL 0)
        message(FATAL_ERROR "${ARGN}\nended with ${result}:\n${out}")
    endif()
endfunction()

# Usage: light(NAME COMMAND...): the bits of the command, under NAME.exr
function(light name)
    run(${ARGN} ${GBUFFER} ${SCRATCH}/${name}.exr)
    run(${CMAKE_COMMAND} -E compare_files ${SCRATCH}/command.exr ${SCRATCH}/${name}.exr)
endfunction()

file(REMOVE_RECURSE ${SCRATCH})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
run(${prefix}/bin/tilelight light ${GBUFFER} -o ${SCRATCH}/command.exr)

run(${CMAKE_COMMAND} -S ${source} -B ${SCRATCH}/build -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_C_COMPILER=${CC})
run(${CMAKE_COMMAND} --build ${SCRATCH}/build)
light(by-cmake ${SCRATCH}/build/light)

set(ENV{PKG_CONFIG_PATH} ${prefix}/${LIBDIR}/pkgconfig)
execute_process(COMMAND pkg-config --cflags --libs tilelight OUTPUT_VARIABLE flags
                OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
separate_arguments(flags)
run(${CC} -std=c11 -Wall -Wextra -Wpedantic -Werror -o ${SCRATCH}/light ${source}/light.c ${flags})
light(by-pkg-config ${CMAKE_COMMAND} -E env LD_LIBRARY_PATH=${prefix}/${LIBDIR} ${SCRATCH}/light)
