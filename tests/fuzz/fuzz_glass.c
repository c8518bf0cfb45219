/* tests/fuzz/fuzz_glass.c - the tables of glasses, lensdb/glass/NAME.tsv: the input is the file. */
/* SPDX-License-Identifier: MIT */
#include "data/glass_table.h"
#include "fuzz.h"
#include "optics/wavelength.h"

#include <math.h>

/* What was read must be usable: an index, or a reason why there is none. */
static void require_glass(const struct glass *glass)
{
    struct error error = {0};
    REQUIRE(glass->name.length > 0);
    REQUIRE(glass_count_fits(glass->formula, glass->count));
    REQUIRE(isnan(glass->shortest) == isnan(glass->longest));
    for (size_t i = 1; i < glass->transmittance_count; i++) {
        REQUIRE(glass->transmittance[i].wavelength.hi > glass->transmittance[i - 1].wavelength.hi);
    }
    for (size_t i = 1; i < glass->table_count; i++) {
        REQUIRE(glass->table[i].wavelength.hi > glass->table[i - 1].wavelength.hi);
    }
    if (glass_check_range(glass, WAVELENGTH_D, &error)) {
        (void)glass_index(glass, pair_of(WAVELENGTH_D));
    } else {
        fuzz_require_error(&error);
        REQUIRE(error.code == ERROR_DOMAIN);
    }
}

static void read_rows(struct glass_table *table, struct error *error)
{
    struct arena arena = {0};
    while (tsv_next(&table->rows.tsv, error)) {
        const struct arena_mark mark = arena_mark(&arena);
        for (int complete = 0; complete < 2; complete++) {
            struct glass_record record;
            struct error bad = {0};
            if (glass_table_read(table, complete != 0, &arena, &record, &bad)) {
                require_glass(&record.glass);
            } else {
                fuzz_require_error(&bad);
                REQUIRE(bad.code == ERROR_DATA && bad.line == table->rows.tsv.line &&
                        bad.column >= 1);
            }
        }
        arena_reset(&arena, mark);
    }
    if (error->code != ERROR_NONE) {
        fuzz_require_error(error);
        REQUIRE(error->code == ERROR_DATA && error->line >= 1);
    }
    arena_free(&arena);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *content = fuzz_copy(data, size);
    struct glass_table table = {0};
    struct error error = {0};
    if (tsv_open(&table.rows.tsv, "fuzz.tsv", (struct text){content, size}, &error) &&
        glass_table_open(&table, text_of("FUZZ"), LENSDB_USER, &error)) {
        read_rows(&table, &error);
    } else {
        fuzz_require_error(&error);
        REQUIRE(error.code == ERROR_DATA);
    }
    free(content);
    return 0;
}
