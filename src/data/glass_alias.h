/* data/glass_alias.h - what materials are called elsewhere. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DATA_GLASS_ALIAS_H
#define LENSCALC_DATA_GLASS_ALIAS_H

#include "data/lensdb.h"

/*
 * The material that a name of another program stands for, by glass_aliases.tsv: the user's, then
 * the embedded one. A row is for a material ("GE" is MISC:GERMANIUM) or for a catalogue
 * ("INFRARED:" is "MISC:").
 *
 * Given     name      NAME or CATALOG:NAME; case, blanks, '-' and '_' do not count
 *           material  receives CATALOG:NAME, in the arena
 * Result    false with error->code ERROR_NONE where it stands for nothing else; a typed catalogue
 *           has to be that of the material. The material may still be in no catalogue
 * Errors    as lensdb_open
 */
bool glass_alias(struct lensdb *db, struct text name, struct arena *arena, struct text *material,
                 struct error *error);

/*
 * The material that another program means by a name that is also that of another material here: a
 * row "MISC:WATER" is MISC:WATER_HANDBOOK.
 *
 * Given     name  CATALOG:NAME
 * Result    false with error->code ERROR_NONE where there is no such row
 * Errors    as lensdb_open
 */
bool glass_homonym(struct lensdb *db, struct text name, struct arena *arena, struct text *material,
                   struct error *error);

#endif
