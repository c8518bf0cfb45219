/* exchange/codev/codev_words.c - words of a CODE V line: qualifiers, zeros. */
/* SPDX-License-Identifier: MIT */
#include "exchange/codev/codev.h"

#include <string.h>

/* The first three letters of each command count. */
const struct word_group codev_words[] = {
    {WORD_KEPT, "system", "radii or curvatures, unit, title, private catalogues of glasses",
     "RDM LEN DIM TIT PRV PWL END", 0},
    {WORD_KEPT, "system", "wavelengths, their weights and the reference", "WL WTW REF", 0},
    {WORD_KEPT, "system", "aperture", "EPD FNO NAO NA", 0},
    {WORD_KEPT, "system", "fields and their weights", "XAN YAN XOB YOB XIM YIM XRI YRI WTF", 0},
    {WORD_KEPT, "system", "a telecentric object space, an afocal image space", "TEL AFC", 0},
    {WORD_KEPT, "system", "positions", "ZOO", 0},
    {WORD_KEPT, "system", "the end", "GO", 0},
    {WORD_KEPT, "surface", "surfaces, the stop and labels", "S SO SI STO SLB", 0},
    {WORD_KEPT, "surface", "curvature, conic, distance and material",
     "RDY CUY RDX CUX K THI GLA RMD", 0},
    {WORD_KEPT, "surface", "shape and its coefficients",
     "SPH CON ASP CYL A B C D E F G H J SPS SCO", 0},
    {WORD_KEPT, "surface", "circular, rectangular and elliptic apertures and their decentres",
     "CIR REX REY ELX ELY ADX ADY", 0},
    {WORD_KEPT, "surface", "decentres, tilts, return and bend",
     "XDE YDE ZDE ADE BDE CDE DAR BEN REV", 0},
    {WORD_KEPT, "surface", "paraxial image, pick-ups and solves", "PIM PIK HMY HCY UMY UCY", 0},
    {WORD_KEPT, "system", "vignetting factors, where the clear diameters limit the beams",
     "VUX VLX VUY VLY", 0},
    {WORD_LOST, "system", "an apodised pupil", "PUI PUX PUY", WORD_VIGNETTES},
    {WORD_KEPT, "system", "temperature and pressure", "TEM PRE", 0},
    {WORD_LOST, "surface", "a turned aperture", "ARO", WORD_VIGNETTES},
    {WORD_LOST, "surface", "a toric, anamorphic or special surface", "XTO YTO AAS",
     WORD_COUNTS_AT_0 | WORD_HAS_POWER},
    {WORD_LOST, "surface", "a Fresnel surface of this base", "CUF", 0},
    {WORD_LOST, "surface", "a diffractive surface", "DIF HOR HWL HCT HCO",
     WORD_COUNTS_AT_0 | WORD_HAS_POWER},
    {WORD_LOST, "surface", "an offset of the point about which a surface turns", "XOD YOD ZOD", 0},
    {WORD_LOST, "surface", "a shift or turn that is related to another surface", "RET GLB",
     WORD_COUNTS_AT_0},
    {WORD_LOST, "surface", "a measured deformation", "INT", WORD_COUNTS_AT_0},
    {WORD_LOST, "surface", "an index that is changed", "INC", WORD_COUNTS_AT_0 | WORD_HAS_POWER},
    {WORD_HARMLESS, "system", "the author, what is drawn and in which colours",
     "INI UID CLS COM SAV LDM DER DOR", 0},
    {WORD_HARMLESS, "system", "polarised light, coatings", "POL MFL CWL TIR PTB", 0},
    {WORD_HARMLESS, "surface", "what the optimiser may vary or keeps together",
     "CCY CCX THC CUC GLC KC AC BC CC DC EC FC GC HC JC XDC YDC ZDC ADC BDC CDC HCC", 0},
    {WORD_HARMLESS, "surface", "tolerances and compensators",
     "TOL CMP DLF DLT DLR DLN DLV DSX DSY BTX BTY CUM THM CAX RMX CIN DPT FVR", 0},
    {WORD_HARMLESS, "surface", "rims for drawings and weights", "CA SD", 0},
    {WORD_REFUSED, "system", "commands of a macro",
     "IN OUT LCL GBL FOR IF ELS WHI UNT EVA RUN WRI WRT GOT RFD NUM STR AUT FCT ROW BUF DO INS DEL",
     0},
    {WORD_KEPT, NULL, NULL, NULL, 0},
};

struct codev_key codev_key(struct text word)
{
    struct codev_key key = {{0}};
    for (size_t i = 0; i < word.length && i < 3; i++) {
        char c = word.start[i];
        key.letters[i] = c >= 'a' && c <= 'z' ? (char)(c - 'a' + 'A') : c;
    }
    return key;
}

bool codev_is_zero(const struct codev *codev, size_t first)
{
    for (size_t i = first; i < codev->commands.count; i++) {
        const struct text word = codev->commands.words[i].text;
        double value = 1;
        if (number_read(word.start, word.start + word.length, NUMBER_UNSCALED, &value) == NULL ||
            value != 0) {
            return false;
        }
    }
    return true;
}

static bool is_any_quote(char c)
{
    return c == '\'' || c == '"';
}

/* A number of a surface, in digits alone. */
static bool surface_digits(struct text text, size_t *number)
{
    size_t value = 0;
    for (size_t i = 0; i < text.length; i++) {
        if (!char_is_digit(text.start[i]) || value > 100000) {
            return false;
        }
        value = 10 * value + (size_t)(text.start[i] - '0');
    }
    *number = value;
    return text.length > 0;
}

/* O, I, or S: the object, the image, the stop. */
static bool is_named_surface(struct text name)
{
    const char letter = name.length == 1 ? (char)(name.start[0] | 32) : 0;
    return letter == 'o' || letter == 'i' || letter == 's';
}

/* S3, SO, SI, SS (the stop), S'label'; false where it is none of these. */
static bool surface_named(const struct codev *codev, struct text name, size_t *surface)
{
    const struct sequence *sequence = &codev->sequence;
    char first = name.length > 0 ? (char)(name.start[0] | 32) : 0;
    if (is_named_surface(name) && first != 's') {
        *surface = first == 'o' ? 0 : sequence->count - 1;
        return sequence->count > 0;
    }
    for (size_t i = 0; i < sequence->count; i++) {
        const struct sequence_surface *one = &sequence->surfaces[i];
        bool is_stop = is_named_surface(name) && one->is_stop;
        bool is_label = name.length > 2 && is_any_quote(first) && one->name != NULL &&
                        text_same((struct text){name.start + 1, name.length - 2}, one->name);
        if (is_stop || is_label) {
            *surface = i;
            return true;
        }
    }
    return surface_digits(name, surface) && *surface < sequence->count;
}

/* "3..5" of S3..5 is "3", and "5" behind it; "3" is both. */
static struct text cut_surfaces(struct text name, struct text *last)
{
    *last = name;
    for (size_t i = 0; i + 1 < name.length && !is_any_quote(name.start[0]); i++) {
        if (name.start[i] == '.' && name.start[i + 1] == '.') {
            const size_t behind = i + 2 < name.length && (name.start[i + 2] | 32) == 's' &&
                                  i + 3 < name.length; /* S3..S5 */
            *last = (struct text){name.start + i + 2 + behind, name.length - i - 2 - behind};
            return (struct text){name.start, i};
        }
    }
    return name;
}

static bool is_digits(struct text text)
{
    size_t i = 0;
    while (i < text.length && char_is_digit(text.start[i])) {
        i++;
    }
    return i > 0 && i == text.length;
}

/* Has what stands behind the S the form of a surface, whether there is such a one or not? */
static bool is_surface_form(struct text name)
{
    struct text last, first = cut_surfaces(name, &last);
    return name.length > 0 &&
           (is_any_quote(name.start[0]) || ((is_digits(first) || is_named_surface(first)) &&
                                            (is_digits(last) || is_named_surface(last))));
}

/* Is the value of a command a name, that may look like a qualifier: the glass F2? */
static bool has_glass_or_label(const struct command_word *command)
{
    static const char *const commands[] = {"GLA", "RMD", "SLB"};
    const struct codev_key key = codev_key(command->text);
    bool is = false;
    for (size_t i = 0; i < sizeof commands / sizeof commands[0]; i++) {
        is = is || strcmp(key.letters, commands[i]) == 0;
    }
    return is;
}

char codev_qualifier_kind(const struct command_word *command, const struct command_word *word)
{
    const char letter = word->text.length > 1 ? (char)(word->text.start[0] | 32) : 0;
    const struct text rest = {word->text.start + 1, word->text.length - 1};
    if (letter == 0 || word->is_quoted) {
        return 0;
    }
    if (letter == 's') {
        return is_surface_form(rest) ? 's' : 0;
    }
    const char *letters = has_glass_or_label(command) ? "z" : "zfw";
    return strchr(letters, letter) != NULL && is_digits(rest) ? letter : 0;
}

size_t codev_qualifiers_end(const struct commands *commands, size_t first, size_t values)
{
    const struct command_word *command = &commands->words[first - 1];
    const bool is_list = has_glass_or_label(command) && commands->count > first + values;
    const size_t most = commands->count - (is_list ? values : 0);
    while (first < most && codev_qualifier_kind(command, &commands->words[first]) != 0) {
        first++;
    }
    return first;
}

bool codev_qualifiers(struct codev *codev, size_t first, struct codev_qualifiers *qualifiers)
{
    struct commands *commands = &codev->commands;
    const struct command_word *command = &commands->words[first - 1];
    *qualifiers =
        (struct codev_qualifiers){.surface = codev->surface,
                                  .end = codev->surface,
                                  .next = codev_qualifiers_end(commands, first, first == 1)};
    for (size_t i = first; i < qualifiers->next; i++) {
        const struct command_word word = commands->words[i];
        const char kind = codev_qualifier_kind(command, &word);
        size_t value = 0;
        if (kind == 's') {
            const struct text name = {word.text.start + 1, word.text.length - 1};
            struct text stop, start = cut_surfaces(name, &stop);
            if (!surface_named(codev, start, &qualifiers->surface) ||
                !surface_named(codev, stop, &qualifiers->end) ||
                !(qualifiers->surface <= qualifiers->end)) {
                return commands_fail(&codev->commands, &word, "there is no surface '%.*s'",
                                     (int)(word.text.length < 40 ? word.text.length : 40),
                                     word.text.start);
            }
            continue;
        }
        struct text number = {word.text.start + 1, word.text.length - 1};
        if (!commands_count(commands, &word, number, "number", 1, &value)) {
            return false;
        }
        qualifiers->zoom = kind == 'z' ? value : qualifiers->zoom;
        qualifiers->field = kind == 'f' ? value : qualifiers->field;
        qualifiers->wave = kind == 'w' ? value : qualifiers->wave;
    }
    return true;
}

const struct word_group *codev_group(struct text word)
{
    const struct codev_key key = codev_key(word);
    return word_group_of(codev_words, NULL, text_of(key.letters));
}

bool codev_is_harmless(struct text word)
{
    const struct word_group *group = codev_group(word);
    return group != NULL && group->fate == WORD_HARMLESS;
}
