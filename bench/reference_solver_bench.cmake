# The reference solver; its peer Boost.odeint is headers only (libboost-dev).
plumbline_add_bench(reference_solver SOURCES reference_solver_bench.cpp SHORT Pendulum)
target_include_directories(bench_reference_solver PRIVATE ${CMAKE_CURRENT_LIST_DIR}/../tests/core/integration)
target_include_directories(bench_reference_solver SYSTEM PRIVATE ${Boost_INCLUDE_DIRS})
# At -O1 g++ takes odeint's copies of its own steppers for uninitialised.
target_compile_options(bench_reference_solver PRIVATE -Wno-uninitialized -Wno-maybe-uninitialized)
