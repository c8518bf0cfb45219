/* camera/spare_net.h - what a sharp tile sees, through a net of few rays. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_SPARE_NET_H
#define LENSCALC_CAMERA_SPARE_NET_H

#include "camera/spare.h"

/* What one thread looks through: a net for each wavelength. */
struct spare_net;
struct spare_net *spare_net_new(size_t passes, struct arena *arena);

/*
 * Trace the nets of a tile: rays through the middle of the pupil, and how far others of the tile's
 * middle are from these.
 *
 * Result    false: one of a net is lost, or the pupil is dark
 */
bool spare_net_trace(const struct spare *spare, const struct film_plan *plan,
                     struct spare_net *net);

/*
 * The light of half of the samples' points of the film, through nets that were traced.
 *
 * Given     sights, sums  as spare_take has them
 * Result    false: the watch has ended it
 */
bool spare_net_look(const struct spare *spare, const struct spare_tile *tile, struct spare_net *net,
                    uint64_t sights[RELIEF_SIGHTS], double (*sums)[CARD_CHANNELS]);

#endif
