/* commands/tool/cmd_completion.c - lenscalc completion: scripts for bash, zsh and fish. */
/* SPDX-License-Identifier: MIT */
#include "commands/tool/candidates.h"

enum shell { BASH, ZSH, FISH, WORDS };

struct completion_input {
    int shell;
    const char *words;
};

static const struct word shells[] = {
    {"bash", "source <(lenscalc completion bash)"},
    {"zsh", "as the file _lenscalc in a folder of fpath"},
    {"fish", "as lenscalc.fish in ~/.config/fish/completions"},
    {"words", "no script: what the last of the words may become, as the scripts ask"},
    {NULL, NULL},
};

static const struct option options[] = {
    {OPTION(struct completion_input, shell), .name = "shell", .words = shells, .value = "SHELL",
     .flags = OPTION_OPERAND, .fallback = "bash", .help = "which shell"},
    {OPTION(struct completion_input, words), .name = "words", .value = "WORD",
     .flags = OPTION_OPERAND | OPTION_TOGETHER | OPTION_EMPTY,
     .help = "a command line behind 'lenscalc', its last word being typed; with 'words --'"},
};

/*
 * The scripts only hand words over, so that the shells agree. What each has to do itself is to
 * undo its quotes, and to say what of the last word it will replace.
 */
static const char *const scripts[] = {
    /* readline splits words at '=' and ':', and replaces what follows */
    [BASH] = "# lenscalc completion for bash\n"
             "_lenscalc() {\n"
             "    local word glue= candidate quote= words=()\n"
             "    local current=${COMP_WORDS[COMP_CWORD]}\n"
             "    for word in \"${COMP_WORDS[@]:1:COMP_CWORD}\"; do\n"
             "        word=${word//\\\\/} word=${word#[\\\"\\']} word=${word%[\\\"\\']}\n"
             "        if [[ ( $word == [=:] || -n $glue ) && ${#words[@]} -gt 0 ]]; then\n"
             "            words[${#words[@]}-1]+=$word\n"
             "        else\n"
             "            words+=(\"$word\")\n"
             "        fi\n"
             "        [[ $word == [=:] ]] && glue=1 || glue=\n"
             "    done\n"
             "    [[ $current == [\\\"\\']* ]] && quote=1\n"
             "    [[ $current == [=:] ]] && current=\n"
             "    current=${current//\\\\/} current=${current#[\\\"\\']}\n"
             "    local typed=${words[${#words[@]}-1]}\n"
             "    local kept=${typed%\"$current\"}\n"
             "    COMPREPLY=()\n"
             "    while IFS=$'\\t' read -r candidate _; do\n"
             "        if [[ $candidate == :files ]]; then\n"
             "            [[ ${#COMPREPLY[@]} -eq 0 ]] && compopt -o filenames 2> /dev/null\n"
             "            while IFS= read -r candidate; do\n"
             "                COMPREPLY+=(\"$candidate\")\n"
             "            done < <(compgen -f -- \"$current\")\n"
             "            continue\n"
             "        fi\n"
             "        candidate=${candidate#\"$kept\"}\n"
             "        [[ -n $quote ]] || printf -v candidate %q \"$candidate\"\n"
             "        candidate=${candidate//\\\\,/,}\n"
             "        COMPREPLY+=(\"$candidate\")\n"
             "    done < <(lenscalc completion words -- \"${words[@]}\" 2> /dev/null)\n"
             "}\n"
             "complete -F _lenscalc lenscalc\n",
    [ZSH] =
        "#compdef lenscalc\n"
        "# lenscalc completion for zsh\n"
        "_lenscalc() {\n"
        "    local line files=\n"
        "    local -a typed names helps\n"
        "    (( CURRENT > 2 )) && typed=(\"${(@Q)words[2,CURRENT-1]}\")\n"
        "    typed+=(\"${(Q)PREFIX}\")\n"
        "    for line in \"${(@f)$(lenscalc completion words -- \"${typed[@]}\" 2> /dev/null)}\"; "
        "do\n"
        "        if [[ $line == :files ]]; then\n"
        "            files=1\n"
        "        elif [[ -n $line ]]; then\n"
        "            names+=(\"${line%%$'\\t'*}\")\n"
        "            helps+=(\"${line/$'\\t'/  -- }\")\n"
        "        fi\n"
        "    done\n"
        "    (( $#names )) && compadd -M 'm:{a-zA-Z}={A-Za-z}' -l -d helps -a names\n"
        "    if [[ -n $files ]]; then\n"
        "        [[ $PREFIX == --*=* ]] && compset -P '*='\n"
        "        _files\n"
        "    fi\n"
        "}\n"
        "if [[ $zsh_eval_context[-1] == loadautofunc ]]; then\n"
        "    _lenscalc \"$@\"\n"
        "else\n"
        "    compdef _lenscalc lenscalc\n"
        "fi\n",
    [FISH] =
        "# lenscalc completion for fish\n"
        "function __lenscalc_candidates\n"
        "    set -l typed (commandline -ct | string replace -r '^[\"\\']' '' | string replace -a "
        "'\\\\' '')\n"
        "    set -l words (commandline -opc) \"$typed\"\n"
        "    for line in (lenscalc completion words -- $words[2..-1] 2> /dev/null)\n"
        "        if test \"$line\" = :files\n"
        "            set -l before (string match -r '^--[^=]*=' -- \"$typed\")\n"
        "            for file in (__fish_complete_path (string replace -r '^--[^=]*=' '' -- "
        "\"$typed\"))\n"
        "                echo \"$before$file\"\n"
        "            end\n"
        "        else\n"
        "            echo $line\n"
        "        end\n"
        "    end\n"
        "end\n"
        "complete -c lenscalc -f -a '(__lenscalc_candidates)'\n",
};

static bool completion_check(const struct artifact_job *job, struct error *error)
{
    const struct completion_input *input = job->inputs[0];
    if (input->shell == WORDS && input->words == NULL) {
        return fail(error, ERROR_USAGE, "which words? Those behind 'lenscalc'") ||
               error_hint(error, "as in 'lenscalc completion words lens doub'");
    }
    return input->shell == WORDS || input->words == NULL ||
           fail(error, ERROR_USAGE, "words of a command line go with 'words', not with a shell");
}

static bool write_answer(const struct artifact_job *job, struct output *output, struct error *error)
{
    const struct completion_input *input = job->inputs[0];
    (void)error;
    if (input->shell == WORDS) {
        candidates_write(input->words, job->run, output);
    } else {
        output_string(output, scripts[input->shell]);
    }
    return true;
}

static const struct artifact artifacts[] = {
    {ARTIFACT_ANSWER(NULL), .check = completion_check, .make = write_answer}};

static const struct example examples[] = {
    {"completion bash", "the script to source in bash"},
    {"completion words -- dof --model ''", "what may follow these words"},
    {NULL, NULL},
};

const struct command command_completion = {
    .name = "completion",
    .group = "tool",
    .summary = "completion script for bash, zsh or fish",
    COMMAND_ASKS(struct completion_input),
    COMMAND_MAKES(artifacts),
};
