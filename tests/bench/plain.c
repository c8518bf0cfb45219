/* tests/bench/plain.c - prints how many million ray-surfaces a second a plain loop traces here. */
/* SPDX-License-Identifier: MIT */
#include "plain.h"

#include <stdio.h>

int main(void)
{
    printf("%.2f\n", 1e-6 * PLAIN_RAYS * PLAIN_SURFACES / plain_time(40));
    return 0;
}
