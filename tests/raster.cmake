# Tests of this kind, by name.
tl_test(test_capture_planes raster tl_raster)
