# The bench measures right, whatever the times are: no test asserts a time.
tl_test(test_bench_statistics unit tl_measure)
tl_test(test_bench_comparison unit tl_bench_report tl_files)
target_include_directories(test_bench_comparison PRIVATE ${PROJECT_SOURCE_DIR}/host/files)
tl_test(test_bench_growth unit tl_growth tl_base)
tl_test(test_bench_scenes device tl_bench_cases)
tl_test(test_command_bench command tl_base PkgConfig::JANSSON)
add_dependencies(test_command_bench tilelight)
