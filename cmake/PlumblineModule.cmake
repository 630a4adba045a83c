# plumbline_compile_options(TARGET): what all of our own code is compiled with.
function(plumbline_compile_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  # A fused multiply-add rounds once where the source rounds twice: results would depend on the processor and on
  # the optimisation level, and "the same bits" could not be promised.
  target_compile_options(${target} PRIVATE -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                                           -Wnon-virtual-dtor -Woverloaded-virtual
                                           $<$<BOOL:${PLUMBLINE_WERROR}>:-Werror>)
  # With sanitizers g++ 12 takes the standard library's own <regex> for uninitialised (GCC bug 105562).
  if("${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_DEBUG}" MATCHES "-fsanitize")
    target_compile_options(${target} PRIVATE -Wno-maybe-uninitialized)
  endif()
  if(PLUMBLINE_CLANG_TIDY)
    find_program(PLUMBLINE_CLANG_TIDY_PROGRAM clang-tidy REQUIRED)
    set_target_properties(${target} PROPERTIES CXX_CLANG_TIDY "${PLUMBLINE_CLANG_TIDY_PROGRAM};--quiet")
  endif()
endfunction()

# plumbline_add_module(NAME SOURCES ... [PUBLIC libraries ...] [PRIVATE libraries ...])
# makes the library plumbline::NAME with the headers in include/, and exports it for find_package(plumbline).
function(plumbline_add_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(target plumbline_${name})
  add_library(${target} STATIC ${ARG_SOURCES})
  add_library(plumbline::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
                                              $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(${target} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  plumbline_compile_options(${target})
  install(TARGETS ${target} EXPORT plumblineTargets)
  install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endfunction()

# plumbline_add_test(NAME SOURCES ... LIBRARIES ... [DEFINITIONS ...]): a GoogleTest program, one CTest per case.
function(plumbline_add_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES;DEFINITIONS;LABELS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} GTest::gtest_main)
  target_compile_definitions(${name} PRIVATE PLUMBLINE_SOURCE_DIR="${PROJECT_SOURCE_DIR}" ${ARG_DEFINITIONS})
  plumbline_compile_options(${name})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 300 LABELS "${ARG_LABELS}")
endfunction()
