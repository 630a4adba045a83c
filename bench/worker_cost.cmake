# What isolation costs: each engine's runs through its worker program and in this process, which links that one adapter.
get_property(engines GLOBAL PROPERTY PLUMBLINE_ENGINES)
foreach(engine IN LISTS engines)
  plumbline_add_bench(worker_cost_${engine} SOURCES worker_cost_bench.cpp
                      LIBRARIES plumbline::adapter_${engine} plumbline::harness plumbline::scenarios
                      DEFINITIONS PLUMBLINE_WORKER="$<TARGET_FILE:plumbline-engine-${engine}>"
                                  PLUMBLINE_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                      SHORT "/50/real_time$")
  add_dependencies(bench_worker_cost_${engine} plumbline-engine-${engine})
endforeach()
