/* trace/frames.h - frames of tilted and decentred surfaces. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_FRAMES_H
#define LENSCALC_TRACE_FRAMES_H

#include "optics/lens.h"
#include "trace/system.h"

/*
 * The frame of a displacement at distance z along the axis, for X' = turn (X - shift).
 *
 * Formula   axes of the new frame: Rx(ax) Ry(ay) Rz(az), right-handed; turn is its transpose
 */
struct surface_frame frame_of(const struct displacement *displacement, double z);

/* X = turn' (X' - shift') leads back. */
struct surface_frame frame_inverse(const struct surface_frame *frame);

/*
 * Where light along the axis of the first surface goes at each surface: +1 or -1 along z, reflected
 * where it meets the mirrors, by their conics; count + 1, the last behind the lens.
 */
void frame_directions(const struct lens *lens, double *direction);

#endif
