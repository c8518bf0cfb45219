/* tests/fuzz/fuzz_odd.c - legal but odd lenses and scenes, and every command that takes one. */
/* SPDX-License-Identifier: MIT */
/*
 * The input is numbers, not text, so that it goes past the readers: CHUNK bytes say what is asked,
 * CHUNK what stands above the surfaces, and CHUNK each surface; of a scene likewise.
 */
#define _GNU_SOURCE /* memfd_create */
#include "ask.h"
#include "odd_lens.h"
#include "odd_scene.h"

/*
 * `@lens` is the lens, `@scene` the scene, `@svg` and `@pfm` are made. Behind '|' stand the letters
 * of the options that may be added. All is kept short: thousands are to be tried in minutes.
 */
static const char *const questions[] = {
    "lens @lens |jwNfxps",
    "surfaces @lens |jwNfps",
    "matrix @lens |jwps",
    "matrix @lens --perspective --json",
    "conjugate @lens --from front |jwNpsOm",
    "conjugate @lens --focus-by lens |jwNpsOm",
    "trace @lens |jwNfxhHpotcaAv",
    "trace @lens --pattern gauss --rays 6 |jwNfxhHpocav",
    "trace @lens --point 0:1:-5 --direction 0:0.1:1 --all |jwptcv",
    "check @lens --steps 2 |jwNfps",
    "pupil @lens |jwNfxhopu",
    "draw @lens |wNfxpsl",
    "draw @lens --construction |wNps",
    "seidel @lens |jwNfhpsOFP",
    "spot @lens --rays 9 |jwNfxhHpoOdcaS",
    "spot @lens --error 0.5 |jwNfhpodt",
    "spot @lens --rays 9 --plot @svg -o @json --json |wNfp",
    "illumination @lens --error 0.5 |jwNfhpoOdcP",
    "fan @lens --points 3 |jwNfxhHpoOdcaP",
    "wavefront @lens --rays 9 |jwNfxhHpoOdcaz",
    "wavefront @lens --size 8 --field 3 --map @pfm |wNod",
    "psf @lens --size 8 |jwNfxhHpoOdcaM",
    "psf @lens --size 8 --field 3 --map @pfm |wNod",
    "mtf @lens --error 0.1 --frequency 20 |jwNfxhHpoOdcaG",
    "mtf @lens --method geometric --error 0.1 --frequency 0,5 |jwNfhpoOdc",
    "field @lens |jwNfxhHpoOdP",
    "color @lens |jwNfxhHpoOdaP",
    "color @lens --steps 2 --show zone |jwNfxhpoOdaP",
    "color @lens --steps 2 --show field |jwNfpoOdP",
    "distortion @lens |jwNfxhHpoOdqP",
    "distortion @lens --fit brown |jwpN",
    "distortion @lens --grid @svg |wpo",
    "report @lens |Np",
    "fit @lens --rays 8 |jwNpsOcr",
    "fit @lens --prescription efl=100 --vary R1 --json",
    "optimize @lens --vary all-R --rays 8 --iterations 2 |jNpsac",
    "optimize @lens --vary all-t --goals efl=100,bfl=50 --iterations 2 --json |p",
    "optimize @lens --vary all-c --goals spot,opd --rays 8 --iterations 2 --json |Np",
    "tolerance @lens --grade high --trials 3 --rays 8 |jwNpsc",
    "tolerance @lens --grade commercial --show sensitivity --rays 8 --json |p",
    "tolerance @lens --grade commercial --method differential --trials 3 --rays 8 --json |p",
    "tolerance @lens --grade precision --criterion wavefront --trials 2 --rays 8 --json",
    "convert @lens |pRU",
    "convert @lens --to json |pRU",
    "convert @lens --to zmx --lossy |pR",
    "convert @lens --to seq --lossy |pR",
    "convert @lens --to len --lossy |pR",
    "convert @lens --to dat --lossy |pR",
    "convert @lens -f 50",
    "dof --lens @lens -s 3 --json |Npsw",
    "dof --lens @lens -s 3 -N 8 --exact --json |pw",
    "hyperfocal --lens @lens --json |Npw",
    "hyperfocal --lens @lens -N 8 --exact --json |p",
    "fov --lens @lens -s 3 --json |pw",
    "fov --lens @lens -s 3 --exact --json |p",
    "focus --lens @lens -s 3 --json |Npsw",
    "focus --lens @lens -s 3 --exact --json |p",
    "exposure --lens @lens -N 8 --ev 12 --json |pw",
    "exposure --lens @lens -N 8 --ev 12 --exact --json |p",
    "diffraction --lens @lens -N 8 --json |p",
    "equivalent --lens @lens -N 8 --sensor 4/3 --json |p",
    "render chart:edge --lens @lens -s 2 -o @pfm |wNpoK",
    "render @scene --lens @lens -s 2 -t 1/30 -o @pfm |NpoK",
    "render @scene --lens double-gauss -t 1/30 -o @pfm |NKLLB",
    "render @scene --lens double-gauss --model thin -s 2 -t 1/1000 -o @pfm --radiance |NLLB",
    "render @scene --lens double-gauss -s 2 -t 1/50 --noise -o @png |NLLB",
};

static const double apertures[] = {8, 0.5, 2, 1000, 1.4, 16, 64, 0.1};
static const char *const wavelengths[] = {"d", "400", "F,d,C", "1014", "10.6um", "0.3um", "e", "C"};
static const char *const lengths[] = {"0", "1", "-7", "1e-9", "1000", "21.6", "1e9", "-0.01"};

/* What an option's letter adds, with one of eight choices. */
static const struct choice {
    char letter;
    const char *option;
    const char *const values[8]; /* the rest of them repeat the first */
} choices[] = {
    {'j', "", {"--json", "--csv", "--explain", "--json --explain", "--json --digits 17"}},
    {'p', "--position", {"all", "all", "tele", "all", "wide"}},
    {'s', "--section", {"x", "y"}},
    {'f', "--field", {"0", "5", "-30", "89", "1e-9", "0,20", "120", "60"}},
    {'x', "--field-x", {"3", "-40", "1e-7", "80"}},
    {'o', "--focus", {"best", "paraxial", "table", "0", "50", "-20", "1e6", "1e-6"}},
    {'O', "--object", {"1m", "1mm", "1e9", "50", "1e-3", "1e15", "100", "inf"}},
    {'m', "-m", {"-1", "0.5", "-1e-6", "1e4", "1", "-1:10"}},
    {'t', "--to", {"1", "last", "2", "3", "image"}},
    {'c', "", {"--no-clip"}},
    {'a', "", {"--aim entrance"}},
    {'A', "--pupil-point", {"0:1", "0:0", "0.7:-0.7", "1:0"}},
    {'v', "", {"--verify", "--paraxial", "--all"}},
    {'H', "", {"--real --height 5", "--real --height -1e-6", "--height 3 --height-x 4"}},
    {'u', "", {"--outline 5", "--side exit", "--plot @svg -o @json"}},
    {'l', "", {"--planes", "--no-rays"}},
    {'F', "--form", {"waves", "transverse", "longitudinal"}},
    {'P', "", {"--plot @svg -o @json"}},
    {'S', "", {"--pattern hexapolar", "--pattern sobol", "--weight beam", "--energy 80%"}},
    {'z', "--zernike", {"noll", "fringe"}},
    {'M', "--method", {"fft", "direct", "huygens"}},
    {'G', "--pitch", {"5um", "1um"}},
    {'q', "", {"--projection equidistant", "--projection rectilinear", "--calibrated"}},
    {'r', "", {"--chromatic", "--match rays", "--show residuals", "--distortion 3"}},
    {'R', "", {"--reverse", "--scale 1e-3", "--scale 1e4", "--scale 7"}},
    {'U', "--unit", {"in", "m", "cm", "mm"}},
    {'K', "--model", {"paraxial", "thick", "thin", "pinhole", "exact", "fitted"}},
    {'L', "", {"--spectral --bands 8", "--bounces 0", "--bounces 12", "--no-skip all"}},
    {'B', "--crop", {"2:2:4x2", "0:0:1x1"}},
};

/* The question: words up to '|', and options of the letters behind it. */
static void question_write(struct page *page, const char *pattern, struct bytes bytes)
{
    const char *letters = strchr(pattern, '|');
    const size_t length = letters != NULL ? (size_t)(letters - pattern) : strlen(pattern);
    page_add(page, "%.*s", (int)length, pattern);
    if (strncmp(pattern, "render", 6) == 0) {
        page_add(page, " --sensor 8x6mm --size 8x6 --samples 2 --force");
    }
    for (const char *letter = letters != NULL ? letters + 1 : ""; *letter != '\0'; letter++) {
        const unsigned byte = bytes_next(&bytes), value = byte / 3 % 8;
        if (byte % 3 != 1) {
            continue;
        }
        switch (*letter) {
        case 'w':
            page_add(page, " -w %s", wavelengths[value]);
            break;
        case 'N':
            page_add(page, " -N %g", apertures[value]);
            break;
        case 'h':
            page_add(page, " --height %s", lengths[value]);
            break;
        case 'd':
            page_add(page, " --defocus %s", lengths[value]);
            break;
        default:
            for (size_t i = 0; i < sizeof choices / sizeof choices[0]; i++) {
                const struct choice *choice = &choices[i];
                if (choice->letter == *letter) {
                    const char *text = choice->values[value];
                    page_add(page, " %s %s", choice->option, text ? text : choice->values[0]);
                }
            }
        }
    }
}

/* All files are taken away. Of those that the question made no number is none, but of a map of
   waves beside its pupil. */
static void require_made(const char *question, struct arena *arena)
{
    const struct text drawing = ask_take("svg", arena), picture = ask_take("pfm", arena);
    const char *at = picture.start, *end = at + picture.length;
    REQUIRE(!ask_says_nan(drawing, true));
    REQUIRE(strstr(drawing.start, "=\"inf") == NULL && strstr(drawing.start, "=\"-inf") == NULL);
    for (int line = 0; line < 3 && at < end; line++) {
        at = (const char *)memchr(at, '\n', (size_t)(end - at)) + 1;
    }
    for (float value; at < end; at += sizeof value) {
        memcpy(&value, at, sizeof value);
        REQUIRE(isfinite(value) || (isnan(value) && strstr(question, "wavefront") != NULL));
    }
    static const char *const others[] = {"json", "png", "lens", "scene", "map", "sky", "obj"};
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        ask_take(others[i], arena);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static struct page question, lens, scene;
    struct bytes input = {data, data + size}, head = bytes_chunk(&input);
    struct arena arena = {0};
    question.length = lens.length = scene.length = 0;
    const char *pattern = questions[bytes_pick(&head, sizeof questions / sizeof questions[0])];
    question_write(&question, pattern, head);
    const bool has_lens = strstr(pattern, "@lens") != NULL;
    if (strstr(pattern, "@scene") != NULL) {
        scene_files_write(&input);
        scene_write(&scene, &input, ask_stem, has_lens ? SCENE_BESIDE_LENS : SCENE_MOST);
        ask_file("scene", scene.text, scene.length);
    }
    if (has_lens) {
        lens_write(&lens, &input);
        ask_file("lens", lens.text, lens.length);
    }
    ask(question.text, (struct text){"", 0}, &arena);
    require_made(pattern, &arena);
    arena_free(&arena);
    return 0;
}
