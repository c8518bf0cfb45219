/* tests/unit/test_pbrt.c - the tables of pbrt's realistic camera: what they mean, and refusals. */
/* SPDX-License-Identifier: MIT */
#include "foreign_cases.h"

static const char good[] = "# Singlet\n50 4 1.5 12\n0 2 0 10\n-50 90 1 12\n";

static const struct meaning meanings[] = {
    {"", "", "lens Singlet\nunit mm\nobject inf\naperture stop\nfocus paraxial"},
    {"", "", "surface 50 4 1.5 12\nstop - 2 1.5 10\nsurface -50 90 air 12"},
    {"# Singlet", "# Singlet\n# a remark # more\n", "lens Singlet\nnote a remark No. more"},
    {"50 4 1.5 12\n0 2", "50\n4 1.5\n12 0 2", "surface 50 4 1.5 12\nstop - 2 1.5 10"},
    {"0 2 0 10", "0 2 1.5 10", "stop - 2 1.5 10"},
    {"0 2 0 10\n", "", "object inf\nfocus paraxial"},
    {"50 4 1.5 12", "50 4 0 12", "surface 50 4 air 12\nstop - 2 air 10"},
    {"50 4 1.5 12", "1e5\t4  1.50\t12.0", "surface 1e5 4 1.50 12.0"},
};

static const struct refusal refusals[] = {
    {"50 4 1.5 12", "50 4 @-1.5 12", "a negative index", NULL},
    {"50 4 1.5 12", "50 4 1.5 @-12", "a negative diameter", NULL},
    {"50 4 1.5 12", "50 4 1.5 @0", "a surface without diameter", NULL},
    {"0 2 0 10", "@0 2 1.6 10",
     "radius 0 is the stop, which does not refract, but the index changes here", NULL},
    {"-50 90 1 12", "@0 90 0 12", "a second stop: surface 2 is one already", NULL},
    {"-50 90 1 12", "-50 90 @1", "the last surface has no diameter", NULL},
    {"-50 90 1 12", "-50 90 @1\n\n# end", "the last surface has no diameter", NULL},
    {"-50 90 1 12", "-50 90 1@x 12", "the index '1x' is not a number", NULL},
    {"50 4 1.5 12\n0 2 0 10\n-50 90 1 12\n", "",
     "no surface: a line is radius, thickness, index, diameter", NULL},
};

int main(void)
{
    check_meanings("lens.dat", good, CASES(meanings));
    check_refusals("bad.dat", good, CASES(refusals));
    return check_report();
}
