/* tests/fuzz/fuzz_import.c - lens files of other programs: read by every format, written again. */
/* SPDX-License-Identifier: MIT */
#include "exchange/lens_formats.h"
#include "file/lens_change.h"
#include "fuzz.h"
#include "optics/first_order.h"

#include <math.h>

/* A reader must not fail without saying why, and a loss must not be an error where it is listed. */
static void require_sound(const struct error *error)
{
    fuzz_require_error(error);
    REQUIRE(error->code == ERROR_DATA || error->code == ERROR_DOMAIN);
}

/* Every format that writes: what it writes is read again by the same format. */
static void write_all(struct foreign_job *job, const struct lens *lens)
{
    for (const struct foreign_format *const *format = foreign_formats; *format != NULL; format++) {
        struct text text;
        struct lens again;
        struct error error = {0};
        if ((*format)->write == NULL) {
            continue;
        }
        job->loss_count = 0;
        if (!foreign_write(job, *format, lens, &text, &error)) {
            require_sound(&error);
        } else if ((*format)->read != NULL && !(*format)->read(job, text, &again, &error)) {
            require_sound(&error);
        }
    }
}

static void use(struct foreign_job *job, const struct lens *lens)
{
    struct lens_warnings warnings;
    struct first_order first;
    struct error error = {0};
    struct arena *arena = job->arena;
    struct text text = lens_write(lens, arena);
    struct lens again;
    if (!lens_check(lens, arena, &warnings, &error)) {
        require_sound(&error);
        return;
    }
    REQUIRE(lens_read("again.lens", text, NULL, arena, &again, &error));
    REQUIRE(again.surface_count == lens->surface_count);
    if (!first_order_of_lens(lens_at_position(lens, 0, arena), lens_primary_wavelength(lens),
                             SECTION_Y, arena, &first, &error)) {
        fuzz_require_error(&error);
    }
    if (lens_reversed(lens, arena, &error) == NULL) {
        fuzz_require_error(&error);
    }
    lens_scaled(lens, (struct pair){0.1, 0}, false, arena);
    write_all(job, lens_in_unit(lens, "in", arena));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *content = fuzz_copy(data, size);
    for (int lossy = 0; lossy < 2; lossy++) {
        for (const struct foreign_format *const *format = foreign_formats; *format != NULL;
             format++) {
            struct arena arena = {0};
            struct lens lens;
            struct error error = {0};
            const char *source = arena_printf(&arena, "fuzz%s", (*format)->type.ending);
            struct foreign_job job = {.source = source, .arena = &arena, .lossy = lossy != 0};
            if (foreign_read(&job, (struct text){content, size}, &lens, &error)) {
                use(&job, &lens);
            } else {
                require_sound(&error);
            }
            arena_free(&arena);
        }
    }
    free(content);
    return 0;
}
