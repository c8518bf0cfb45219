/* exchange/codev/codev_read.c - read a CODE V sequence file. */
/* SPDX-License-Identifier: MIT */
#include "exchange/codev/codev.h"

#include "exchange/entrance_pupil.h"
#include "exchange/keep_notes.h"
#include "exchange/merge_positions.h"

#include <string.h>

static const struct command_grammar grammar = {
    .comment = "!", .quotes = "'\"", .separator = ';', .continuation = '&', .infinity = 1e10};

static bool codev_paraxial_image(struct codev *codev)
{
    codev->image_solve = codev->commands.words[0];
    return commands_end(&codev->commands, 1);
}

/* TEL Y, AFC Y: a telecentric object space, an afocal image space. */
static bool codev_space(struct codev *codev)
{
    const struct command_word word = commands_word(&codev->commands, 1);
    const bool yes = text_same(word.text, "Y") || text_same(word.text, "YES");
    if (!yes && !text_same(word.text, "N") && !text_same(word.text, "NO")) {
        return commands_fail(&codev->commands, &word, "expected Y or N here");
    }
    if (codev->what == 'T') {
        codev->build.lens->is_telecentric = yes;
    } else {
        codev->sequence.is_afocal = yes;
    }
    return commands_end(&codev->commands, 2);
}

/* Nothing stands behind GO; a macro that goes on is refused. */
static bool codev_end(struct codev *codev)
{
    codev->job->has_end = true;
    return true;
}

/* A command that is lost by its group, but where its numbers are 0. */
static bool codev_lose_command(struct codev *codev, const struct word_group *group)
{
    if (!codev_qualifiers(codev, 1, &codev->here)) {
        return false;
    }
    return ((group->flags & WORD_COUNTS_AT_0) == 0 && codev_is_zero(codev, codev->here.next)) ||
           commands_lose(&codev->commands, word_group_effect(group), NULL, group->what);
}

/* VUX, VLX, VUY, VLY: the first that is not 0 is kept until the diameters are known. */
static bool codev_vignetting_factor(struct codev *codev)
{
    if (!codev_is_zero(codev, codev->here.next) && codev->vignetting.text.length == 0) {
        codev->vignetting = codev->commands.words[0];
    }
    return true;
}

/* The factors narrow the beams as rims do; where all surfaces have diameters these do it here. */
static void codev_settle_vignetting(struct codev *codev)
{
    const struct lens *lens = codev->build.lens;
    bool all = true;
    if (codev->vignetting.text.length == 0) {
        return;
    }
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *one = &lens->surfaces[i];
        const bool bends =
            !one->is_plane || one->has_curvature || surface_reflects(one) ||
            !medium_is_same(i > 0 ? &one[-1].medium : &lens->object_medium, &one->medium);
        all = all && (!bends || one->has_diameter || one->aperture_count > 0);
    }
    if (all) {
        lens_build_note(&codev->build, text_of("vignetting factors of the fields: the clear "
                                               "diameters limit the beams"));
        return;
    }
    commands_loss(&codev->commands, &codev->vignetting, LOSS_OF_VIGNETTING, NULL,
                  "%.3s: vignetting factors of the fields", codev->vignetting.text.start);
}

/* TEM in C, PRE in mm of mercury. */
static bool codev_environment(struct codev *codev)
{
    return sequence_environment(&codev->sequence, codev->what == 'T', 760);
}

/* What a command is of. Qualifiers, Sk Zk Fk Wk, are read into codev->here. */
enum codev_scope {
    CODEV_LENS,   /* of the lens, without qualifiers */
    CODEV_PART,   /* of what qualifiers narrow it to */
    CODEV_EACH,   /* of each surface of a range */
    CODEV_ONE,    /* of one surface */
    CODEV_PICK_UP /* of surfaces that it names itself */
};

/* Commands and what tells relatives apart; the first three letters count. */
static const struct {
    char key[4];
    codev_command *run; /* null: nothing becomes of it */
    int what;
    enum codev_scope scope;
} keywords[] = {
    {"RDM", codev_radius_mode, 0, CODEV_LENS},
    {"LEN", NULL, 0, CODEV_LENS},
    {"TIT", codev_title, 0, CODEV_PART},
    {"DIM", NULL, 0, CODEV_LENS}, /* read before all others */
    {"WL", codev_waves, 'L', CODEV_PART},
    {"WTW", codev_waves, 'W', CODEV_PART},
    {"REF", codev_reference, 0, CODEV_LENS},
    {"EPD", codev_aperture_of_lens, APERTURE_EPD, CODEV_PART},
    {"FNO", codev_aperture_of_lens, APERTURE_FNUMBER, CODEV_PART},
    {"NAO", codev_aperture_of_lens, APERTURE_NA, CODEV_PART},
    {"NA", codev_aperture_of_lens, CODEV_IMAGE_NA, CODEV_PART},
    {"XAN", codev_fields, 'A', CODEV_PART},
    {"YAN", codev_fields, 'a', CODEV_PART},
    {"XOB", codev_fields, 'O', CODEV_PART},
    {"YOB", codev_fields, 'o', CODEV_PART},
    {"XIM", codev_fields, 'I', CODEV_PART},
    {"YIM", codev_fields, 'i', CODEV_PART},
    {"XRI", codev_fields, 'R', CODEV_PART},
    {"YRI", codev_fields, 'r', CODEV_PART},
    {"WTF", codev_fields, 'w', CODEV_PART},
    {"RDY", codev_curve, 'R', CODEV_EACH},
    {"CUY", codev_curve, 'C', CODEV_EACH},
    {"RDX", codev_curve, 'r', CODEV_EACH},
    {"CUX", codev_curve, 'c', CODEV_EACH},
    {"THI", codev_thickness, 0, CODEV_EACH},
    {"GLA", codev_glass, 0, CODEV_EACH},
    {"RMD", codev_glass, 0, CODEV_EACH},
    {"CYL", codev_shape, 0, CODEV_EACH},
    {"SPH", NULL, 0, CODEV_LENS},
    {"CON", NULL, 0, CODEV_LENS},
    {"ASP", NULL, 0, CODEV_LENS},
    {"K", codev_constant, 0, CODEV_EACH},
    {"A", codev_constant, 4, CODEV_EACH},
    {"B", codev_constant, 6, CODEV_EACH},
    {"C", codev_constant, 8, CODEV_EACH},
    {"D", codev_constant, 10, CODEV_EACH},
    {"E", codev_constant, 12, CODEV_EACH},
    {"F", codev_constant, 14, CODEV_EACH},
    {"G", codev_constant, 16, CODEV_EACH},
    {"H", codev_constant, 18, CODEV_EACH},
    {"J", codev_constant, 20, CODEV_EACH},
    {"SPS", codev_special, 0, CODEV_EACH},
    {"SCO", codev_special_constant, 0, CODEV_EACH},
    {"STO", codev_stop, 0, CODEV_ONE},
    {"SLB", codev_label, 0, CODEV_EACH},
    {"CIR", codev_aperture, 'C', CODEV_EACH},
    {"REX", codev_aperture, 'x', CODEV_EACH},
    {"REY", codev_aperture, 'y', CODEV_EACH},
    {"ELX", codev_aperture, 'X', CODEV_EACH},
    {"ELY", codev_aperture, 'Y', CODEV_EACH},
    {"ADX", codev_aperture_shift, 'X', CODEV_EACH},
    {"ADY", codev_aperture_shift, 'Y', CODEV_EACH},
    {"XDE", codev_shift, 'X', CODEV_EACH},
    {"YDE", codev_shift, 'Y', CODEV_EACH},
    {"ZDE", codev_shift, 'Z', CODEV_EACH},
    {"ADE", codev_shift, 'A', CODEV_EACH},
    {"BDE", codev_shift, 'B', CODEV_EACH},
    {"CDE", codev_shift, 'C', CODEV_EACH},
    {"DAR", codev_move, SEQUENCE_BACK, CODEV_EACH},
    {"BEN", codev_move, SEQUENCE_BEND, CODEV_EACH},
    {"REV", codev_move, SEQUENCE_RETURN, CODEV_EACH},
    {"PIM", codev_paraxial_image, 0, CODEV_LENS},
    {"TEL", codev_space, 'T', CODEV_LENS},
    {"AFC", codev_space, 'A', CODEV_LENS},
    {"PIK", codev_pickup, 0, CODEV_PICK_UP},
    {"ZOO", NULL, 0, CODEV_LENS}, /* what it has not become */
    {"PRV", codev_catalog, 'P', CODEV_LENS},
    {"PWL", codev_catalog, 'W', CODEV_LENS},
    {"END", codev_catalog, 'P', CODEV_LENS},
    {"TEM", codev_environment, 'T', CODEV_LENS},
    {"PRE", codev_environment, 'P', CODEV_LENS},
    {"GO", codev_end, 0, CODEV_LENS},
    {"VUX", codev_vignetting_factor, 0, CODEV_PART},
    {"VLX", codev_vignetting_factor, 0, CODEV_PART},
    {"VUY", codev_vignetting_factor, 0, CODEV_PART},
    {"VLY", codev_vignetting_factor, 0, CODEV_PART},
};

/* Of a range of surfaces, S3..5, each gets what the command says. */
static bool codev_run_on_surfaces(struct codev *codev, codev_command *run)
{
    const size_t end = codev->here.end;
    for (size_t i = codev->here.surface; i <= end; i++) {
        codev->here.surface = i;
        if (!run(codev)) {
            return false;
        }
    }
    return true;
}

static bool is_codev_surface(struct text word)
{
    char second = word.length > 1 ? (char)(word.start[1] | 32) : 0;
    bool named = word.length == 2 && (second == 'o' || second == 'i');
    return (word.start[0] | 32) == 's' &&
           (word.length == 1 || named || (second >= '0' && second <= '9'));
}

/* A command without a reader: the table says what becomes of it. */
static bool codev_run_group(struct codev *codev, struct text word)
{
    const struct word_group *group = codev_group(word);
    if (word.start[0] == '^' || (group != NULL && group->fate == WORD_REFUSED)) {
        return commands_fail(&codev->commands, &codev->commands.words[0],
                             "a command of a macro: lenscalc reads lens data and runs no macros");
    }
    return group == NULL ? commands_lose(&codev->commands, LOSS_OF_RAYS, NULL, "an unknown command")
                         : group->fate == WORD_HARMLESS || codev_lose_command(codev, group);
}

static bool codev_run_command(struct codev *codev)
{
    const struct command_word *word = &codev->commands.words[0];
    bool is_here = true;
    if (!codev->in_catalog && !codev_place(codev, &is_here)) {
        return false;
    }
    const struct codev_key key = codev_key(word->text);
    if (!is_here) {
        return true;
    }
    if (codev->in_catalog &&
        (word->is_quoted || (strcmp(key.letters, "PWL") != 0 && strcmp(key.letters, "END") != 0))) {
        return codev_private_glass(codev);
    }
    if (word->is_quoted || word->text.length == 0) {
        return commands_fail(&codev->commands, word, "text where a command is expected");
    }
    if (is_codev_surface(word->text)) {
        return codev_surface(codev);
    }
    for (size_t i = 0; i < sizeof keywords / sizeof keywords[0]; i++) {
        if (strcmp(keywords[i].key, key.letters) != 0) {
            continue;
        }
        const enum codev_scope scope = keywords[i].scope;
        if (scope >= CODEV_EACH && codev->sequence.count == 0) {
            return commands_fail(&codev->commands, word, "'%s' before the first surface",
                                 keywords[i].key);
        }
        if (scope != CODEV_LENS && scope != CODEV_PICK_UP &&
            !codev_qualifiers(codev, 1, &codev->here)) {
            return false;
        }
        codev->what = keywords[i].what;
        return keywords[i].run == NULL ||
               (scope == CODEV_EACH ? codev_run_on_surfaces(codev, keywords[i].run)
                                    : keywords[i].run(codev));
    }
    return codev_run_group(codev, word->text);
}

/* FNO of a near object is the working f-number: it becomes the entrance pupil that gives it. */
static bool codev_finish_lens(struct codev *codev)
{
    struct sequence *sequence = &codev->sequence;
    struct lens *lens = codev->build.lens;
    const struct command_word *at = &sequence->surfaces[0].at;
    const double working = lens->aperture.value.hi;
    if (lens->aperture_kind != APERTURE_FNUMBER || !sequence_is_near(sequence)) {
        return sequence_finish(sequence);
    }
    lens->aperture_kind = APERTURE_NONE;
    sequence->is_open = true;
    return sequence_finish(sequence) &&
           (entrance_pupil_set(lens, PUPIL_WORKING_FNUMBER, working, codev->job->arena) ||
            commands_loss(&codev->commands, at, LOSS_OF_RAYS, "the lens gets no aperture",
                          "a working f-number that no entrance pupil gives"));
}

static bool codev_finish_file(struct codev *codev)
{
    struct sequence *sequence = &codev->sequence;
    if (!codev->has_image) {
        return foreign_fail(codev->job, codev->commands.error, "the file has no image surface SI");
    }
    if (!codev->job->has_end) {
        foreign_cut_short(codev->job, "no GO stands at its end");
    }
    for (size_t i = 0; i < sequence->count; i++) {
        if (!codev_find_glass(codev, &sequence->surfaces[i])) {
            return false;
        }
    }
    if (codev->image_solve.text.length > 0 && sequence->count > 2) {
        sequence->surfaces[sequence->count - 2].thickness_solve =
            (struct sequence_solve){.is_set = true, .at = codev->image_solve};
    }
    if (!codev_finish_system(codev) || !codev_finish_lens(codev)) {
        return false;
    }
    codev_settle_vignetting(codev);
    return codev_check_mode(codev);
}

/* What lenscalc itself has written as comments. */
static struct keep_notes codev_kept_notes(struct text content)
{
    struct keep_notes notes = {0};
    for (struct text rest = content; rest.start != NULL;) {
        keep_notes_take(&notes, text_behind(text_trim(text_cut(&rest, '\n')), CODEV_KEEP_NOTE));
    }
    return notes;
}

static void codev_apply_notes(struct codev *codev, struct text content)
{
    struct lens *lens = codev->build.lens;
    const struct keep_notes notes = codev_kept_notes(content);
    for (struct text rest = content; rest.start != NULL;) {
        const struct text kept = text_behind(text_trim(text_cut(&rest, '\n')), CODEV_KEEP_NOTE);
        const struct text note = text_behind(kept, CODEV_NOTE);
        if (text_equal(kept, CODEV_STOP_RULES)) {
            lens->aperture_kind = APERTURE_STOP;
            lens->aperture = (struct figure){.typed = text_of("stop"), .variable = LENS_NONE};
        } else if (note.start != NULL) {
            lens_build_note(&codev->build, note);
        }
    }
    keep_notes_apply(&notes, &codev->build);
}

/* The lens of the present position. */
static bool codev_read_position(void *state, size_t position, struct text content,
                                struct lens *lens, struct error *error)
{
    struct codev *codev = state;
    const struct number_scale scale = codev->commands.scale;
    const char *unit = codev->build.lens->unit;
    codev->position = position;
    codev->vignetting = (struct command_word){.text = {NULL, 0}};
    lens_build_begin(&codev->build, lens, codev->job->arena);
    lens->unit = unit;
    commands_open(&codev->commands, codev->job, content, &grammar, error);
    codev->commands.scale = scale;
    codev->sequence = (struct sequence){.job = codev->job,
                                        .commands = &codev->commands,
                                        .build = &codev->build,
                                        .has_positions = codev->positions > 0,
                                        .environment = {.temperature = 20, .pressure = 1}};
    while (commands_next(&codev->commands)) {
        if (!codev_run_command(codev)) {
            return false;
        }
    }
    if (error->code != ERROR_NONE) {
        return false;
    }
    codev_apply_notes(codev, content);
    return codev_finish_file(codev);
}

/* A file with positions is read once for each of them. */
static bool codev_read(struct foreign_job *job, struct text content, struct lens *lens,
                       struct error *error)
{
    struct codev *first = ARENA_NEW(job->arena, struct codev);
    first->job = job;
    lens_build_begin(&first->build, lens, job->arena);
    commands_open(&first->commands, job, content, &grammar, error);
    while (commands_next(&first->commands)) { /* the unit stands anywhere, ZOO behind everything */
        const struct codev_key key = codev_key(first->commands.words[0].text);
        const bool quoted = first->commands.words[0].is_quoted;
        if ((strcmp(key.letters, "DIM") == 0 && !quoted && !codev_unit(first)) ||
            (strcmp(key.letters, "ZOO") == 0 && !quoted && !codev_set_positions(first))) {
            return false;
        }
    }
    if (error->code != ERROR_NONE) {
        return false;
    }
    struct lens_build build = first->build;
    const struct merge_file file = {content, first->names,  first->positions,
                                    first,   sizeof *first, codev_read_position};
    if (!merge_read(&build, job, &file, error)) {
        return false;
    }
    if (first->positions > 0) { /* they state a number for each position */
        const struct keep_notes notes = codev_kept_notes(content);
        keep_notes_apply(&notes, &build);
    }
    return true;
}

/* Lines that begin with S O and with S I, or RDM. */
static bool codev_is_like(struct text content)
{
    bool object = false, image = false;
    for (struct text rest = content; rest.start != NULL;) {
        struct text line = text_trim(text_cut(&rest, '\n')), word = text_cut(&line, ' ');
        object = object || text_same(word, "SO") || text_same(word, "RDM;LEN");
        image = image || text_same(word, "SI");
    }
    return object && image;
}

const struct foreign_format codev_format = {.type = {{"seq", "CODE V"}, ".seq"},
                                            .is_like = codev_is_like,
                                            .read = codev_read,
                                            .write = codev_write,
                                            .words = codev_words,
                                            .has_settings = true,
                                            .has_apertures = true,
                                            .has_glass_numbers = true};
