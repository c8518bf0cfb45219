/* exchange/zemax/zemax_tail.c - what stands behind the surfaces of a .zmx. */
/* SPDX-License-Identifier: MIT */
#include "exchange/zemax/zemax_keyword.h"

#include <math.h>

static bool read_configurations(struct zemax_file *file, struct text keyword, struct error *error)
{
    const struct zemax_line *line = zemax_line_of(file, keyword, NUMBER_UNSCALED);
    double count = zemax_number(line, 0);
    if (!zemax_all_numbers(line, error)) {
        return false;
    }
    if (!(count >= 1 && count <= ZEMAX_CONFIGURATIONS)) {
        return file_words_fail(&file->words, keyword, error,
                               "MNUM needs the number of configurations, 1 to %d",
                               ZEMAX_CONFIGURATIONS);
    }
    file->configurations = (size_t)count;
    file->shown = (size_t)fmax(0, fmin(zemax_number(line, 1), ZEMAX_CONFIGURATIONS));
    file->in_tail = file->has_configurations = true;
    return true;
}

bool zemax_read_setting(struct zemax_file *file, struct text keyword, struct error *error)
{
    static const char *const lengths[] = {"THIC", "SDIA", "APMN", "APMX", "APDX", "APDY"};
    struct number_scale unit = NUMBER_UNSCALED;
    for (size_t i = 0; i < sizeof lengths / sizeof lengths[0]; i++) {
        unit = text_same(keyword, lengths[i]) ? file->words.scale : unit;
    }
    const struct zemax_line *line = zemax_line_of(file, keyword, NUMBER_UNSCALED);
    if (text_same(keyword, "IGNR") && zemax_number(line, 2) != 0) {
        return zemax_loss(file, line, error, "IGNR: a surface that is left out" LOSS_OF_POWER);
    }
    if (text_behind(keyword, "FV").start != NULL) { /* a vignetting factor */
        bool is_some = zemax_number(line, 2) != 0 && file->vignetting == NULL;
        file->vignetting = is_some ? line : file->vignetting;
        return true;
    }
    if (file->configurations < 2) {
        return true; /* the only configuration has these values already */
    }
    double surface = zemax_number(line, 0), configuration = zemax_number(line, 1);
    if (line->count < 2 || !(surface >= 0 && surface < FOREIGN_MOST_SURFACES) ||
        !(configuration >= 1 && configuration <= (double)file->configurations)) {
        return file_words_fail(&file->words, keyword, error,
                               "%.4s needs a surface, a configuration and its value",
                               keyword.start);
    }
    struct zemax_line *own = zemax_line_of(file, keyword, unit);
    struct zemax_setting *setting = ARENA_NEW(file->job->arena, struct zemax_setting);
    *setting = (struct zemax_setting){own, (long)surface, (long)configuration, NULL};
    if (file->last_setting != NULL) {
        file->last_setting->next = setting;
    } else {
        file->settings = setting;
    }
    file->last_setting = setting;
    return true;
}

const struct zemax_keyword zemax_tail_keywords[] = {{"MNUM", read_configurations}, {NULL, NULL}};
