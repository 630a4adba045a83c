// One source, several machine codes, chosen when the program starts.
//
// A package is compiled for the oldest processor it must run on, which knows vectors of two doubles; most processors
// know four or eight. A loop that is marked is compiled for each, and the widest that the processor has is taken. The
// results are the same bits on all of them: a lane computes what a scalar would, and nothing is fused or reordered (the
// project is compiled with -ffp-contract=off). The choice is made before the sanitizers start, so with them there is
// only one.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define PLUMBLINE_VECTOR_CLONES __attribute__((target_clones("default", "avx2", "avx512f")))
#else
#define PLUMBLINE_VECTOR_CLONES
#endif
