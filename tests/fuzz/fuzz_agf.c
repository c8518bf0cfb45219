/* tests/fuzz/fuzz_agf.c - glass catalogues in the AGF format. */
/* SPDX-License-Identifier: MIT */
#include "data/agf.h"
#include "fuzz.h"
#include "optics/wavelength.h"

#include <math.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *content = fuzz_copy(data, size);
    struct arena arena = {0};
    struct agf_catalog catalog;
    struct error error = {0};
    if (!agf_read("fuzz.agf", (struct text){content, size}, &arena, &catalog, &error)) {
        fuzz_require_error(&error);
        REQUIRE(error.code == ERROR_DATA);
    } else {
        REQUIRE(catalog.count > 0);
        for (size_t i = 0; i < catalog.count; i++) {
            const struct glass_record *record = &catalog.glasses[i];
            const struct glass *glass = &record->glass;
            REQUIRE(glass->name.length > 0 && record->line > 0);
            REQUIRE(glass_count_fits(glass->formula, glass->count));
            REQUIRE(isnan(glass->shortest) == isnan(glass->longest));
            for (size_t j = 1; j < glass->transmittance_count; j++) {
                REQUIRE(glass->transmittance[j].wavelength.hi >
                        glass->transmittance[j - 1].wavelength.hi);
            }
            struct error no_index;
            if (!glass_check_range(glass, WAVELENGTH_D, &no_index)) {
                REQUIRE(no_index.code == ERROR_DOMAIN);
            }
        }
    }
    arena_free(&arena);
    free(content);
    return 0;
}
