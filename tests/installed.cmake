# What an installation brings, as others use it.
find_package(Python3 REQUIRED COMPONENTS Interpreter)
set(outside ${CMAKE_CURRENT_SOURCE_DIR}/outside)
set(scratch ${CMAKE_BINARY_DIR}/scratch)

# Whoever builds but the program and a test has what is installed beside them built for these.
add_test(NAME installed_is_built
         COMMAND ${CMAKE_COMMAND} --build ${CMAKE_BINARY_DIR} --target tilelight tl_help_files
                 $<TARGET_NAME_IF_EXISTS:tl_library>)
set_tests_properties(installed_is_built PROPERTIES FIXTURES_SETUP installed LABELS unit)

add_test(NAME help_files
         COMMAND ${Python3_EXECUTABLE} ${outside}/help_files.py $<TARGET_FILE:tilelight>
                 ${TILELIGHT_HELP_FILES} ${scratch}/help)
tl_test_properties(help_files command)

if(TILELIGHT_LIGHTING)
    add_test(NAME library_installed
             COMMAND ${CMAKE_COMMAND} -DBUILD=${CMAKE_BINARY_DIR} -DCC=${CMAKE_C_COMPILER}
                     -DGBUFFER=${CMAKE_CURRENT_SOURCE_DIR}/golden/hall.gbuffer.exr
                     -DLIBDIR=${CMAKE_INSTALL_LIBDIR} -DSCRATCH=${scratch}/library
                     -P ${outside}/library.cmake)
    tl_test_properties(library_installed device)
    set_tests_properties(library_installed PROPERTIES SKIP_REGULAR_EXPRESSION "no OpenCL device found")
    add_test(NAME public_headers
             COMMAND ${Python3_EXECUTABLE} ${outside}/public_headers.py ${CMAKE_BINARY_DIR}
                     ${CMAKE_C_COMPILER} ${CMAKE_CXX_COMPILER} $<TARGET_FILE:tl_library> ${scratch}/headers)
    tl_test_properties(public_headers unit)
endif()

foreach(name help_files library_installed public_headers kernel_check_installed)
    if(TEST ${name})
        set_tests_properties(${name} PROPERTIES FIXTURES_REQUIRED installed)
    endif()
endforeach()
