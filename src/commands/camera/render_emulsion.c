/* commands/camera/render_emulsion.c - a picture on film, printed. */
/* SPDX-License-Identifier: MIT */
#include "camera/sensor/emulsion.h"
#include "commands/camera/render.h"
#include "photo/reciprocity.h"
#include "photo/sensitometry.h"

#include <math.h>
#include <string.h>

bool render_check_film(const struct artifact_job *job, struct error *error)
{
    const struct render_input *input = job->inputs[0];
    const struct film_value *film = &input->film;
    if (!render_is_film(input)) {
        return true;
    }
    if (film->type == NULL || strcmp(film->type, "panchromatic") != 0) {
        fail(error, ERROR_DOMAIN, "{--film} %s: the type of the film is %s", film->name,
             film->type == NULL ? "not known" : film->type);
        return error_hint(error, "only panchromatic negatives have a curve here, from their speed");
    }
    if (isnan(film->speed)) {
        return fail(error, ERROR_USAGE, "{--film} %s: the name does not say which speed, %s%s",
                    film->name, film->speed_note == NULL ? "and none is known" : "of ISO ",
                    film->speed_note == NULL ? "" : film->speed_note);
    }
    if (job->type != NULL && strcmp(job->type->ending, ".hdr") == 0) {
        fail(error, ERROR_USAGE, "a .hdr holds light, and a film has densities");
        return error_hint(error, "those are written as .pfm and .exr, its print as .png");
    }
    return true;
}

bool render_film_time(const struct render_input *input, double *time, double *metered,
                      struct error *error)
{
    *metered = isnan(*time) ? *metered : *time;
    if (!render_is_film(input)) {
        *time = *metered;
        return true;
    }
    return (isnan(*time) ? reciprocity_corrected(input->film.model, *metered, time, error)
                         : reciprocity_metered(input->film.model, *time, metered, error)) ||
           error_prefix(error, "%s: ", input->film.name);
}

static void emulsion_add_remarks(const struct render_input *input, const struct emulsion *film,
                                 const struct image *light, struct text_buffer *remarks)
{
    double least = (double)INFINITY, most = 0; /* of the luminous exposure */
    for (size_t i = 0; i < light->width * light->height; i++) {
        const double H = sensor_luminous(light->pixels + i * light->channels, light->channels);
        least = fmin(least, H);
        most = fmax(most, H);
    }
    growing_format(remarks,
                   "%s at ISO %.4g: densities %.3g to %.3g by a curve of gamma %.3g, made from "
                   "the speed, not measured\n",
                   input->film.name, input->film.speed, characteristic_density(&film->curve, least),
                   characteristic_density(&film->curve, most), film->curve.gradient);
    const double speed_point = characteristic_speed_point(&film->curve);
    if (!(most > 0)) {
        growing_format(remarks,
                       "warning: no light was found that reaches the film: it stays clear\n");
    } else if (most < speed_point) {
        growing_format(remarks,
                       "warning: the film stays clear: it takes %.3g times the time or the light "
                       "until the brightest reaches its speed point\n",
                       speed_point / most);
    }
    const double white =
        characteristic_print(&film->curve, characteristic_density(&film->curve, least));
    if (white > 1) {
        growing_format(remarks,
                       "warning: the whole print is white: 1/%.3g of the time makes the darkest "
                       "grey\n",
                       least / recommended_exposure(film->curve.negative.speed));
    }
}

bool render_develop(const struct render_input *input, bool is_print,
                    const struct render_frame *frame, struct image *image,
                    struct text_buffer *remarks, struct error *error)
{
    struct arena *arena = remarks->arena;
    static const char *const names[] = {"D"};
    const struct negative negative = negative_plain(input->film.speed);
    const struct sensor_place place = {frame->taken.left, frame->taken.top, frame->columns};
    struct emulsion film = {.granularity = isnan(input->grain) ? 0 : input->grain,
                            .pitch = render_frame_pitch(input, frame),
                            .seed = render_frame_seed(input, frame),
                            .threads = parallel_threads(input->threads)};
    struct image density;
    if (!characteristic_open(&negative, &film.curve, error) ||
        !emulsion_expose(&film, image, &place, arena, &density, error)) {
        return false;
    }
    emulsion_add_remarks(input, &film, image, remarks);
    const char *said = arena_printf(
        arena, "ISO 6 from the speed, gamma %.4g, base %.4g, most %.4g, granularity %.4g",
        film.curve.gradient, negative.base, negative.most, film.granularity);
    if (is_print) {
        emulsion_print(&film, &density);
    } else {
        density.names = names;
    }
    *image = density;
    image_note(image, arena, text_of("Film curve"), text_of(said));
    return true;
}
