/* commands/tool/help_topics.c - short texts on what all commands have in common. */
/* SPDX-License-Identifier: MIT */
#include "cli/answer/help.h"
#include "commands/tool/overview.h"
#include "report/report.h"
#include "report/version.h"

#include <string.h>

/* Each dimension and its units. */
static void help_topics_list_units(struct output *output)
{
    enum { NAME_WIDTH = 17 };
    for (size_t i = 0; dimensions[i] != NULL; i++) {
        const struct dimension *dimension = dimensions[i];
        size_t named = 0;
        for (size_t k = 0; k < dimension->unit_count; k++) {
            const struct unit *unit = &dimension->units[k];
            if (unit->name[0] == '\0') {
                continue;
            }
            if (named++ == 0) {
                output_printf(output, "%-*s", NAME_WIDTH, dimension->name);
            }
            output_printf(output, " %s", unit->name);
        }
        output_string(output, named > 0 ? "\n" : "");
    }
}

static void help_topics_list_formats(struct output *output)
{
    output_character(output, '\n');
    for (size_t i = 0; format_word(i) != NULL; i++) {
        output_printf(output, "%-9s %s\n", format_word(i)->word, format_word(i)->help);
    }
}

static void list_topics(struct output *output)
{
    for (const struct topic_text *topic = help_topics; topic->name != NULL; topic++) {
        output_printf(output, "%-9s %s\n", topic->name, topic->summary);
    }
}

const struct topic_text help_topics[] = {
    {"values", "numbers, units and the notations of the trade",
     "A number may carry a unit: 50mm 3m 10ft 5ft6in 2in 550nm 35deg 12arcmin 1/125s 2min. Without "
     "one it has the unit that COMMAND --help shows. The decimal point is '.'; inf is infinity "
     "where that makes sense. Also read: f/2.8 f2.8 T2.2, 1/125, ISO400, EV12, 3stops, "
     "180deg@24fps, 1:2 and 0.5x, formats and cameras by name (--sensor \"Nikon D1\"), 36x24mm. "
     "What shows by its unit or prefix what it is needs no option: dof 50mm f/2.8 3m; of two "
     "lengths the first is the focal length. "
     "All units: lenscalc help units.",
     NULL},
    {"units", "what a value may be measured in",
     "A unit may always be written behind a number, with or without a blank: 50mm, '50 mm'. A "
     "number without one has the unit that COMMAND --help shows. The end of a column's name is "
     "its unit, and another one there converts: --columns near_ft. --units imperial prints "
     "distances in feet and inches. Other spellings, and the sizes of the units: lenscalc list "
     "units.\n",
     help_topics_list_units},
    {"ranges", "lists and ranges, which sweep an option",
     "1.4,2,2.8    these values           1.4..22        the labels of a stop series\n"
     "1..10        steps of 1             1.4..22/third  third (full, half) stops\n"
     "10..100:5    steps of 5             1..1000*10     factors of 10\n"
     "0..1#21      21 points              1ft..10ft:6in  units may be written\n"
     "1/16..1      fractions in stops: 1/16, 1/8, 1/4, 1/2, 1\n"
     "\n"
     "Several swept options give all combinations, the first option slowest. --nominal puts the "
     "exact value in the place of a label: 5.6 becomes 5.657. More than a million rows want "
     "--force. --table ROW,COL prints two swept options as a cross-table, --plot draws.",
     NULL},
    {"output", "formats, columns, digits and files",
     "--format chooses one of those below, text if it is not given; --csv and so on for short. "
     "--columns near_ft,far_m chooses, orders and converts; --digits N cuts; --value near_m prints "
     "the bare number for a script. Machine formats "
     "print the fewest digits that read back as the same number. Infinity is inf, in JSON null "
     "beside \"..._is_infinite\":true; an absent value is empty, in JSON null. -o FILE appears "
     "only when it is complete. --explain adds formulas and sources.",
     help_topics_list_formats},
    {"options", "what all commands, or many, have in common",
     "COMMAND -h shows examples and the command's own options, a line each, COMMAND --help all "
     "about them and those of the following that it has a use for.\n",
     help_write_common},
    {"batch", "rows in, rows out",
     "--batch FILE (- is standard input) reads csv, tsv or jsonl with a header. A column is named "
     "by an option's letter or name or by an output column, and may carry a unit: f_mm, s_m, "
     "focal_length, coc_mm. Other columns are passed through. An option on the command line is "
     "what rows take that have no value of their own. A bad row is reported with its line, keeps "
     "its place and has an 'error'. Photographs are rows too: dof IMG_1.jpg IMG_2.CR3 takes the "
     "settings that the camera wrote, by exiftool if it is installed.",
     NULL},
    {"status", "exit statuses",
     "0  fine                          3  some rows of a batch or sweep failed\n"
     "1  no answer: out of range,      4  a data file is bad\n"
     "   nothing found                 5  reading or writing failed, or memory\n"
     "2  the command line is wrong        is exhausted",
     NULL},
    {"version", "this program and its version",
     "lenscalc " LENSCALC_VERSION "\n\n"
     "The number has three parts. Names of commands, options, columns and keys only ever get "
     "added while the first part stays. JSON answers hold it under the key \"version\"; lenscalc "
     "--version prints the first line alone.",
     NULL},
    {"topics", "what else is explained",
     "lenscalc help TOPIC explains one of these, lenscalc help COMMAND a command; lenscalc help "
     "lists the commands.\n",
     list_topics},
    {NULL, NULL, NULL, NULL},
};

const struct topic_text *help_topic_find(const char *name)
{
    const struct topic_text *topic = help_topics;
    while (topic->name != NULL && strcmp(topic->name, name) != 0) {
        topic++;
    }
    return topic->name != NULL ? topic : NULL;
}
