/* commands/data/check_files.h - lenscalc convert --check. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_DATA_CHECK_FILES_H
#define LENSCALC_COMMANDS_DATA_CHECK_FILES_H

struct command;

extern const struct command command_convert_check;

#endif
