#ifndef OUTDOOR_OMR_CORE_VECTORIZED_H
#define OUTDOOR_OMR_CORE_VECTORIZED_H

/**
 * A function whose loops take the widest vectors that the processor has. AVX2 without FMA: fused operations round
 * differently, and the same image shall give the same markers on every processor.
 */
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define OMR_VECTORIZED __attribute__((target_clones("avx2", "default"), optimize("O3")))
#else
#define OMR_VECTORIZED
#endif

/** What such functions share: it must become part of each, as on its own it would have the narrow vectors. */
#ifdef __GNUC__
#define OMR_PART_OF_VECTORIZED inline __attribute__((always_inline))
#else
#define OMR_PART_OF_VECTORIZED inline
#endif

#endif
