/* file/agf_catalogs.h - the AGF files of the user. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_AGF_CATALOGS_H
#define LENSCALC_FILE_AGF_CATALOGS_H

#include "file/agf.h"

/*
 * The user's AGF files, read once: those of db->agf in their order, then glass/NAME.agf of the
 * user's folder, by name.
 *
 * Given     first  receives the first; null if there is none
 * Errors    ERROR_IO: a file of db->agf that is not there, a file that cannot be read; ERROR_USAGE:
 *           two of db->agf make catalogues of one name; ERROR_DATA as agf_read
 */
bool agf_catalogs(struct lensdb *db, const struct agf_catalog **first, struct error *error);

/*
 * The files of the user's folder glass with one of the endings (in any case), sorted; an array in
 * the arena that ends with null, of names such as "glass/SCHOTT.tsv".
 *
 * Errors    ERROR_IO: the folder is there but cannot be read
 */
bool agf_catalog_files(const struct lensdb *db, const char *ending, struct arena *arena,
                       const char ***names, struct error *error);

#endif
