/* commands/camera/render_card.c - what is photographed: a picture or a chart, and its facts. */
/* SPDX-License-Identifier: MIT */
#include "base/choice.h"
#include "base/constants.h"
#include "commands/camera/render.h"
#include "file/image_file.h"

#include <string.h>

/* A word of charts. */
static bool find_chart(struct text name, enum chart *chart, struct error *error)
{
    struct choice choice = {.typed = name};
    for (size_t i = 0; charts[i].word != NULL; i++) {
        if (text_same(name, charts[i].word)) {
            *chart = (enum chart)(i + 1);
            return true;
        }
        choice_offer(&choice, charts[i].word);
    }
    return choice_refuse(&choice, error) || error_prefix(error, "chart ");
}

bool render_card(const struct render_input *input, struct arena *arena, struct card *card,
                 struct error *error)
{
    static const char prefix[] = "chart:";
    if (strncmp(input->subject, prefix, sizeof prefix - 1) == 0) {
        return find_chart(text_of(input->subject + sizeof prefix - 1), &card->chart, error);
    }
    const struct image_wish wish = {IMAGE_LIGHT, IMAGE_SEEN_MOST};
    struct image *picture = ARENA_NEW(arena, struct image);
    card->picture = picture;
    return image_file_read(input->subject, &wish, arena, picture, error) &&
           (image_check(picture, IMAGE_POSITIVE, error) ||
            error_prefix(error, "%.200s: ", input->subject));
}

/* Cycles a mm on the film of as many over the width of the card. */
static double on_film(const struct photograph *photograph, const struct setup *setup, double cycles)
{
    return cycles / photograph->card.width / fabs(setup->first.magnification);
}

static void say_bars(const struct photograph *photograph, const struct setup *setup,
                     struct text_buffer *remarks)
{
    growing_format(remarks, "bars of");
    for (int i = 0; i < CHART_GROUPS; i++) {
        growing_format(remarks, "%s %.4g", i == 0 ? "" : ",",
                       on_film(photograph, setup, ldexp(CHART_BARS_LEAST, i)));
    }
    growing_format(remarks, " cycles/mm on the film\n");
}

static void say_picture(const char *path, const struct image *picture, struct text_buffer *remarks)
{
    const char *remark = image_file_remark(path, picture, remarks->arena);
    if (remark != NULL) {
        growing_format(remarks, "%s\n", remark);
    }
}

void render_say_card(const struct render_input *input, const struct photograph *photograph,
                     const struct setup *setup, struct text_buffer *remarks)
{
    const struct card *card = &photograph->card;
    const double rim = 2 * PI * CHART_STAR_RADIUS * card->height / card->width;
    const double mesh = card->width / CHART_MESHES;
    switch (card->chart) {
    case CHART_EDGE:
        growing_format(remarks, "edge %g degrees from upright, contrast %g:1 (ISO 12233)\n",
                       CHART_EDGE_DEGREES, 1 / CHART_EDGE_DARK);
        break;
    case CHART_STAR:
        growing_format(remarks,
                       "%d cycles about the middle: %.4g cycles/mm on the film at the rim, twice "
                       "that at half its radius\n",
                       CHART_STAR_CYCLES, on_film(photograph, setup, CHART_STAR_CYCLES / rim));
        break;
    case CHART_BARS:
        say_bars(photograph, setup, remarks);
        break;
    case CHART_WEDGE:
        growing_format(remarks, "%d greys, densities 0 to %.4g\n", CHART_WEDGE_FIELDS,
                       0.5 * (CHART_WEDGE_FIELDS - 1) * log10(2));
        break;
    case CHART_GRID:
        growing_format(remarks, "meshes of %.4g mm\n", mesh);
        break;
    case CHART_CHECKER:
        growing_format(remarks, "squares of %.4g mm\n", mesh);
        break;
    case CHART_POINTS:
        growing_format(remarks, "discs, in steps of %.4g mm\n", mesh);
        break;
    case CHART_STARS:
        growing_format(remarks, "stars of magnitudes 0 to %d, the brightest as bright as white\n",
                       CHART_MAGNITUDES);
        break;
    case CHART_NONE:
        say_picture(input->subject, card->picture, remarks);
        break;
    }
}
