/* optics/portable.h - the same without the instructions of newer processors, for tests. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_OPTICS_PORTABLE_H
#define LENSCALC_OPTICS_PORTABLE_H

#include "optics/first_order.h"

/* As paraxial_trace and first_order_compute: the same bits on every processor. */
void paraxial_trace_portable(const struct paraxial_system *system, struct paraxial_trace *trace);
void first_order_compute_portable(const struct paraxial_system *system,
                                  const struct paraxial_trace *trace,
                                  const struct conjugate_object *object,
                                  struct first_order *first_order);

#endif
