/* commands/tool/overview.h - what there is: commands by group, and topics of help. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_TOOL_OVERVIEW_H
#define LENSCALC_COMMANDS_TOOL_OVERVIEW_H

#include "report/output.h"

/* What all commands have in common, by topic; ends with a null name. */
struct topic_text {
    const char *name, *summary, *text;
    void (*list)(struct output *output); /* writes what follows the text; null = nothing does */
};

extern const struct topic_text help_topics[];

/* The topic of this name; null if there is none. */
const struct topic_text *help_topic_find(const char *name);

/* Short help for who typed the name alone, on standard error. */
void help_short(void);

#endif
