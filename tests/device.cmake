# What the device computes, and the formulas behind it.
tl_test(test_specular_rounding unit tl_frame)
target_compile_options(test_specular_rounding PRIVATE -Wno-double-promotion)
tl_test(test_frame_layout device tl_lighting)
tl_test(test_same_bits device tl_lighting)
tl_test(test_culling_exact device tl_lighting)
tl_test(test_lighting_formulas unit tl_lighting)
target_compile_options(test_lighting_formulas PRIVATE -Wno-double-promotion)
tl_test(test_float_error device tl_lighting)
