/* design/glass_map.h - where in nd and Vd optical glasses lie. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_GLASS_MAP_H
#define LENSCALC_DESIGN_GLASS_MAP_H

#include <stdbool.h>

/*
 * The region of the glass map that a model glass stays in: between two curves Vd(nd), so that an
 * nd and a share of the way from the lower curve to the upper one, both within plain bounds, reach
 * every point of it and no other.
 *
 * Given     nd     GLASS_MAP_LOWEST .. GLASS_MAP_HIGHEST
 *           share  0 on the flint side .. 1 on the crown side
 * Result    Vd, and its derivatives by nd and share
 * Formula   lower: 13.07/(nd - 1.2688) - 2.4
 *           upper: 59.5 - 96.6 y + 94.4 y^2 - 315 y^3, y = nd - 1.7
 * Source    derived here: curves around the glasses of Schott, Ohara, Hoya, CDGM, Hikari and Sumita
 *           in lensdb, from fused silica and the fluor crowns to the lanthanum and the titanium
 *           flints; a few special glasses with nd above 2.02 or Vd below the lower curve are left
 *           out, and all plastics
 */
struct glass_map_point {
    double Vd, by_nd, by_share;
};
#define GLASS_MAP_LOWEST  1.42
#define GLASS_MAP_HIGHEST 2.02
struct glass_map_point glass_map_at(double nd, double share);

/*
 * Indices nd of the map for Abbe numbers low .. high, either of which may be infinite: from that of
 * the flint side at `high` to that of the crown side at `low`, as both curves fall; an empty range
 * where no glass has such.
 */
struct glass_map_range {
    double low, high;
};
struct glass_map_range glass_map_indices(double low, double high);

/* And Abbe numbers for indices low .. high. */
struct glass_map_range glass_map_abbes(double low, double high);

/* The share of a glass; outside of 0 .. 1, or NaN, where the map has no such glass. */
double glass_map_share(double nd, double Vd);

#endif
