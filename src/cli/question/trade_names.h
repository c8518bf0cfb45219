/* cli/question/trade_names.h - names of options in other programs and in the trade. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_QUESTION_TRADE_NAMES_H
#define LENSCALC_CLI_QUESTION_TRADE_NAMES_H

/* Names for text_lists_name, and the option that they stand for where a command has it. */
struct trade_name {
    const char *names, *option;
    const char *command; /* the one where they mean it; null: any */
    const char *words;   /* of a hint: what is said in place of the option's help; of an alias: how
                            it was read, beside the answer; or null */
    const char *form;    /* of an alias, its value there: "0" whatever it is, "%px/ft" with the
                            number that is typed in place of %; null: as typed */
};

/* Those that mean the same quantity in whichever command the option is: they are taken for it.
   Ended by null names. */
extern const struct trade_name trade_aliases[];

/* Those that may be meant so, or are measured in another way: they are hints. Ended likewise. */
extern const struct trade_name trade_hints[];

/* Names that --columns takes for a column that has another one, `option` here, perhaps with a unit
   behind it. Ended likewise. */
extern const struct trade_name trade_columns[];

#endif
