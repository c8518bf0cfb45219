/* tests/fuzz/fuzz_exif.c - photographs: the input is a JPEG or TIFF, or what exiftool prints. */
/* SPDX-License-Identifier: MIT */
#include "../unit/exif_memory.h"
#include "exchange/metadata/exiftool.h"
#include "fuzz.h"

#include <math.h>

static void require_name(const char name[METADATA_NAME])
{
    REQUIRE(memchr(name, '\0', METADATA_NAME) != NULL);
    for (const char *at = name; *at != '\0'; at++) {
        REQUIRE(*at >= ' ' && *at <= '~');
    }
}

static void require_number(double number)
{
    REQUIRE(isnan(number) || (number > 0 && isfinite(number)));
}

static void require_metadata(const struct metadata *metadata)
{
    require_name(metadata->make);
    require_name(metadata->model);
    require_number(metadata->focal);
    require_number(metadata->equivalent);
    require_number(metadata->fnumber);
    require_number(metadata->time);
    require_number(metadata->iso);
    require_number(metadata->long_side);
    require_number(metadata->low_side);
    REQUIRE(isnan(metadata->distance) || metadata->distance > 0);
    REQUIRE(!(metadata->long_side < metadata->low_side));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *content = fuzz_copy(data, size);
    const struct text text = {content, size};
    const struct exif_bytes bytes = exif_memory(content, size);
    struct arena arena = {0};
    struct metadata metadata;
    struct error error = {0};
    if (!exif_read(&bytes, &metadata, &error)) {
        fuzz_require_error(&error);
        REQUIRE(error.code == ERROR_DATA);
    }
    require_metadata(&metadata);
    struct exiftool_file files[] = {
        {.path = "a.jpg"}, {.path = "b\n.jpg"}, {.path = "\xff.cr3"}, {.path = "a.jpg"}};
    exiftool_take(text, files, sizeof files / sizeof files[0], &arena);
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        if (files[i].is_answered) {
            require_metadata(&files[i].metadata);
        }
    }
    arena_free(&arena);
    free(content);
    return 0;
}
