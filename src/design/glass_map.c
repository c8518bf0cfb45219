/* design/glass_map.c - where in nd and Vd optical glasses lie. */
/* SPDX-License-Identifier: MIT */
#include "design/glass_map.h"

#include <math.h>

/* A curve Vd(nd), and its slope. */
struct glass_map_edge {
    double Vd, slope;
};

static struct glass_map_edge glass_map_lower(double nd)
{
    double x = nd - 1.2688;
    return (struct glass_map_edge){13.07 / x - 2.4, -13.07 / (x * x)};
}

static struct glass_map_edge upper(double nd)
{
    double y = nd - 1.7;
    return (struct glass_map_edge){59.5 + y * (-96.6 + y * (94.4 - 315 * y)),
                                   -96.6 + y * (2 * 94.4 - 3 * 315 * y)};
}

struct glass_map_point glass_map_at(double nd, double share)
{
    const struct glass_map_edge flint = glass_map_lower(nd), crown = upper(nd);
    return (struct glass_map_point){.Vd = flint.Vd + share * (crown.Vd - flint.Vd),
                                    .by_nd = flint.slope + share * (crown.slope - flint.slope),
                                    .by_share = crown.Vd - flint.Vd};
}

struct glass_map_range glass_map_indices(double low, double high)
{
    enum { HALVINGS = 60 };
    const double flint = 1.2688 + 13.07 / (high + 2.4);
    /* where the crown side has the lower Abbe number; an end of the map where it has none such */
    double from = GLASS_MAP_LOWEST, to = GLASS_MAP_HIGHEST;
    for (int i = 0; i < HALVINGS; i++) {
        const double middle = (from + to) / 2;
        if (upper(middle).Vd > low) {
            from = middle;
        } else {
            to = middle;
        }
    }
    return (struct glass_map_range){fmax(GLASS_MAP_LOWEST, flint), to};
}

struct glass_map_range glass_map_abbes(double low, double high)
{
    return (struct glass_map_range){glass_map_lower(fmin(high, GLASS_MAP_HIGHEST)).Vd,
                                    upper(fmax(low, GLASS_MAP_LOWEST)).Vd};
}

double glass_map_share(double nd, double Vd)
{
    const struct glass_map_edge flint = glass_map_lower(nd), crown = upper(nd);
    bool inside = nd >= GLASS_MAP_LOWEST && nd <= GLASS_MAP_HIGHEST;
    return inside ? (Vd - flint.Vd) / (crown.Vd - flint.Vd) : NAN;
}
