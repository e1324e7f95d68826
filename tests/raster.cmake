# Tests of this kind, by name.
tl_test(test_capture_planes raster tl_raster)
tl_test(test_gltf_refusals raster tl_raster)
tl_test(test_gltf_truncations raster tl_raster)
tl_test(test_golden_capture raster tl_raster tl_files)
tl_test(test_capture_assets raster tl_raster)
tl_test(test_capture_materials raster tl_raster)
tl_test(test_capture_view raster tl_raster)
tl_test(test_capture_damaged raster tl_raster)
