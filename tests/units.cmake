# Tests of this kind, by name.

# Is every file of data/ what its script makes?
find_package(Python3 REQUIRED COMPONENTS Interpreter)
add_test(NAME data_scenes_are_made
         COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/data/make_scenes.py --check)
set_tests_properties(data_scenes_are_made PROPERTIES LABELS unit)

# Do the texts still stand that scripts/plant-faults replaces?
add_test(NAME faults_apply
         COMMAND ${Python3_EXECUTABLE} -B ${PROJECT_SOURCE_DIR}/tests/faults/plant.py --check)
set_tests_properties(faults_apply PROPERTIES LABELS unit)

# Is the model of farms what can be added up by hand?
add_test(NAME farm_model_adds_up COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/tests/farm/check_model.py)
set_tests_properties(farm_model_adds_up PROPERTIES LABELS unit)
# Are the tables of the page on farms those of the committed result, and is its night's log that of a good one?
add_test(NAME farm_page_is_made
         COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/scripts/make-farm-page --check)
set_tests_properties(farm_page_is_made PROPERTIES LABELS unit)
tl_test(test_farm_needs unit tl_batch)
tl_test(test_farm_schedulers unit tl_batch)
tl_test(test_tone unit tl_picture)
tl_test(test_show unit tl_picture)
tl_test(test_compare unit tl_picture)
tl_test(test_flip unit tl_picture)
tl_test(test_resolve unit tl_picture)
tl_oracle_test(test_oracle unit tl_base)
tl_oracle_test(test_sphere_bounds unit tl_sphere_cases)
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
tl_test(test_model_lobes unit tl_gbuffer)
target_compile_definitions(test_model_lobes PRIVATE TL_REAL_DOUBLE=1 TL_PRECISE_POWER=1)
target_compile_options(test_model_lobes PRIVATE -Wno-double-promotion)
tl_test(test_frame_set unit tl_batch)
tl_test(test_item_list unit tl_batch tl_files)
tl_test(test_manifest unit tl_batch tl_files)
tl_test(test_record unit tl_batch tl_files)
tl_test(test_frame_claim unit tl_batch tl_files)
target_include_directories(test_frame_claim PRIVATE ${PROJECT_SOURCE_DIR}/host/files)
