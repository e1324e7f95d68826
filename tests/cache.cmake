# Compiled programs kept on disk.
tl_test(test_program_cache unit tl_lighting)
