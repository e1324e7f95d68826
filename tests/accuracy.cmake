# Formulas of kernels/ against the oracle, each in float and in double. What these tests see of every bound
# stands on docs/accuracy.md (scripts/make-accuracy-page).
add_library(tl_formulas STATIC)
target_include_directories(tl_formulas INTERFACE ${CMAKE_CURRENT_SOURCE_DIR})
target_link_libraries(tl_formulas INTERFACE tl_kernels m)
foreach(arithmetic float double)
    add_library(tl_formulas_${arithmetic} OBJECT formulas.c)
    target_link_libraries(tl_formulas_${arithmetic} PRIVATE tl_kernels)
    target_compile_definitions(tl_formulas_${arithmetic} PRIVATE
        TL_FORMULAS=tl_formulas_${arithmetic})
    target_sources(tl_formulas PRIVATE $<TARGET_OBJECTS:tl_formulas_${arithmetic}>)
endforeach()
target_compile_definitions(tl_formulas_double PRIVATE TL_REAL_DOUBLE=1 TL_PRECISE_POWER=1)
target_compile_options(tl_formulas_double PRIVATE -Wno-double-promotion)

tl_oracle_test(test_model_accuracy unit tl_formulas tl_base)
target_sources(test_model_accuracy PRIVATE model_bounds.c)
