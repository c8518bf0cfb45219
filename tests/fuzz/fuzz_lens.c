/* tests/fuzz/fuzz_lens.c - .lens files: read, check, trace, write, read again. */
/* SPDX-License-Identifier: MIT */
#include "file/lens_file.h"
#include "fuzz.h"
#include "optics/first_order.h"

#include <math.h>

static void require_data_error(const struct error *error)
{
    fuzz_require_error(error);
    REQUIRE(error->code == ERROR_DATA);
}

/* What was written reads as the same lens. */
static void require_roundtrip(const struct lens *lens, struct arena *arena)
{
    struct lens again;
    struct error error = {0};
    struct text written = lens_write(lens, arena);
    REQUIRE(lens_read("again.lens", written, NULL, arena, &again, &error));
    REQUIRE(again.surface_count == lens->surface_count && again.stop == lens->stop);
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *a = &lens->surfaces[i], *b = &again.surfaces[i];
        REQUIRE(a->kind == b->kind && a->medium.kind == b->medium.kind);
        REQUIRE(a->radius.value.hi == b->radius.value.hi);
        REQUIRE(a->thickness.value.hi == b->thickness.value.hi);
        REQUIRE(a->thickness.value.lo == b->thickness.value.lo);
        REQUIRE(a->medium.index.lo == b->medium.index.lo);
        REQUIRE(a->coefficients == b->coefficients);
    }
    struct text twice = lens_write(&again, arena);
    REQUIRE(twice.length == written.length &&
            memcmp(twice.start, written.start, twice.length) == 0);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *content = fuzz_copy(data, size);
    struct arena arena = {0};
    struct lens lens;
    struct error error = {0};
    if (!lens_read("fuzz.lens", (struct text){content, size}, NULL, &arena, &lens, &error)) {
        require_data_error(&error);
    } else {
        struct lens_warnings warnings;
        struct first_order first;
        require_roundtrip(&lens, &arena);
        if (!lens_check(&lens, &arena, &warnings, &error)) {
            require_data_error(&error);
        } else if (!first_order_of_lens(lens_at_position(&lens, 0, &arena),
                                        lens_primary_wavelength(&lens), SECTION_Y, &arena, &first,
                                        &error)) {
            fuzz_require_error(&error);
        }
    }
    arena_free(&arena);
    free(content);
    return 0;
}
