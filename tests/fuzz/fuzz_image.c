/* tests/fuzz/fuzz_image.c - pictures of all formats: the input is the file. */
/* SPDX-License-Identifier: MIT */
#include "file/image_file.h"
#include "fuzz.h"

#include <math.h>

static const struct image_wish light = {.values = IMAGE_LIGHT};

static void require_image(const struct image *image, struct arena *arena)
{
    struct error error;
    REQUIRE(image->width >= 1 && image->width <= IMAGE_SIDE_MOST);
    REQUIRE(image->height >= 1 && image->height <= IMAGE_SIDE_MOST);
    REQUIRE(image->channels >= 1 && image->channels <= IMAGE_CHANNELS_MOST);
    REQUIRE(image_check(image, IMAGE_NUMBERS, &error));
    for (size_t i = 0; i < image->channels; i++) {
        REQUIRE(image_channel(image, i, arena)[0] != '\0');
    }
    for (size_t i = 0; i < image->note_count; i++) {
        REQUIRE(strpbrk(image->notes[i].value, "\n\r\t") == NULL);
    }
}

/* What was read can be written as floats, and is read again as it was. */
static void require_return(const struct image *image, struct arena *arena)
{
    const struct image_way way = {.packed = true};
    const struct file_type *exr = file_type_of(image_file_types, text_of("x.exr"));
    struct text bytes;
    struct image back;
    struct error error = {0};
    if (image->channels > 4) {
        return;
    }
    struct image plain = *image;
    plain.names = NULL;
    REQUIRE(image_file_bytes(&plain, exr, &way, arena, &bytes, &error));
    REQUIRE(image_file_parse("x", bytes, &light, arena, &back, &error));
    const size_t count = image->width * image->height * image->channels;
    REQUIRE(memcmp(back.pixels, image->pixels, count * sizeof(float)) == 0);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *content = fuzz_copy(data, size);
    struct arena arena = {0};
    struct error error = {0};
    struct image image;
    if (image_file_parse("fuzz", (struct text){content, size}, &light, &arena, &image, &error)) {
        require_image(&image, &arena);
        if (image.width * image.height < 4096) {
            require_return(&image, &arena);
        }
    } else {
        fuzz_require_error(&error);
        REQUIRE(error.code == ERROR_DATA);
    }
    arena_free(&arena);
    free(content);
    return 0;
}
