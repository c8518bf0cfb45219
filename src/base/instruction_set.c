/* base/instruction_set.c - the choice among a kernel's compilations. */
/* SPDX-License-Identifier: MIT */
#include "base/instruction_set.h"

#include "base/processor.h"

bool instruction_set_works(enum instruction_set set)
{
    switch (set) {
    case SET_AVX2:
        return processor_has_avx2();
    case SET_AVX512:
        return processor_has_avx512();
    default:
        return true;
    }
}

const char *instruction_set_name(enum instruction_set set)
{
    static const char names[][8] = {"best", "sse2", "avx2", "avx512"};
    return names[set];
}

enum instruction_set instruction_set_best(enum instruction_set set)
{
    if (set != SET_BEST) {
        return set;
    }
    if (processor_has_avx512()) {
        return SET_AVX512;
    }
    return processor_has_avx2() ? SET_AVX2 : SET_SSE2;
}
