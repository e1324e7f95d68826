# Tests of this kind, by name.

# Is every file of data/ what its script makes?
find_package(Python3 REQUIRED COMPONENTS Interpreter)
add_test(NAME data_scenes_are_made
         COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/data/make_scenes.py --check)
set_tests_properties(data_scenes_are_made PROPERTIES LABELS unit)
tl_test(test_tone unit tl_picture)
tl_test(test_compare unit tl_picture)
