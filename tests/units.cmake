# Tests of this kind, by name.

# Is every file of data/ what its script makes?
find_package(Python3 REQUIRED COMPONENTS Interpreter)
add_test(NAME data_scenes_are_made
         COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/data/make_scenes.py --check)
set_tests_properties(data_scenes_are_made PROPERTIES LABELS unit)
tl_test(test_tone unit tl_picture)
tl_test(test_compare unit tl_picture)
tl_test(test_resolve unit tl_picture)
tl_test(test_sphere_bounds unit tl_scene quadmath)
# 128-bit floats and their literals are GNU's.
set_target_properties(test_sphere_bounds PROPERTIES C_EXTENSIONS ON)
target_compile_options(test_sphere_bounds PRIVATE -Wno-pedantic -Wno-conversion)
tl_test(test_layout_targets unit tl_gbuffer)
tl_test(test_repair unit tl_gbuffer)
tl_test(test_repair_packed unit tl_gbuffer tl_picture)
tl_test(test_camera_and_lights unit tl_scene)
tl_test(test_scatter unit tl_gbuffer)
tl_test(test_bandwidth_model unit tl_gbuffer)
tl_test(test_pass_words unit tl_gbuffer)
tl_test(test_number_formats unit tl_scene)
tl_test(test_layout_round_trip unit tl_gbuffer)
target_compile_options(test_layout_round_trip PRIVATE -Wno-double-promotion)
tl_test(test_layout_cut unit tl_gbuffer)
tl_test(test_depth_loss unit tl_gbuffer)
tl_test(test_position_from_depth unit tl_gbuffer quadmath)
set_target_properties(test_position_from_depth PROPERTIES C_EXTENSIONS ON)
target_compile_options(test_position_from_depth PRIVATE -Wno-pedantic -Wno-conversion -Wno-double-promotion)
