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
tl_oracle_test(test_falloff_accuracy unit tl_formulas tl_frame)
tl_oracle_test(test_map_accuracy unit tl_formulas tl_base)
tl_oracle_test(test_encoding_accuracy unit tl_formulas tl_base)
tl_oracle_test(test_position_from_depth unit tl_formulas tl_gbuffer)
if(TILELIGHT_LIGHTING)
    tl_oracle_test(test_pixel_accuracy unit tl_lighting)
endif()

# Those whose figures stand on docs/accuracy.md, and whether its tables are those of docs/accuracy.json.
foreach(name model_accuracy falloff_accuracy encoding_accuracy map_accuracy pixel_accuracy position_from_depth
             specular_rounding layout_round_trip)
    if(TARGET test_${name})
        set_property(TEST test_${name} APPEND PROPERTY LABELS figures)
    endif()
endforeach()
find_package(Python3 REQUIRED COMPONENTS Interpreter)
add_test(NAME accuracy_page_is_made
         COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/scripts/make-accuracy-page --check)
tl_test_properties(accuracy_page_is_made unit)
