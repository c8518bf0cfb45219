/* data/agf_catalogs.h - the AGF files of the user. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DATA_AGF_CATALOGS_H
#define LENSCALC_DATA_AGF_CATALOGS_H

#include "data/agf.h"

/*
 * The user's AGF files, read once: those of db->agf in their order, then glass/NAME.agf of the
 * user's folder, by name.
 *
 * Given     first  receives the first; null if there is none
 * Errors    ERROR_IO: a file of db->agf that is not there, a file that cannot be read; ERROR_USAGE:
 *           two of db->agf make catalogues of one name; ERROR_DATA as agf_read
 */
bool agf_catalogs(struct lensdb *db, const struct agf_catalog **first, struct error *error);

#endif
