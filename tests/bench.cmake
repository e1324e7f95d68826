# The bench measures right, whatever the times are: no test asserts a time.
tl_test(test_bench_statistics unit tl_measure)
tl_test(test_event_counter unit tl_measure)
tl_test(test_bench_comparison unit tl_bench_report tl_files)
target_include_directories(test_bench_comparison PRIVATE ${PROJECT_SOURCE_DIR}/host/files)
tl_test(test_bench_growth unit tl_growth tl_base)
tl_test(test_bench_cases unit tl_bench_cases)
tl_test(test_bench_scenes device tl_bench_cases)
tl_test(test_bench_capture unit tl_baselines tl_bench_cases tl_files)
target_include_directories(test_bench_capture PRIVATE ${PROJECT_SOURCE_DIR}/host/files)
tl_test(test_command_bench command tl_base PkgConfig::JANSSON)
add_dependencies(test_command_bench tilelight)

tl_test(test_command_study command tl_base PkgConfig::JANSSON)
add_dependencies(test_command_study tilelight)

# Is every figure on the page of performance what the committed reports say?
find_package(Python3 REQUIRED COMPONENTS Interpreter)
add_test(NAME performance_page_is_made
         COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/bench/plots/make_page --check)
set_tests_properties(performance_page_is_made PROPERTIES LABELS unit)

# The same of the page of accuracy.
add_test(NAME study_page_is_made
         COMMAND ${Python3_EXECUTABLE} -B ${PROJECT_SOURCE_DIR}/scripts/make-study-page --check)
set_tests_properties(study_page_is_made PROPERTIES LABELS unit)
