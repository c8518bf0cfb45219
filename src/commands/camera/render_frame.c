/* commands/camera/render_frame.c - the pixels of a picture: how many, and which of them. */
/* SPDX-License-Identifier: MIT */
#include "base/number.h"
#include "commands/camera/render.h"

#include <string.h>

enum { USUAL_COLUMNS = 480 };

/* Around a crop: what is interpolated in a mosaic needs the pixels beside it. */
enum { MARGIN = 2 };

bool render_numbers(const char *text, const char *marks, bool are_whole, double *numbers)
{
    for (size_t i = 0; i <= strlen(marks); i++) {
        const size_t digits = strspn(text, "0123456789");
        const bool is_bare = digits > 0 || (*text == '.' && !are_whole);
        const char *end = text + (are_whole ? digits : strlen(text));
        end = is_bare ? number_read(text, end, NUMBER_UNSCALED, &numbers[i]) : NULL;
        if (end == NULL || (*end != marks[i] && !(*end == 'X' && marks[i] == 'x'))) {
            return false;
        }
        text = end + 1;
    }
    return true;
}

/* Are they numbers of pixels that a picture can have? */
static bool are_sides(const double *numbers, size_t count)
{
    bool are = true;
    for (size_t i = 0; i < count; i++) {
        are = are && numbers[i] >= 1 && numbers[i] <= IMAGE_SIDE_MOST;
    }
    return are;
}

static bool read_size(const struct render_input *input, struct render_frame *frame,
                      struct error *error)
{
    const struct sensor *film = &input->sensor.size;
    if (input->size == NULL) {
        frame->columns = USUAL_COLUMNS;
        frame->rows = (size_t)fmax(1, round(USUAL_COLUMNS * film->height / film->width));
        return true;
    }
    double size[2];
    if (!render_numbers(input->size, "x", true, size) || !are_sides(size, 2)) {
        return fail(error, ERROR_USAGE,
                    "{--size} '%.40s': two whole numbers of 1 to %d, as 360x240", input->size,
                    IMAGE_SIDE_MOST);
    }
    frame->columns = (size_t)size[0];
    frame->rows = (size_t)size[1];
    return true;
}

static bool read_crop(const struct render_input *input, struct render_frame *frame,
                      struct error *error)
{
    struct image_area *crop = &frame->crop;
    *crop = (struct image_area){0, 0, frame->columns, frame->rows};
    if (input->crop == NULL) {
        return true;
    }
    double area[4]; /* "100:50:64x32" */
    if (!render_numbers(input->crop, "::x", true, area) || !are_sides(area + 2, 2) ||
        !(area[0] <= IMAGE_SIDE_MOST && area[1] <= IMAGE_SIDE_MOST)) {
        return fail(error, ERROR_USAGE,
                    "{--crop} '%.40s': pixels to its left and above it, then its size, as "
                    "100:50:64x32",
                    input->crop);
    }
    *crop = (struct image_area){(size_t)area[0], (size_t)area[1], (size_t)area[2], (size_t)area[3]};
    return (crop->left + crop->width <= frame->columns &&
            crop->top + crop->height <= frame->rows) ||
           fail(error, ERROR_USAGE, "{--crop} %.40s: the picture has %zux%zu pixels", input->crop,
                frame->columns, frame->rows);
}

static size_t less(size_t number, size_t by)
{
    return number > by ? number - by : 0;
}

bool render_frame_read(const struct render_input *input, struct render_frame *frame,
                       struct error *error)
{
    if (!read_size(input, frame, error) || !read_crop(input, frame, error)) {
        return false;
    }
    frame->number = 0;
    const struct image_area *crop = &frame->crop;
    const size_t margin = render_senses(input) && !input->raw ? MARGIN : 0;
    struct image_area *taken = &frame->taken;
    *taken = (struct image_area){less(crop->left, margin), less(crop->top, margin), 0, 0};
    const size_t right = crop->left + crop->width + margin;
    const size_t bottom = crop->top + crop->height + margin;
    taken->width = (right < frame->columns ? right : frame->columns) - taken->left;
    taken->height = (bottom < frame->rows ? bottom : frame->rows) - taken->top;
    return true;
}

double render_aspect(const struct render_input *input, const struct render_frame *frame)
{
    const struct sensor *film = &input->sensor.size;
    const double columns = (double)frame->columns, rows = (double)frame->rows;
    const double wide = film->width / columns, high = film->height / rows; /* of a pixel */
    const bool is_rounded =
        fabs(film->width / high - columns) <= 0.5 || fabs(film->height / wide - rows) <= 0.5;
    return is_rounded ? 0 : wide / high;
}

void render_say_size(const struct render_input *input, const struct render_frame *frame,
                     struct text_buffer *remarks)
{
    const struct sensor *film = &input->sensor.size;
    const double aspect = render_aspect(input, frame);
    if (aspect > 0) {
        growing_format(remarks,
                       "warning: %zux%zu pixels on %.6g x %.6g mm are each %.4g times as wide as "
                       "high: shown as squares they distort the picture\n",
                       frame->columns, frame->rows, film->width, film->height, aspect);
    }
}

bool render_frame_cut(const struct render_frame *frame, struct arena *arena, struct image *image,
                      struct error *error)
{
    const struct image_area *crop = &frame->crop;
    struct image cut = *image;
    cut.width = crop->width;
    cut.height = crop->height;
    if (cut.width == image->width && cut.height == image->height) {
        return true;
    }
    if (!image_new(&cut, arena, error)) {
        return false;
    }
    for (size_t y = 0; y < cut.height; y++) {
        memcpy(image_row(&cut, y),
               image_row(image, y + crop->top - frame->taken.top) +
                   (crop->left - frame->taken.left) * image->channels,
               cut.width * cut.channels * sizeof(float));
    }
    *image = cut;
    return true;
}
