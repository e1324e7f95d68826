# Tests of this kind, by name.
pkg_check_modules(JANSSON REQUIRED IMPORTED_TARGET jansson)

tl_test(test_command_usage command tl_base)
tl_test(test_command_frames command tl_files PkgConfig::JANSSON)
tl_test(test_command_failures command tl_base)
tl_test(test_command_cache command tl_base)
tl_test(test_command_layouts command tl_gbuffer PkgConfig::JANSSON)
foreach(name usage frames failures cache layouts)
    add_dependencies(test_command_${name} tilelight)
endforeach()
