# Tests of this kind, by name.
pkg_check_modules(JANSSON REQUIRED IMPORTED_TARGET jansson)

tl_test(test_capture_unlit raster tl_raster tl_lighting)
tl_test(test_command_promise command tl_base PkgConfig::JANSSON)

# Rays that shadow maps are held against.
find_package(embree 3 CONFIG REQUIRED)
add_library(tl_rays STATIC rays/ray_scene.c rays/asset_view.c)
target_include_directories(tl_rays PUBLIC ${CMAKE_CURRENT_SOURCE_DIR}
                           PRIVATE ${PROJECT_SOURCE_DIR}/raster/model ${PROJECT_SOURCE_DIR}/raster/gltf)
target_link_libraries(tl_rays PUBLIC tl_raster PRIVATE embree PkgConfig::JANSSON m)
tl_test(test_shadow_rays raster tl_rays tl_reference tl_files PkgConfig::JANSSON)
tl_test(test_shadow_plan raster tl_raster)
tl_test(test_shadow_lit device tl_raster tl_lighting tl_files)

tl_test(test_command_farm command tl_base)
add_dependencies(test_command_farm tilelight)
tl_test(test_command_usage command tl_base)
tl_test(test_command_batch command tl_base PkgConfig::JANSSON)
tl_test(test_command_batch_faults command tl_base PkgConfig::JANSSON)
add_dependencies(test_command_batch_faults tilelight)
tl_test(test_power_cut command tl_gbuffer)
# What stands between the program and the C library.
add_library(power_cut MODULE preload/power_cut.c)
target_compile_options(power_cut PRIVATE -Wno-missing-prototypes)
target_link_libraries(power_cut PRIVATE ${CMAKE_DL_LIBS} Threads::Threads)
target_compile_definitions(test_power_cut PRIVATE POWER_CUT="$<TARGET_FILE:power_cut>")
add_dependencies(test_power_cut power_cut tilelight)
tl_test(test_command_batch_runs command tl_base PkgConfig::JANSSON)
# What stands between it and OpenCL. A pointer to data becomes one to a function, as POSIX has it.
add_library(device_objects MODULE preload/device_objects.c)
target_compile_options(device_objects PRIVATE -Wno-pedantic -Wno-cast-qual -Wno-missing-prototypes)
set_target_properties(device_objects PROPERTIES PREFIX "" LIBRARY_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
target_link_libraries(device_objects PRIVATE ${CMAKE_DL_LIBS})
add_dependencies(test_command_batch_runs device_objects tilelight)
tl_test(test_command_frames command tl_files PkgConfig::JANSSON)
tl_test(test_same_processes command tl_base)
tl_test(test_command_convert command tl_lighting tl_files PkgConfig::JANSSON)
tl_test(test_command_ispc command tl_files)
tl_test(test_command_failures command tl_base)
tl_test(test_command_light_control command tl_base)
tl_test(test_command_region command tl_files OpenEXRCore-3_1)
target_include_directories(test_command_region PRIVATE ${PROJECT_SOURCE_DIR}/host/files)
target_include_directories(test_command_region SYSTEM PRIVATE ${OPENEXR_INCLUDE_DIRS})
tl_test(test_command_samples command tl_picture tl_files)
tl_test(test_command_explain command tl_files PkgConfig::JANSSON)
tl_test(test_command_cache command tl_base)
tl_test(test_command_scene command tl_raster PkgConfig::JANSSON)
tl_test(test_command_materials command tl_base)
tl_test(test_command_layers command tl_base)
tl_test(test_command_aov command tl_base)
tl_test(test_command_links command tl_base)
tl_test(test_command_post command tl_base)
tl_test(test_command_sky command tl_base)
tl_test(test_command_layouts command tl_gbuffer PkgConfig::JANSSON)
tl_test(test_command_import command tl_files OpenEXRCore-3_1 PkgConfig::JANSSON)
target_include_directories(test_command_import SYSTEM PRIVATE ${OPENEXR_INCLUDE_DIRS})
foreach(name batch region light_control explain import promise usage samples frames convert ispc failures cache scene materials layers aov links layouts post sky)
    add_dependencies(test_command_${name} tilelight)
endforeach()

# Is every table on the page of layouts what the program says?
find_package(Python3 REQUIRED COMPONENTS Interpreter)
add_test(NAME layouts_page_is_made
         COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/scripts/make-layouts-page
                 $<TARGET_FILE:tilelight> --check)
tl_test_properties(layouts_page_is_made command)

# Is the table of effects on their page what the program says?
add_test(NAME effects_page_is_made
         COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/scripts/make-effects-page
                 $<TARGET_FILE:tilelight> --check)
tl_test_properties(effects_page_is_made command)

# Is the table of the page on shadows that of the committed result?
add_test(NAME shadows_page_is_made
         COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/scripts/make-shadows-page --check)
set_tests_properties(shadows_page_is_made PROPERTIES LABELS unit)

# Is the table of the page on light of the sky that of the committed result?
add_test(NAME sky_page_is_made
         COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/scripts/make-sky-page --check)
set_tests_properties(sky_page_is_made PROPERTIES LABELS unit)

# Is the table of the page on translucency that of the committed result?
add_test(NAME translucency_page_is_made
         COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/scripts/make-translucency-page --check)
set_tests_properties(translucency_page_is_made PROPERTIES LABELS unit)

# Is the table of the page on captures that of the committed result?
add_test(NAME captures_page_is_made
         COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/scripts/make-captures-page --check)
tl_test_properties(captures_page_is_made unit)

tl_test(test_layers_panes raster tl_raster tl_lighting PkgConfig::JANSSON)
tl_test(test_layers_scenes raster tl_raster tl_lighting PkgConfig::JANSSON)
