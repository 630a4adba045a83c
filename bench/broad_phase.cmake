find_package(PkgConfig REQUIRED)
pkg_check_modules(BULLET_BROAD_PHASE IMPORTED_TARGET bullet)
if(BULLET_BROAD_PHASE_FOUND)
  plumbline_add_bench(broad_phase
    SOURCES broad_phase_bench.cpp bullet_broad_phase.cpp
    LIBRARIES PkgConfig::BULLET_BROAD_PHASE
    DEFINITIONS PLUMBLINE_HAVE_BULLET
    SHORT "^uniform/.*/1000/")
else()
  message(STATUS "bench_broad_phase: without its peer Bullet (Debian package libbullet-dev)")
  plumbline_add_bench(broad_phase SOURCES broad_phase_bench.cpp SHORT "^uniform/.*/1000/")
endif()
