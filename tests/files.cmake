# Tests of this kind, by name.

# What OpenEXR files hold is checked, and hard cases are made, by the library's own C API.
function(tl_exr_test name)
    tl_test(${name} unit tl_files OpenEXRCore-3_1)
    target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/host/files)
    target_include_directories(${name} SYSTEM PRIVATE ${OPENEXR_INCLUDE_DIRS})
endfunction()

tl_test(test_file_gbuffer_round_trip unit tl_files)
tl_exr_test(test_file_gbuffer_standard)
tl_exr_test(test_file_words)
tl_test(test_file_words_refusals unit tl_files)
tl_exr_test(test_file_gbuffer_foreign)
tl_exr_test(test_capture_formats)
tl_test(test_ispc_read unit tl_files)
target_include_directories(test_ispc_read PRIVATE ${PROJECT_SOURCE_DIR}/host/files)
tl_exr_test(test_file_gbuffer_refusals)
tl_exr_test(test_file_exr_damaged)
tl_test(test_file_image_exr unit tl_files)
tl_test(test_file_png unit tl_files)
tl_test(test_file_atomic unit tl_files)
tl_test(test_lights_file_round_trip unit tl_files)
tl_test(test_lights_file_refusals unit tl_files)
tl_test(test_file_whole unit tl_files)
target_include_directories(test_file_whole PRIVATE ${PROJECT_SOURCE_DIR}/host/files)

# Captures of other programs, which the tests write as those do.
function(tl_import_test name)
    tl_exr_test(${name})
    target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/host/files/import)
endfunction()

tl_import_test(test_import_conventions)
tl_import_test(test_import_aliases)
