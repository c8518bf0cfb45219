/* cli/cmd_completion.c - lenscalc completion: scripts for bash, zsh and fish, from the tables. */
/* SPDX-License-Identifier: MIT */
#include "cli/command.h"

#include <string.h>

enum shell { BASH, ZSH, FISH };

struct input {
    int shell;
};

static const struct word shells[] = {
    {"bash", "source <(lenscalc completion bash)"},
    {"zsh", "as the file _lenscalc in a folder of fpath"},
    {"fish", "as ~/.config/fish/completions/lenscalc.fish"},
    {NULL, NULL},
};

static const struct option options[] = {
    {OPTION(struct input, shell), .name = "shell", .words = shells, .value = "SHELL",
     .flags = OPTION_OPERAND, .fallback = "bash", .help = "which shell"},
};

/* Called for every option of a command, its own and the common ones. */
typedef void option_writer(const struct command *command, const struct option *option,
                           struct output *output);

static void each_option(const struct command *command, option_writer *write, struct output *output)
{
    for (size_t i = 0; i < command->option_count; i++) {
        write(command, &command->options[i], output);
    }
    for (size_t i = 0; i < common_option_count; i++) {
        write(command, &common_options[i], output);
    }
}

static void write_commands(struct output *output)
{
    for (size_t i = 0; commands[i] != NULL; i++) {
        output_printf(output, "%s%s", i > 0 ? " " : "", commands[i]->name);
    }
}

/* A text between single quotes of a shell. */
static void write_quoted(struct output *output, const char *text, const char *also)
{
    for (; *text != '\0'; text++) {
        if (*text == '\'') {
            output_string(output, "'\\''");
        } else if (strchr(also, *text) != NULL) {
            output_printf(output, "\\%c", *text);
        } else {
            output_character(output, *text);
        }
    }
}

static void bash_option(const struct command *command, const struct option *option,
                        struct output *output)
{
    (void)command;
    output_printf(output, " --%s", option->name);
    if (option->letter != '\0') {
        output_printf(output, " -%c", option->letter);
    }
}

/* Words that may stand behind an option. */
static void bash_values(const struct command *command, const struct option *option,
                        struct output *output)
{
    if (option->words == NULL) {
        return;
    }
    output_printf(output, "        %s:--%s) words='", command->name, option->name);
    for (const struct word *word = option->words; word->word != NULL; word++) {
        output_printf(output, "%s ", word->word);
    }
    output_string(output, "' ;;\n");
}

static void write_bash(struct output *output)
{
    output_string(output,
                  "# lenscalc completion for bash\n"
                  "_lenscalc() {\n"
                  "    local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n"
                  "    local command=${COMP_WORDS[1]} words=\n"
                  "    if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
                  "        COMPREPLY=($(compgen -W '");
    write_commands(output);
    output_string(output, "' -- \"$current\"))\n"
                          "        return\n"
                          "    fi\n"
                          "    case $command:$before in\n");
    for (size_t i = 0; commands[i] != NULL; i++) {
        each_option(commands[i], bash_values, output);
    }
    output_string(output,
                  "        *:--sensor|*:--equal-on)\n"
                  "            local IFS=$'\\n'\n"
                  "            COMPREPLY=($(compgen -W \"$(lenscalc list formats --columns format "
                  "--tsv | tail -n +2)\" -- \"$current\"))\n"
                  "            return ;;\n"
                  "        *:--output|*:-o|*:--batch|*:--plot|*:--scale|*:--lensdb)\n"
                  "            COMPREPLY=($(compgen -f -- \"$current\"))\n"
                  "            return ;;\n"
                  "        help:help) words='");
    write_commands(output);
    output_string(output, "' ;;\n        list:list) words='formats cameras stops units commands "
                          "options' ;;\n"
                          "        completion:completion) words='bash zsh fish' ;;\n"
                          "        *) case $command in\n");
    for (size_t i = 0; commands[i] != NULL; i++) {
        output_printf(output, "            %s) words='", commands[i]->name);
        each_option(commands[i], bash_option, output);
        output_string(output, "' ;;\n");
    }
    output_string(output, "        esac ;;\n"
                          "    esac\n"
                          "    COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
                          "}\n"
                          "complete -F _lenscalc lenscalc\n");
}

/* '--name[help]:value:(words)' */
static void zsh_option(const struct command *command, const struct option *option,
                       struct output *output)
{
    (void)command;
    output_printf(output, "            '--%s%s[", option->name, option->value != NULL ? "=" : "");
    write_quoted(output, option->help, "[]:");
    output_character(output, ']');
    if (option->value != NULL) {
        output_character(output, ':');
        write_quoted(output, option->name, "");
        output_character(output, ':');
    }
    if (option->words != NULL) {
        output_character(output, '(');
        for (const struct word *word = option->words; word->word != NULL; word++) {
            output_printf(output, "%s%s", word == option->words ? "" : " ", word->word);
        }
        output_character(output, ')');
    } else if ((option->flags & OPTION_FILE) != 0) {
        output_string(output, "_files");
    } else if (option->kind == &kind_sensor) {
        output_string(output, "_lenscalc_formats");
    }
    output_string(output, "' \\\n");
}

static void write_zsh(struct output *output)
{
    output_string(output,
                  "#compdef lenscalc\n"
                  "# lenscalc completion for zsh\n"
                  "_lenscalc_formats() {\n"
                  "    local -a formats\n"
                  "    formats=(${(f)\"$(lenscalc list formats --columns format --tsv | tail -n "
                  "+2)\"})\n"
                  "    _describe format formats\n"
                  "}\n"
                  "_lenscalc() {\n"
                  "    local -a all\n"
                  "    all=(\n");
    for (size_t i = 0; commands[i] != NULL; i++) {
        output_printf(output, "        '%s:", commands[i]->name);
        write_quoted(output, commands[i]->summary, ":");
        output_string(output, "'\n");
    }
    output_string(output, "    )\n"
                          "    if (( CURRENT == 2 )); then\n"
                          "        _describe command all\n"
                          "        return\n"
                          "    fi\n"
                          "    local command=$words[2]\n"
                          "    shift words; (( CURRENT-- ))\n"
                          "    case $command in\n");
    for (size_t i = 0; commands[i] != NULL; i++) {
        output_printf(output, "    %s)\n        _arguments \\\n", commands[i]->name);
        each_option(commands[i], zsh_option, output);
        output_string(output, "            '*:word:'\n        ;;\n");
    }
    output_string(output, "    esac\n}\n_lenscalc \"$@\"\n");
}

static void fish_option(const struct command *command, const struct option *option,
                        struct output *output)
{
    output_printf(output, "complete -c lenscalc -n '__fish_seen_subcommand_from %s' -l %s",
                  command->name, option->name);
    if (option->letter != '\0') {
        output_printf(output, " -s %c", option->letter);
    }
    if (option->value != NULL) {
        output_string(output, (option->flags & OPTION_FILE) != 0 ? " -r -F" : " -x");
    }
    if (option->words != NULL) {
        output_string(output, " -a '");
        for (const struct word *word = option->words; word->word != NULL; word++) {
            output_printf(output, "%s%s", word == option->words ? "" : " ", word->word);
        }
        output_string(output, "'");
    } else if (option->kind == &kind_sensor) {
        output_string(output, " -a '(lenscalc list formats --columns format --tsv | tail -n +2)'");
    }
    output_string(output, " -d '");
    write_quoted(output, option->help, "\\");
    output_string(output, "'\n");
}

static void write_fish(struct output *output)
{
    output_string(output, "# lenscalc completion for fish\ncomplete -c lenscalc -f\n");
    for (size_t i = 0; commands[i] != NULL; i++) {
        output_printf(output, "complete -c lenscalc -n __fish_use_subcommand -a %s -d '",
                      commands[i]->name);
        write_quoted(output, commands[i]->summary, "\\");
        output_string(output, "'\n");
    }
    for (size_t i = 0; commands[i] != NULL; i++) {
        each_option(commands[i], fish_option, output);
    }
}

static bool print(const void *data, struct output *output, struct error *error)
{
    static void (*const writers[])(struct output *) = {
        [BASH] = write_bash, [ZSH] = write_zsh, [FISH] = write_fish};
    const struct input *input = data;
    (void)error;
    writers[input->shell](output);
    return true;
}

static const struct example examples[] = {
    {"completion bash", "the script to source in bash"},
    {NULL, NULL},
};

const struct command command_completion = {
    .name = "completion",
    .group = "tool",
    .summary = "completion script for bash, zsh or fish",
    COMMAND_ASKS(struct input),
    .print = print,
};
