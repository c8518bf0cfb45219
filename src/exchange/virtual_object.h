/* exchange/virtual_object.h - objects in or behind the first surface of a lens file. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_VIRTUAL_OBJECT_H
#define LENSCALC_EXCHANGE_VIRTUAL_OBJECT_H

#include "file/lens_build.h"

/*
 * An object at any finite distance of the first surface: rays start at it, one unit of the file
 * before a plane in the object's medium, and go from there to the first surface, forwards or back.
 *
 * Given     build     without surfaces: receives the plane; its object's medium is set
 *           distance  of the object, left of the first surface, mm; 0 and less: it lies in the
 *                     surface or behind it, where rays would meet (a virtual object)
 */
void virtual_object_put(struct lens_build *build, struct pair distance);

#endif
