/* draw/lettering.c - numbers written in pixels. */
/* SPDX-License-Identifier: MIT */
#include "draw/lettering.h"

/* Rows from the top, three dots in each. */
static const struct {
    char letter;
    char rows[LETTERING_HIGH][LETTERING_WIDE + 1];
} letters[] = {
    {'0', {"###", "# #", "# #", "# #", "###"}}, {'1', {" # ", "## ", " # ", " # ", "###"}},
    {'2', {"###", "  #", "###", "#  ", "###"}}, {'3', {"###", "  #", " ##", "  #", "###"}},
    {'4', {"# #", "# #", "###", "  #", "  #"}}, {'5', {"###", "#  ", "###", "  #", "###"}},
    {'6', {"###", "#  ", "###", "# #", "###"}}, {'7', {"###", "  #", "  #", " # ", " # "}},
    {'8', {"###", "# #", "###", "# #", "###"}}, {'9', {"###", "# #", "###", "  #", "###"}},
    {'.', {"   ", "   ", "   ", "   ", " # "}}, {'-', {"   ", "   ", "###", "   ", "   "}},
    {'+', {"   ", " # ", "###", " # ", "   "}}, {'/', {"  #", "  #", " # ", "#  ", "#  "}},
    {'c', {"   ", "   ", "###", "#  ", "###"}}, {'d', {"  #", "  #", "###", "# #", "###"}},
    {'e', {"   ", "###", "###", "#  ", "###"}}, {'m', {"   ", "   ", "###", "###", "# #"}},
};

static void put_dot(struct image *image, size_t x, size_t y, size_t size)
{
    for (size_t row = y; row < y + size && row < image->height; row++) {
        for (size_t column = x; column < x + size && column < image->width; column++) {
            float *pixel = image_row(image, row) + column * image->channels;
            for (size_t k = 0; k < image->channels; k++) {
                pixel[k] = 1;
            }
        }
    }
}

void lettering_write(struct image *image, size_t x, size_t y, size_t size, const char *text)
{
    for (; *text != '\0'; text++, x += LETTERING_STEP * size) {
        for (size_t i = 0; i < sizeof letters / sizeof letters[0]; i++) {
            for (size_t dot = 0; dot < LETTERING_HIGH * LETTERING_WIDE; dot++) {
                const size_t row = dot / LETTERING_WIDE, column = dot % LETTERING_WIDE;
                if (letters[i].letter == *text && letters[i].rows[row][column] == '#') {
                    put_dot(image, x + column * size, y + row * size, size);
                }
            }
        }
    }
}
