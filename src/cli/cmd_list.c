/* cli/cmd_list.c - lenscalc list: what the program knows. */
/* SPDX-License-Identifier: MIT */
#include "base/arena.h"
#include "cli/command.h"

#include <math.h>
#include <string.h>

struct input {
    int topic;
    const char *search, *kind;
};

struct run_list;

/* One thing to list: its rows and where they come from. */
struct topic {
    struct sheet sheet;
    bool (*list)(struct run_list *list, struct error *error);
};

/* A list being made. */
struct run_list {
    const struct input *input;
    struct run *run;
    size_t found;
};

static const char *string(const struct run_list *list, struct text text)
{
    return text.length == 0 ? NULL : arena_string(list->run->arena, text.start, text.length);
}

/* Does any of the texts contain what is searched for? Null texts contain nothing. */
static bool matches(const struct run_list *list, const char *kind, const char *const *texts,
                    size_t count)
{
    const struct input *input = list->input;
    if (input->kind != NULL &&
        (kind == NULL || !text_same_name(text_of(kind), text_of(input->kind)))) {
        return false;
    }
    bool found = input->search == NULL;
    for (size_t i = 0; i < count && !found; i++) {
        found = texts[i] != NULL && text_contains_name(text_of(texts[i]), text_of(input->search));
    }
    return found;
}

static void hand_out(struct run_list *list, const void *row)
{
    list->found++;
    run_emit(list->run, row);
}

/* Formats and cameras. */
struct sensor_row {
    const char *name, *aliases, *class, *pitch_from, *confidence, *source, *place;
    double width, height, diagonal, crop, coc, pixels_wide, pixels_high, pitch;
};

#define SENSOR(member) COLUMN(struct sensor_row, member)
#define SENSOR_LENGTH(member, in_unit) SENSOR(member), .dimension = &dimension_length, .unit = in_unit

#define SENSOR_SIZE                                                                                \
    {SENSOR_LENGTH(width, "mm"), .name = "width", .flags = COLUMN_BRIEF | COLUMN_ECHO,             \
     .label = "width", .help = "width of the picture area"},                                       \
        {SENSOR_LENGTH(height, "mm"), .name = "height", .flags = COLUMN_BRIEF | COLUMN_ECHO,       \
         .label = "height", .help = "height of the picture area"},                                 \
        {SENSOR_LENGTH(diagonal, "mm"), .name = "diagonal", .flags = COLUMN_BRIEF,                 \
         .label = "diagonal", .help = "diagonal of the picture area"},                             \
        {SENSOR(crop), .name = "crop_factor", .flags = COLUMN_BRIEF, .label = "crop factor",       \
         .help = "43.27 mm over the diagonal"}

#define SENSOR_ORIGIN                                                                              \
    {SENSOR(confidence), .name = "confidence", .flags = COLUMN_BRIEF, .label = "confidence",       \
     .help = "sourced, recall (from memory) or approx"},                                           \
        {SENSOR(source), .name = "source", .label = "source", .help = "where the figures are from"}, \
        {SENSOR(place), .name = "database", .label = "database",                                   \
         .help = "embedded, or the user's own folder"}

static const struct column format_columns[] = {
    {SENSOR(name), .name = "format", .flags = COLUMN_BRIEF, .label = "format",
     .help = "name of the format"},
    {SENSOR(aliases), .name = "aliases", .flags = COLUMN_BRIEF, .label = "also called",
     .help = "other names of the format"},
    SENSOR_SIZE,
    {SENSOR_LENGTH(coc, "mm"), .name = "coc", .flags = COLUMN_BRIEF, .label = "d/1500",
     .help = "circle of confusion, diagonal / 1500"},
    {SENSOR(class), .name = "class", .flags = COLUMN_BRIEF, .label = "class",
     .help = "kind of format"},
    SENSOR_ORIGIN,
};

static const struct column camera_columns[] = {
    {SENSOR(name), .name = "camera", .flags = COLUMN_BRIEF, .label = "camera",
     .help = "maker and model"},
    SENSOR_SIZE,
    {SENSOR(pixels_wide), .name = "pixels_wide", .flags = COLUMN_BRIEF | COLUMN_ECHO,
     .label = "pixels wide", .help = "pixel count along the width"},
    {SENSOR(pixels_high), .name = "pixels_high", .flags = COLUMN_BRIEF | COLUMN_ECHO,
     .label = "pixels high", .help = "pixel count along the height"},
    {SENSOR_LENGTH(pitch, "mm"), .name = "pitch", .flags = COLUMN_BRIEF, .label = "pixel pitch",
     .help = "distance of two pixels"},
    {SENSOR(pitch_from), .name = "pitch_from", .flags = COLUMN_BRIEF, .label = "pitch from",
     .help = "published, counts (width over pixels), or estimate (from an estimated count)"},
    SENSOR_ORIGIN,
};

static bool list_sensors(struct run_list *list, enum lensdb_place place, bool cameras,
                         struct error *error)
{
    struct lensdb_sensors sensors;
    struct lensdb_sensor sensor;
    if (!lensdb_sensors_open(&sensors, list->run->db, place, cameras, error)) {
        return error->code == ERROR_NONE;
    }
    while (lensdb_sensors_next(&sensors, &sensor, error)) {
        struct sensor_row row = {
            .name = string(list, sensor.name),
            .aliases = string(list, sensor.aliases),
            .class = string(list, sensor.class),
            .pitch_from = string(list, sensor.pitch_from),
            .confidence = string(list, sensor.confidence),
            .source = string(list, sensor.source),
            .place = place == LENSDB_USER ? "own" : "embedded",
            .width = sensor.size.width,
            .height = sensor.size.height,
            .diagonal = sensor_diagonal(&sensor.size),
            .crop = sensor_crop(&sensor.size),
            .coc = sensor_diagonal(&sensor.size) / 1500,
            .pixels_wide = sensor.pixels_wide,
            .pixels_high = sensor.pixels_high,
            .pitch = sensor.size.pitch,
        };
        if (sensor.maker.length > 0) {
            row.name = arena_printf(list->run->arena, "%.*s %s", (int)sensor.maker.length,
                                    sensor.maker.start, row.name);
        }
        const char *kind = cameras ? string(list, sensor.maker) : row.class;
        if (matches(list, kind, (const char *[]){row.name, row.aliases, row.class}, 3)) {
            hand_out(list, &row);
        }
    }
    return error->code == ERROR_NONE;
}

static bool list_formats(struct run_list *list, struct error *error)
{
    return list_sensors(list, LENSDB_USER, false, error) &&
           list_sensors(list, LENSDB_EMBEDDED, false, error);
}

static bool list_cameras(struct run_list *list, struct error *error)
{
    return list_sensors(list, LENSDB_USER, true, error) &&
           list_sensors(list, LENSDB_EMBEDDED, true, error);
}

/* Stop series. */
struct stop_row {
    const char *quantity, *series, *label, *note;
    double exact, off;
};

static const struct column stop_columns[] = {
    {COLUMN(struct stop_row, quantity), .name = "quantity", .flags = COLUMN_BRIEF,
     .label = "quantity", .help = "f-number, time in s, or ISO"},
    {COLUMN(struct stop_row, series), .name = "series", .flags = COLUMN_BRIEF, .label = "series",
     .help = "full, half or third stops"},
    {COLUMN(struct stop_row, label), .name = "label", .flags = COLUMN_BRIEF, .label = "label",
     .help = "as lenses and cameras print it"},
    {COLUMN(struct stop_row, exact), .name = "exact", .flags = COLUMN_BRIEF, .label = "exact",
     .help = "the value --nominal puts in its place"},
    {COLUMN(struct stop_row, off), .name = "label_error_stops", .flags = COLUMN_BRIEF,
     .label = "label is off by", .help = "light by the label over light by the exact value, stops"},
    {COLUMN(struct stop_row, note), .name = "note", .label = "note", .help = "remark"},
};

static bool list_series(struct run_list *list, const char *file, const char *quantity,
                        double stops_per_octave, const char *series, struct error *error)
{
    struct lensdb_stop *stops;
    size_t count;
    if (!lensdb_stops(list->run->db, file, series, &stops, &count, error)) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        struct stop_row row = {
            .quantity = quantity,
            .series = series,
            .label = string(list, stops[i].label),
            .note = string(list, stops[i].note),
            .exact = stops[i].exact,
            .off = stops_per_octave * log2(stops[i].value / stops[i].exact),
        };
        if (matches(list, series, (const char *[]){row.label, quantity, series}, 3)) {
            hand_out(list, &row);
        }
    }
    return true;
}

static bool list_stops(struct run_list *list, struct error *error)
{
    static const struct {
        const char *file, *quantity;
        double stops_per_octave; /* a larger f-number passes less light */
    } quantities[] = {
        {"fstops.tsv", "f-number", -2}, {"shutters.tsv", "time", 1}, {"iso.tsv", "iso", 1}};
    static const char *const series[] = {"full", "half", "third"};
    for (size_t i = 0; i < 3; i++) {
        for (size_t j = 0; j < 3; j++) {
            if (!list_series(list, quantities[i].file, quantities[i].quantity,
                             quantities[i].stops_per_octave, series[j], error)) {
                return false;
            }
        }
    }
    return true;
}

/* Units. */
struct unit_row {
    const char *dimension, *unit, *spellings, *help;
    double value;
};

static const struct column unit_columns[] = {
    {COLUMN(struct unit_row, dimension), .name = "dimension", .flags = COLUMN_BRIEF,
     .label = "dimension", .help = "what it measures"},
    {COLUMN(struct unit_row, unit), .name = "unit", .flags = COLUMN_BRIEF, .label = "unit",
     .help = "as it is typed, and as it ends the name of a column"},
    {COLUMN(struct unit_row, spellings), .name = "spellings", .flags = COLUMN_BRIEF,
     .label = "also typed", .help = "other spellings"},
    {COLUMN(struct unit_row, value), .name = "value", .flags = COLUMN_BRIEF | COLUMN_ECHO,
     .label = "value", .help = "in the first unit of its dimension"},
    {COLUMN(struct unit_row, help), .name = "help", .flags = COLUMN_BRIEF, .label = "meaning",
     .help = "in words"},
};

static bool list_units(struct run_list *list, struct error *error)
{
    (void)error;
    for (size_t i = 0; dimensions[i] != NULL; i++) {
        for (size_t j = 0; j < dimensions[i]->unit_count; j++) {
            const struct unit *unit = &dimensions[i]->units[j];
            struct unit_row row = {dimensions[i]->name, unit->name, unit->spellings, unit->help,
                                   unit_to_own(unit, 1)};
            if (unit->name[0] != '\0' &&
                matches(list, row.dimension,
                        (const char *[]){row.dimension, row.unit, row.spellings, row.help}, 4)) {
                hand_out(list, &row);
            }
        }
    }
    return true;
}

/* Commands and their options. */
struct command_row {
    const char *command, *group, *summary;
};

static const struct column command_columns[] = {
    {COLUMN(struct command_row, command), .name = "command", .flags = COLUMN_BRIEF,
     .label = "command", .help = "its name"},
    {COLUMN(struct command_row, group), .name = "group", .flags = COLUMN_BRIEF, .label = "group",
     .help = "what it is about"},
    {COLUMN(struct command_row, summary), .name = "summary", .flags = COLUMN_BRIEF,
     .label = "summary", .help = "what it does"},
};

static bool list_commands(struct run_list *list, struct error *error)
{
    (void)error;
    for (size_t i = 0; commands[i] != NULL; i++) {
        struct command_row row = {commands[i]->name, commands[i]->group, commands[i]->summary};
        if (matches(list, row.group, (const char *[]){row.command, row.summary}, 2)) {
            hand_out(list, &row);
        }
    }
    return true;
}

struct option_row {
    const char *command, *option, *letter, *value, *unit, *range, *fallback, *help;
};

#define OF_OPTION(member) COLUMN(struct option_row, member)

static const struct column option_columns[] = {
    {OF_OPTION(command), .name = "command", .flags = COLUMN_BRIEF, .label = "command",
     .help = "whose option it is; all = of every command"},
    {OF_OPTION(option), .name = "option", .flags = COLUMN_BRIEF, .label = "option",
     .help = "its name"},
    {OF_OPTION(letter), .name = "letter", .flags = COLUMN_BRIEF, .label = "letter",
     .help = "its short form"},
    {OF_OPTION(value), .name = "value", .flags = COLUMN_BRIEF, .label = "value",
     .help = "what it takes"},
    {OF_OPTION(unit), .name = "unit", .flags = COLUMN_BRIEF, .label = "unit",
     .help = "unit of a bare number"},
    {OF_OPTION(range), .name = "range", .flags = COLUMN_BRIEF, .label = "range",
     .help = "legal range"},
    {OF_OPTION(fallback), .name = "default", .flags = COLUMN_BRIEF, .label = "default",
     .help = "what it is if not given"},
    {OF_OPTION(help), .name = "help", .flags = COLUMN_BRIEF, .label = "help",
     .help = "what it is for"},
};

static void list_option(struct run_list *list, const char *command, const struct option *option)
{
    const struct unit *unit = option_unit(option);
    const char *range = option_range(option, list->run->arena);
    struct option_row row = {
        .command = command,
        .option = arena_printf(list->run->arena, "--%s", option->name),
        .letter = option->letter != '\0' ? arena_printf(list->run->arena, "-%c", option->letter)
                                         : NULL,
        .value = option->value,
        .unit = unit != NULL && unit->name[0] != '\0' ? unit->name : NULL,
        .range = range[0] != '\0' ? range : NULL,
        .fallback = option->fallback,
        .help = option->help,
    };
    if (matches(list, command, (const char *[]){command, row.option}, 2)) {
        hand_out(list, &row);
    }
}

static bool list_options(struct run_list *list, struct error *error)
{
    (void)error;
    for (size_t i = 0; commands[i] != NULL; i++) {
        for (size_t j = 0; j < commands[i]->option_count; j++) {
            list_option(list, commands[i]->name, &commands[i]->options[j]);
        }
    }
    for (size_t j = 0; j < common_option_count; j++) {
        list_option(list, "all", &common_options[j]);
    }
    return true;
}

#define SHEET(columns, type) {columns, sizeof columns / sizeof columns[0], sizeof(type)}

static const struct word topic_words[] = {
    {"formats", "film and sensor formats"},
    {"cameras", "digital cameras"},
    {"stops", "labels of f-numbers, times and ISO, with exact values"},
    {"units", "units of every dimension"},
    {"commands", "commands of this program"},
    {"options", "options of every command"},
    {NULL, NULL},
};

/* In the order of topic_words. */
static const struct topic topics[] = {
    {SHEET(format_columns, struct sensor_row), list_formats},
    {SHEET(camera_columns, struct sensor_row), list_cameras},
    {SHEET(stop_columns, struct stop_row), list_stops},
    {SHEET(unit_columns, struct unit_row), list_units},
    {SHEET(command_columns, struct command_row), list_commands},
    {SHEET(option_columns, struct option_row), list_options},
};

static const struct option options[] = {
    {OPTION(struct input, topic), .name = "topic", .words = topic_words, .value = "TOPIC",
     .fallback = "commands", .flags = OPTION_OPERAND, .help = "what to list"},
    {OPTION(struct input, search), .name = "search", .value = "WORDS",
     .flags = OPTION_OPERAND | OPTION_REST, .help = "only what contains these words"},
    {OPTION(struct input, kind), .name = "kind", .value = "KIND",
     .help = "only this class of formats, maker of cameras, series of stops, dimension of units, "
             "group of commands, command of options"},
};

static const struct sheet *choose_sheet(const void *data)
{
    const struct input *input = data;
    return &topics[input->topic].sheet;
}

static bool makes_many(const void *data)
{
    (void)data;
    return true;
}

static bool run(const void *data, struct run *run, struct error *error)
{
    const struct input *input = data;
    struct run_list list = {.input = input, .run = run};
    if (!topics[input->topic].list(&list, error)) {
        return false;
    }
    if (list.found == 0) {
        return fail(error, ERROR_DOMAIN, "nothing among the %s matches %s%s%s%s",
                    topic_words[input->topic].word,
                    input->search != NULL ? input->search : "",
                    input->search != NULL && input->kind != NULL ? ", " : "",
                    input->kind != NULL ? "--kind " : "", input->kind != NULL ? input->kind : "");
    }
    return true;
}

static const struct example examples[] = {
    {"list formats", "all formats with sizes, crop factors and circles of confusion"},
    {"list cameras nikon d1", "cameras whose name contains these words"},
    {"list formats --kind cine-film --csv", "one class, for a spreadsheet"},
    {"list stops --kind third", "the third-stop series with exact values"},
    {NULL, NULL},
};

const struct command command_list = {
    .name = "list",
    .group = "data",
    .summary = "formats, cameras, stops, units, commands, options",
    .examples = examples,
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .input_size = sizeof(struct input),
    .sheet = SHEET(command_columns, struct command_row),
    .choose_sheet = choose_sheet,
    .makes_many = makes_many,
    .run = run,
};
