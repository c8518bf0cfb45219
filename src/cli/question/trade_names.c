/* cli/question/trade_names.c - names of options in other programs and in the trade. */
/* SPDX-License-Identifier: MIT */
#include "cli/question/trade_names.h"

const struct trade_name trade_aliases[] = {
    {"fstop fnumber", "aperture"},
    {"shutter shutterspeed exposuretime", "time"},
    {"asa filmspeed", "iso"},
    {"subjectdistance focusdistance", "distance"},
    {"subjectspeed velocity", "speed"},
    {"camera body drone sensorsize", "sensor"},
    {"focal", "focal-length"},
    {"focal focallength", "telescope"},
    {"circleofconfusion", "coc"},
    {"extensiontube", "tube"},
    {"teleconverter extender tc", "converter"},
    {"closeup closeuplens", "close-up"},
    {"anamorphic desqueeze", "squeeze"},
    {"gn", "guide-number"},
    {"fps", "frame-rate"},
    {"eventlength", "event"},
    {"whitebalance wb", "balance"},
    {"cct colortemperature colourtemperature", "kelvin"},
    {"mainsfrequency", "mains"},
    {"printsize", "print"},
    {"agl flightheight", "altitude"},
    {"altitude", "distance"},
    {"groundsampledistance", "gsd"},
    {"cardsize", "card"},
    {"filesize", "frame-size"},
    {"pixel pixelsize pixelpitch", "pitch"},
    {"width", "field-width"},
    {"height", "field-height"},
    {"pixeldensity ppm pixelspermeter pixelspermetre", "density"},
    {"frontoverlap forwardoverlap frontlap", "overlap"},
    {"sideoverlap", "sidelap"},
    {"nits", "luminance"},
    {"lux", "illuminance"},
    {"screensize", "screen"},
    {"afov apparentfieldofview", "apparent-field"},
    {"numericalaperture", "na"},
    {"n1", "before"},
    {"n2", "after"},
    {NULL, NULL},
};

const struct trade_name trade_hints[] = {
    {"fstops stop av", "aperture"},
    {"speed tv", "time"},
    {"sensitivity", "iso"},
    {"nd ndfilter density stops", "filter"},
    {"focus subject objectdistance workingdistance wd throwdistance mfd closestfocus "
     "minimumfocus s",
     "distance"},
    {"light lighting condition", "scene"},
    {"filmformat", "sensor"},
    {"extension bellows", "tube"},
    {"diopter diopters dioptre dioptres", "close-up"},
    {"rate", "frame-rate"},
    {"duration", "event"},
    {"frames photos pictures exposures", "shots"},
    {"hz", "mains"},
    {"paper", "print"},
    {"groundsample", "gsd"},
    {"memory storage", "card"},
    {"fieldofview fov size", "field"},
    {"fieldofview fov size", "field-width"},
    {"ppf", "density"},
    {"resolution megapixels", "pixels"},
    {"brightness footlamberts", "luminance"},
    {"on", "to"},
    {"s do distance objectdistance", "object"},
    {"di imagedistance", "image"},
    {"lenses", "then"},
    {"pixels", "blur"},
    {"height cameraheight", "hinge"},
    {"bellows extension", "magnification"},
    {"medium", "before"},
    {NULL, NULL},
};

bool trade_name_is(const struct trade_name *one, struct text name)
{
    struct text words = text_of(one->names);
    bool found = false;
    while (words.length > 0 && !found) {
        found = text_same_name(name, text_cut(&words, ' '));
    }
    return found;
}
