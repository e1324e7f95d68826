# Promises: what is chosen, checked and remembered.
tl_test(test_promise_bound unit tl_promise tl_bench_scenes)
tl_test(test_promise_sample unit tl_promise tl_bench_scenes)
tl_test(test_promise_choose unit tl_promise tl_bench_scenes)
tl_test(test_promise_lit device tl_promise tl_bench_scenes)
