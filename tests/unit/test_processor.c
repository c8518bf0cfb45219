/* tests/unit/test_processor.c - the processor's instructions, against the compiler's own answer. */
/* SPDX-License-Identifier: MIT */
#include "base/processor.h"
#include "check.h"

int main(void)
{
#ifdef __x86_64__
    CHECK(processor_has_avx2() == (__builtin_cpu_supports("avx2") != 0));
    CHECK(processor_has_fma() == (__builtin_cpu_supports("fma") != 0));
    bool avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                  __builtin_cpu_supports("avx512dq");
    CHECK(processor_has_avx512() == avx512);
#else
    CHECK(!processor_has_avx2() && !processor_has_fma() && !processor_has_avx512());
#endif
    return check_report();
}
