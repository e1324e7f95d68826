# Shading kernels of one's own, checked as tests: docs/your-kernel.md.
#
#   tilelight_add_kernel_check(NAME kernel.cl ENTRY kernel [ITEMS tile|pixel] [ARGS option...])
#
# adds the test NAME, which runs `tilelight check' on the file: it lights frames with the kernel and
# fails where a pixel is out of tolerance, the file does not compile, or no OpenCL device is there.
# ARGS are further options of the command, such as `--frame spheres'. The program is this build's, else
# TILELIGHT_PROGRAM, else looked for.
function(tilelight_add_kernel_check name file)
    cmake_parse_arguments(PARSE_ARGV 2 check "" "ENTRY;ITEMS" "ARGS")
    if(check_UNPARSED_ARGUMENTS)
        message(FATAL_ERROR "tilelight_add_kernel_check(${name}): \"${check_UNPARSED_ARGUMENTS}\" "
                            "is none of ENTRY, ITEMS, ARGS")
    endif()
    if(NOT check_ENTRY)
        message(FATAL_ERROR "tilelight_add_kernel_check(${name}): ENTRY is missing: the name of "
                            "the kernel in ${file}")
    endif()
    get_filename_component(path ${file} ABSOLUTE)
    if(NOT EXISTS ${path})
        message(FATAL_ERROR "tilelight_add_kernel_check(${name}): there is no ${path}")
    endif()
    if(TARGET tilelight)
        set(program $<TARGET_FILE:tilelight>)
    else()
        find_program(TILELIGHT_PROGRAM tilelight REQUIRED)
        set(program ${TILELIGHT_PROGRAM})
    endif()
    set(items "")
    if(check_ITEMS)
        set(items --items ${check_ITEMS})
    endif()
    add_test(NAME ${name} COMMAND ${program} check --kernel ${path} --entry ${check_ENTRY}
             ${items} ${check_ARGS})
endfunction()
