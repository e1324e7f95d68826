# The kernels of docs/your-kernel.md, checked as the page says, and the page itself.
include(${PROJECT_SOURCE_DIR}/cmake/TilelightKernelCheck.cmake)

set(kernels ${PROJECT_SOURCE_DIR}/docs/kernels)
tilelight_add_kernel_check(kernel_plain ${kernels}/plain.cl ENTRY plain)
tilelight_add_kernel_check(kernel_with_headers ${kernels}/with_headers.cl ENTRY shade_in_batches ITEMS pixel
                           ARGS --frame mixed --frame metal --frame orthographic --frame unlit)
tilelight_add_kernel_check(kernel_faulty_fails ${kernels}/faulty.cl ENTRY faulty ITEMS pixel
                           ARGS --frame spheres)
set_tests_properties(kernel_faulty_fails PROPERTIES WILL_FAIL ON)
tilelight_add_kernel_check(kernel_faulty_is_named ${kernels}/faulty.cl ENTRY faulty ITEMS pixel
                           ARGS --frame spheres)
set_tests_properties(kernel_faulty_is_named PROPERTIES PASS_REGULAR_EXPRESSION
    "faulty.cl: [0-9]+ of 5917 pixels are out of tolerance, in 1 of 1 frames")

add_test(NAME kernel_check_installed
         COMMAND ${CMAKE_COMMAND} -DBUILD=${CMAKE_BINARY_DIR} -DKERNEL=${kernels}/plain.cl
                 -DSCRATCH=${CMAKE_BINARY_DIR}/scratch/installed
                 -P ${CMAKE_CURRENT_SOURCE_DIR}/outside/check.cmake)

foreach(name kernel_plain kernel_with_headers kernel_faulty_fails kernel_faulty_is_named
             kernel_check_installed)
    tl_test_properties(${name} device)
    set_tests_properties(${name} PROPERTIES SKIP_REGULAR_EXPRESSION "no OpenCL device found")
endforeach()

tl_test(test_kernel_page device tl_frame)
tl_test(test_command_check device tl_base)
add_dependencies(test_kernel_page tilelight)
add_dependencies(test_command_check tilelight)
