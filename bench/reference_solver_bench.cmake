# The reference solver; its peer Boost.odeint is headers only (libboost1.81-dev).
plumbline_add_bench(reference_solver SOURCES reference_solver_bench.cpp SHORT Pendulum)
target_include_directories(bench_reference_solver PRIVATE ${CMAKE_CURRENT_LIST_DIR}/../tests/core/integration)
find_package(Boost 1.74 QUIET)
if(Boost_FOUND)
  target_include_directories(bench_reference_solver SYSTEM PRIVATE ${Boost_INCLUDE_DIRS})
  target_compile_definitions(bench_reference_solver PRIVATE PLUMBLINE_HAVE_ODEINT)
  # At -O1 g++ takes odeint's copies of its own steppers for uninitialised.
  target_compile_options(bench_reference_solver PRIVATE -Wno-uninitialized -Wno-maybe-uninitialized)
else()
  message(STATUS "bench_reference_solver: without Boost.odeint to compare with (libboost1.81-dev)")
endif()
