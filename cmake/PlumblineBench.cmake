# plumbline_add_bench(NAME SOURCES ... LIBRARIES ...): a Google Benchmark program bin/bench_NAME.
function(plumbline_add_bench name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES;DEFINITIONS" ${ARGN})
  set(target bench_${name})
  add_executable(${target} ${ARG_SOURCES})
  target_link_libraries(${target} PRIVATE plumbline::core ${ARG_LIBRARIES} benchmark::benchmark)
  target_compile_definitions(${target} PRIVATE ${ARG_DEFINITIONS})
  plumbline_compile_options(${target})
endfunction()
