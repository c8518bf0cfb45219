/* tests/bench/printf_dof.c - the batch of dof in plain C: fgets, strtod, printf. */
/* SPDX-License-Identifier: MIT */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/*
 * Reads f_mm,N,s_m,c_mm and writes hyperfocal_m,near_m,far_m with as many digits as the argument
 * says (6), by the same operations on doubles as photo/dof.c for pupil magnification 1: the output
 * is the same to the byte. This is what anybody would write in an afternoon.
 */
static void print_row(double f, double N, double s, double c, int digits)
{
    double gap = s - f, m = f / gap, e = N * c / f, eps = e * gap / f;
    double near = eps < 1 ? s / (1 + eps) : (f + f * m) / (m + e);
    double far = eps < 1 ? s + (gap + f) * eps / (1 - eps) : INFINITY;
    printf("%.*g,%.*g,%.*g\n", digits, (f / e + f) / 1000, digits, near / 1000, digits, far / 1000);
}

int main(int argc, char **argv)
{
    char line[256];
    int digits = argc > 1 ? atoi(argv[1]) : 6;
    if (fgets(line, sizeof line, stdin) == NULL)
        return 1;
    puts("hyperfocal_m,near_m,far_m");
    while (fgets(line, sizeof line, stdin) != NULL) {
        char *at = line;
        double f = strtod(at, &at), N = strtod(at + 1, &at);
        /* whole millimetres, as the input has them: lenscalc reads metres with one rounding */
        double s = round(1000 * strtod(at + 1, &at));
        print_row(f, N, s, strtod(at + 1, NULL), digits);
    }
    return 0;
}
