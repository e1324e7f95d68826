# Fails unless a kernel, compiled for one layout, is done with the table of layouts: cmake -P with
#
#   LAYOUT   the layout's number
#   COMPILE  the compiler and its options, a list; SOURCE the kernel
#   OUT      where the compiled text may stand
execute_process(COMMAND ${COMPILE} -D TL_LAYOUT=${LAYOUT} -o ${OUT} ${SOURCE}
                COMMAND_ERROR_IS_FATAL ANY)
file(STRINGS ${OUT} uses REGEX "@tl_layouts")
list(FILTER uses EXCLUDE REGEX "^@tl_layouts")
list(LENGTH uses count)
if(count GREATER 0)
    list(GET uses 0 first)
    message(FATAL_ERROR "${SOURCE}, layout ${LAYOUT}: the table of layouts is still read at run time, "
                        "${count} times; first in:\n${first}")
endif()
