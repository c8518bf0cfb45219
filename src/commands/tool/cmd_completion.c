/* commands/tool/cmd_completion.c - lenscalc completion: scripts for bash, zsh and fish. */
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
    {"fish", "as lenscalc.fish in ~/.config/fish/completions"},
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
    for (size_t i = 0; command_option(command, i) != NULL; i++) {
        write(command, command_option(command, i), output);
    }
    const struct option *common = NULL;
    while ((common = command_next_common(command, common)) != NULL) {
        write(command, common, output);
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

/* Where the names come from that an option may have: what follows "lenscalc list". */
struct names {
    const struct option_kind *kind;
    const char *list, *column;
    bool or_file;
};

static const struct names all_names[] = {
    {&kind_sensor, "formats", "format", false},
    {&kind_lens, "lenses", "lens", true},
    {&kind_glass, "glasses", "glass", false},
};

enum { NAMES = sizeof all_names / sizeof all_names[0] };

static const struct names *names_of(const struct option *option)
{
    for (size_t i = 0; i < NAMES; i++) {
        if (all_names[i].kind == option->kind) {
            return &all_names[i];
        }
    }
    return NULL;
}

/* The first operand of a command; null if it has none. */
static const struct option *operand_of(const struct command *command)
{
    for (size_t i = 0; i < command->option_count; i++) {
        if ((command->options[i].flags & OPTION_OPERAND) != 0) {
            return &command->options[i];
        }
    }
    return NULL;
}

static bool has_words(const struct option *option)
{
    return option_word(option, 0) != NULL;
}

static void write_words(struct output *output, const struct option *option)
{
    for (size_t i = 0; option_word(option, i) != NULL; i++) {
        output_printf(output, "%s%s", i == 0 ? "" : " ", option_word(option, i)->word);
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

/* Words, names or files that may stand behind an option. */
static void bash_values(const struct command *command, const struct option *option,
                        struct output *output)
{
    const struct names *names = names_of(option);
    bool is_file = (option->flags & OPTION_FILE) != 0;
    if (!has_words(option) && names == NULL && !is_file) {
        return;
    }
    output_printf(output, "        %s:--%s", command->name, option->name);
    if (option->letter != '\0') {
        output_printf(output, "|%s:-%c", command->name, option->letter);
    }
    if (names != NULL) {
        output_printf(output, ") names='%s --columns %s' files=%s ;;\n", names->list, names->column,
                      names->or_file ? "-f" : "");
        return;
    }
    if (is_file) {
        output_string(output, ") files=-f ;;\n");
        return;
    }
    output_string(output, ") words='");
    write_words(output, option);
    output_string(output, "' ;;\n");
}

/* Words that may stand behind the command itself. */
static void bash_operand(const struct command *command, struct output *output)
{
    const struct option *operand = operand_of(command);
    if (operand != NULL && has_words(operand)) {
        output_printf(output, "        %s:%s) words='", command->name, command->name);
        write_words(output, operand);
        output_string(output, "' ;;\n");
    }
}

/* Options of a command, and the names it takes without one. */
static void bash_rest(const struct command *command, struct output *output)
{
    const struct option *operand = operand_of(command);
    const struct names *names = operand != NULL ? names_of(operand) : NULL;
    output_printf(output, "            %s) words='", command->name);
    each_option(command, bash_option, output);
    output_string(output, "'");
    if (names != NULL) {
        output_printf(output, "; [[ $current == -* ]] || { names='%s --columns %s' files=%s; }",
                      names->list, names->column, names->or_file ? "-f" : "");
    }
    output_string(output, " ;;\n");
}

static void write_bash(struct output *output)
{
    output_string(output,
                  "# lenscalc completion for bash\n"
                  "_lenscalc() {\n"
                  "    local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n"
                  "    local command=${COMP_WORDS[1]} words= names= files=\n"
                  "    if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
                  "        COMPREPLY=($(compgen -W '");
    write_commands(output);
    output_string(output, "' -- \"$current\"))\n"
                          "        return\n"
                          "    fi\n"
                          "    case $command:$before in\n");
    for (size_t i = 0; commands[i] != NULL; i++) {
        each_option(commands[i], bash_values, output);
        bash_operand(commands[i], output);
    }
    output_string(output, "        help:help) words='");
    write_commands(output);
    output_string(output, "' ;;\n"
                          "        *) case $command in\n");
    for (size_t i = 0; commands[i] != NULL; i++) {
        bash_rest(commands[i], output);
    }
    output_string(output,
                  "        esac ;;\n"
                  "    esac\n"
                  "    if [ -n \"$names\" ]; then\n"
                  "        local list=$(lenscalc list $names --tsv 2> /dev/null | tail -n +2)\n"
                  "        local IFS=$'\\n'\n"
                  "        COMPREPLY=($(compgen -W \"$list\" -- \"$current\")\n"
                  "            ${files:+$(compgen -f -- \"$current\")})\n"
                  "        return\n"
                  "    fi\n"
                  "    if [ -n \"$files\" ]; then\n"
                  "        COMPREPLY=($(compgen -f -- \"$current\"))\n"
                  "        return\n"
                  "    fi\n"
                  "    COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
                  "}\n"
                  "complete -F _lenscalc lenscalc\n");
}

/* What completes the value of an option in zsh: (words), a function, or nothing. */
static void zsh_action(const struct option *option, struct output *output)
{
    const struct names *names = names_of(option);
    if (has_words(option)) {
        output_character(output, '(');
        write_words(output, option);
        output_character(output, ')');
    } else if (names != NULL) {
        output_printf(output, "_lenscalc_%s", names->list);
    } else if ((option->flags & OPTION_FILE) != 0) {
        output_string(output, "_files");
    }
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
    zsh_action(option, output);
    output_string(output, "' \\\n");
}

static void zsh_operand(const struct command *command, struct output *output)
{
    const struct option *operand = operand_of(command);
    if (operand == NULL || (!has_words(operand) && names_of(operand) == NULL)) {
        output_string(output, "            '*:word:'\n        ;;\n");
        return;
    }
    bool many = (operand->flags & OPTION_MANY) != 0;
    output_printf(output, "            '%s:%s:", many ? "*" : "1", operand->name);
    zsh_action(operand, output);
    output_string(output, many ? "'\n        ;;\n" : "' \\\n            '*:word:'\n        ;;\n");
}

static void write_zsh(struct output *output)
{
    output_string(output, "#compdef lenscalc\n"
                          "# lenscalc completion for zsh\n");
    for (size_t i = 0; i < NAMES; i++) {
        const struct names *names = &all_names[i];
        output_printf(output,
                      "_lenscalc_%s() {\n"
                      "    local -a names\n"
                      "    names=(${(f)\"$(lenscalc list %s --columns %s --tsv 2> /dev/null | tail "
                      "-n +2)\"})\n"
                      "    compadd -a names\n"
                      "%s"
                      "}\n",
                      names->list, names->list, names->column,
                      names->or_file ? "    _files\n" : "");
    }
    output_string(output, "_lenscalc() {\n"
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
        zsh_operand(commands[i], output);
    }
    output_string(output, "    esac\n}\n_lenscalc \"$@\"\n");
}

/* -a 'words', or -a '(the names)' */
static void fish_values(const struct option *option, struct output *output)
{
    const struct names *names = names_of(option);
    if (has_words(option)) {
        output_string(output, " -a '");
        write_words(output, option);
        output_character(output, '\'');
    } else if (names != NULL) {
        output_printf(output,
                      " -a '(lenscalc list %s --columns %s --tsv 2> /dev/null | tail -n +2)'",
                      names->list, names->column);
    }
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
    fish_values(option, output);
    output_string(output, " -d '");
    write_quoted(output, option->help, "\\");
    output_string(output, "'\n");
}

static void fish_operand(const struct command *command, struct output *output)
{
    const struct option *operand = operand_of(command);
    if (operand != NULL && (has_words(operand) || names_of(operand) != NULL)) {
        output_printf(output, "complete -c lenscalc -n '__fish_seen_subcommand_from %s'%s",
                      command->name, (operand->flags & OPTION_FILE) != 0 ? " -F" : "");
        fish_values(operand, output);
        output_character(output, '\n');
    }
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
        fish_operand(commands[i], output);
    }
}

static bool write_script(const struct artifact_job *job, struct output *output, struct error *error)
{
    static void (*const writers[])(struct output *) = {
        [BASH] = write_bash, [ZSH] = write_zsh, [FISH] = write_fish};
    const struct input *input = job->inputs[0];
    (void)error;
    writers[input->shell](output);
    return true;
}

static const struct artifact artifacts[] = {{ARTIFACT_ANSWER(NULL), .make = write_script}};

static const struct example examples[] = {
    {"completion bash", "the script to source in bash"},
    {NULL, NULL},
};

const struct command command_completion = {
    .name = "completion",
    .group = "tool",
    .summary = "completion script for bash, zsh or fish",
    COMMAND_ASKS(struct input),
    COMMAND_MAKES(artifacts),
};
