# plumbline_add_bench(NAME SOURCES ... [LIBRARIES ...] [DEFINITIONS ...] SHORT regex): the Google Benchmark program
# bin/bench_NAME. Where there are tests, the benchmarks that match SHORT are also run once as a test, so that the program
# cannot rot: the test looks at whether it runs, never at how long.
function(plumbline_add_bench name)
  cmake_parse_arguments(ARG "" "SHORT" "SOURCES;LIBRARIES;DEFINITIONS" ${ARGN})
  set(target bench_${name})
  add_executable(${target} ${ARG_SOURCES})
  target_link_libraries(${target} PRIVATE plumbline::core ${ARG_LIBRARIES} benchmark::benchmark)
  target_compile_definitions(${target} PRIVATE ${ARG_DEFINITIONS})
  plumbline_compile_options(${target})
  if(PLUMBLINE_BUILD_TESTS AND ARG_SHORT)
    add_test(NAME ${target} COMMAND ${target} --benchmark_filter=${ARG_SHORT} --benchmark_min_time=0.001)
    set_tests_properties(${target} PROPERTIES FAIL_REGULAR_EXPRESSION "Failed to match|ERROR" LABELS bench TIMEOUT 300)
  endif()
endfunction()
