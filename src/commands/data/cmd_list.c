/* commands/data/cmd_list.c - lenscalc list: what the program knows. */
/* SPDX-License-Identifier: MIT */
#include "commands/data/list.h"
#include "commands/tables.h"

static const struct word topic_words[] = {
    {"lenses", "lenses with their prescriptions"},
    {"formats", "film and sensor formats"},
    {"cameras", "digital cameras, cine cameras with their modes, phones, drones, "
                "cameras of telescopes, image sensors"},
    {"films", "films, with the correction of long exposures"},
    {"scenes", "typical scenes and their light"},
    {"filters", "filters and their light loss"},
    {"glasses", "optical glasses and plastics of all catalogues"},
    {"tolerances", "published tolerances by grade"},
    {"stops", "labels of f-numbers, times and ISO, with exact values"},
    {"units", "units of every dimension"},
    {"keywords", "words of other programs' lens files, and what becomes of them"},
    {"commands", "commands of this program"},
    {"options", "options of every command"},
    {"columns", "columns that a command prints: list columns dof"},
    {"config", "your own defaults and kits, and which file they are from"},
    {NULL, NULL},
};

/* In the order of topic_words. */
static const struct topic *const topics[] = {
    &topic_lenses,   &topic_formats,  &topic_cameras,    &topic_films,   &topic_scenes,
    &topic_filters,  &topic_glasses,  &topic_tolerances, &topic_stops,   &topic_units,
    &topic_keywords, &topic_commands, &topic_options,    &topic_columns, &topic_config,
};

#define INPUT struct list_input

static const struct option options[] = {
    {ASKED(topic), .name = "topic", .words = topic_words, .value = "TOPIC", .fallback = "commands",
     .flags = OPTION_OPERAND, .help = "what to list"},
    {ASKED(search), .name = "search", .value = "WORDS", .flags = OPTION_OPERAND | OPTION_REST,
     .help = "only what contains these words"},
    {ASKED(kind), .name = "kind", .value = "KIND",
     .help = "only this class of lenses or formats, maker of cameras or films, kind of filters, "
             "catalogue of glasses, grade of tolerances, series of stops, dimension of units, "
             "format of keywords, group of commands, command of options and columns, command or "
             "kit of config"},
};

static const struct sheet *const sheets[] = {
    &topic_lenses.sheet,  &topic_formats.sheet, &topic_cameras.sheet,  &topic_films.sheet,
    &topic_scenes.sheet,  &topic_filters.sheet, &topic_glasses.sheet,  &topic_tolerances.sheet,
    &topic_stops.sheet,   &topic_units.sheet,   &topic_keywords.sheet, &topic_commands.sheet,
    &topic_options.sheet, &topic_columns.sheet, &topic_config.sheet,   NULL};

static const struct sheet *list_choose_sheet(const void *data, const struct option_query *asking)
{
    (void)asking;
    const struct list_input *input = data;
    return &topics[input->topic]->sheet;
}

static bool list_run(const void *data, struct run *run, struct error *error)
{
    const struct list_input *input = data;
    const struct topic *topic = topics[input->topic];
    struct list list = {.input = input, .topic = topic, .run = run};
    for (int i = 0; i < (topic->is_of_places ? LENSDB_PLACES : 1); i++) {
        list.place = (enum lensdb_place)i;
        if (!topic->list(&list, error)) {
            return false;
        }
    }
    return list.found != 0 ||
           fail(error, ERROR_DOMAIN, "nothing among the %s matches %s%s%s%s",
                topic_words[input->topic].word, input->search != NULL ? input->search : "",
                input->search != NULL && input->kind != NULL ? ", " : "",
                input->kind != NULL ? "--kind " : "", input->kind != NULL ? input->kind : "");
}

static const struct example examples[] = {
    {"list lenses --kind zoom", "lenses of one kind"},
    {"list tolerances --kind precision", "what a grade of --grade holds, and where it is from"},
    {"list formats", "all formats with sizes, crop factors and circles of confusion"},
    {"list cameras nikon d1", "cameras whose name contains these words"},
    {"list cameras alexa 35", "a cine camera and its sensor modes"},
    {"list columns dof", "what dof prints: columns, units, meanings"},
    {"list formats --kind cine-film --csv", "one class, for a spreadsheet"},
    {"list films hp5", "what is published on a film, and by whom"},
    {"list scenes moon", "moonlight, and the moon itself"},
    {"list stops --kind third", "the third-stop series with exact values"},
    {NULL, NULL},
};

const struct command command_list = {
    .name = "list",
    .group = "data",
    .summary = "lenses, formats, cameras, films, scenes, filters, glasses, tolerances, stops, "
               "units, commands, options, columns, config",
    COMMAND_ASKS(struct list_input),
    .choose_sheet = list_choose_sheet,
    .sheets = sheets,
    .makes_many = command_always_many,
    .reads = READS_LENSDB | READS_GLASSES,
    .run = list_run,
};
