# The one strict set of warnings; a warning is an error in the presets.
set(strict -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wdouble-promotion
           -Wcast-qual -Wwrite-strings -Wundef -Wvla -Wformat=2)
# -Wdouble-promotion: a float formula that strays into double gives other bits than the device.
add_compile_options(
    "$<$<COMPILE_LANGUAGE:C>:${strict};-Wstrict-prototypes;-Wmissing-prototypes;-Wold-style-definition>"
    "$<$<COMPILE_LANGUAGE:CXX>:${strict}>")
option(TILELIGHT_WARNINGS_ARE_ERRORS "Stop at a warning" OFF)
if(TILELIGHT_WARNINGS_ARE_ERRORS)
    add_compile_options(-Werror)
endif()
