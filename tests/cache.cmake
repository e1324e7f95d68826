# Compiled programs kept on disk.
tl_test(test_program_cache unit tl_cache)
tl_test(test_program_key device tl_lighting)
tl_test(test_program_stale device tl_lighting)
foreach(call clCreateProgramWithSource clCreateProgramWithBinary)
    target_link_options(test_program_stale PRIVATE -Wl,--wrap=${call})
endforeach()

# What a frame costs once one like it was lit. The linker leads calls through the test's counters.
tl_test(test_steady_state device tl_lighting)
target_compile_options(test_steady_state PRIVATE -fno-builtin)
foreach(call malloc calloc realloc aligned_alloc posix_memalign clCreateBuffer clCreateKernel
             clCreateProgramWithSource clCreateProgramWithBinary clEnqueueReadBuffer
             clEnqueueReadBufferRect clEnqueueWriteBuffer clEnqueueWriteBufferRect
             clEnqueueCopyBuffer clEnqueueFillBuffer clEnqueueMapBuffer clEnqueueNDRangeKernel)
    target_link_options(test_steady_state PRIVATE -Wl,--wrap=${call})
endforeach()
