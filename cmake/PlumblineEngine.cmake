# plumbline_add_engine(NAME SOURCES ... [LIBRARIES ...] [DEFINITIONS ...])
# turns one adapter into the worker program plumbline-engine-NAME, with its list of deviations beside it, and puts
# it before the conformance suite. An adapter calls it only when its engine was found; otherwise it calls
# plumbline_skip_engine.
function(plumbline_add_engine name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES;DEFINITIONS" ${ARGN})
  set(adapter plumbline_adapter_${name})
  add_library(${adapter} STATIC ${ARG_SOURCES})
  add_library(plumbline::adapter_${name} ALIAS ${adapter})
  target_link_libraries(${adapter} PUBLIC plumbline::core PRIVATE plumbline::adapters ${ARG_LIBRARIES})
  target_compile_definitions(${adapter} PRIVATE ${ARG_DEFINITIONS})
  plumbline_compile_options(${adapter})

  set(worker plumbline-engine-${name})
  add_executable(${worker})
  target_link_libraries(${worker} PRIVATE plumbline_worker_main ${adapter})
  set(folder ${PROJECT_BINARY_DIR}/${PLUMBLINE_WORKER_DIR})
  set_target_properties(${worker} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${folder})
  install(TARGETS ${worker} DESTINATION ${PLUMBLINE_WORKER_DIR})

  # The link is made whether or not the list exists yet, so that one written later is seen without configuring anew; a
  # link that leads nowhere is an empty list.
  set(deviations ${CMAKE_CURRENT_SOURCE_DIR}/deviations.toml)
  file(MAKE_DIRECTORY ${folder})
  file(CREATE_LINK ${deviations} ${folder}/${worker}.deviations.toml SYMBOLIC)
  install(FILES ${deviations} DESTINATION ${PLUMBLINE_WORKER_DIR} RENAME ${worker}.deviations.toml OPTIONAL)

  set_property(GLOBAL APPEND PROPERTY PLUMBLINE_ENGINES ${name})
  cmake_path(GET CMAKE_CURRENT_SOURCE_DIR FILENAME engine_folder)
  set_property(GLOBAL APPEND PROPERTY PLUMBLINE_ENGINE_FOLDERS ${engine_folder})
  message(STATUS "Engine ${name}: worker program ${worker}")
endfunction()

# plumbline_skip_engine(NAME PACKAGE): says in one line that the engine is left out and how to get it.
function(plumbline_skip_engine name package)
  set_property(GLOBAL APPEND_STRING PROPERTY PLUMBLINE_ENGINES_LEFT_OUT "${name}\t${package}\n")
  # A worker of an earlier build cannot start without its library.
  file(REMOVE ${PROJECT_BINARY_DIR}/${PLUMBLINE_WORKER_DIR}/plumbline-engine-${name})
  message(STATUS "Engine ${name}: left out, its library was not found (Debian package: ${package})")
endfunction()

# plumbline_write_left_out_engines(): the list that `plumbline doctor` reads.
function(plumbline_write_left_out_engines)
  get_property(left_out GLOBAL PROPERTY PLUMBLINE_ENGINES_LEFT_OUT)
  set(file ${PROJECT_BINARY_DIR}/share/plumbline/engines_left_out.tsv)
  file(WRITE ${file} "${left_out}")
  install(FILES ${file} DESTINATION share/plumbline)
endfunction()
