# Does a project outside find an installed tilelight and test its kernel with it, a wrong one too?
# Run as a script: cmake -DBUILD=<build folder> -DKERNEL=<plain.cl> -DSCRATCH=<folder> -P <this>
function(run expected)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE out ERROR_VARIABLE out)
    if(NOT result EQUAL expected)
        message(FATAL_ERROR "${ARGN}\nended with ${result}, not ${expected}:\n${out}")
    endif()
endfunction()

file(REMOVE_RECURSE ${SCRATCH})
file(COPY ${CMAKE_CURRENT_LIST_DIR}/CMakeLists.txt DESTINATION ${SCRATCH}/project)
file(COPY_FILE ${KERNEL} ${SCRATCH}/project/my_kernel.cl)
run(0 ${CMAKE_COMMAND} --install ${BUILD} --prefix ${SCRATCH}/prefix)
run(0 ${CMAKE_COMMAND} -S ${SCRATCH}/project -B ${SCRATCH}/build
    -DCMAKE_PREFIX_PATH=${SCRATCH}/prefix)
run(0 ${CMAKE_CTEST_COMMAND} --test-dir ${SCRATCH}/build)

file(READ ${KERNEL} text)
string(REPLACE "radiance[at] = out.x" "radiance[at] = out.y" wrong "${text}")
if(wrong STREQUAL text)
    message(FATAL_ERROR "nothing was made wrong")
endif()
file(WRITE ${SCRATCH}/project/my_kernel.cl "${wrong}")
run(8 ${CMAKE_CTEST_COMMAND} --test-dir ${SCRATCH}/build)
