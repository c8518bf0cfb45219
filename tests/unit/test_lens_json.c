/* tests/unit/test_lens_json.c - lenses in JSON: every key, and every wrong value of it. */
/* SPDX-License-Identifier: MIT */
#include "foreign_cases.h"

static const char good[] =
    "{\"lens\":\"Singlet\",\"source\":null,\"kind\":null,\"notes\":[],\"positions\":[]\n"
    ",\"unit\":\"mm\",\"wavelengths\":[{\"name\":\"d\",\"wavelength_nm\":587.5618,\"weight\":1}]\n"
    ",\"object_mm\":null,\"object_is_infinite\":true,\"object_medium\":\"air\"\n"
    ",\"field_kind\":\"angle_deg\",\"fields\":[0,10],\"aperture_kind\":\"epd_mm\",\"aperture\":10\n"
    ",\"focus\":\"table\",\"stop_surface\":1,\"stated_efl_mm\":[],\"stated_fnumber\":[]\n"
    ",\"surfaces\":[\n"
    "{\"surface\":1,\"kind\":\"refract\",\"is_stop\":true,\"name\":null,\"radius_mm\":50,"
    "\"radius_is_infinite\":false,\"thickness_mm\":4,\"medium\":\"1.5\",\"diameter_mm\":12,"
    "\"conic\":0},\n"
    "{\"surface\":2,\"kind\":\"refract\",\"is_stop\":false,\"radius_mm\":null,\"thickness_mm\":90,"
    "\"medium\":\"air\",\"diameter_mm\":null}\n"
    "]}\n";

static const struct meaning meanings[] = {
    {"", "", "lens Singlet\nunit mm\nwavelength d\nobject inf\nfield angle 0 10\naperture epd 10"},
    {"", "", "surface 50 4 1.5 12 stop\nsurface - 90 air -"},
    /* texts, as a .lens file can hold them */
    {"\"Singlet\"", "\"\\u00b5 \\\"a\\\" \\ud835\\udc53\"", "lens \xc2\xb5 \"a\" \xf0\x9d\x91\x93"},
    {"\"source\":null", "\"source\":\"#1 a#b\\t#2\"", "source No.1 a#b No.2"},
    {"\"kind\":null", "\"kind\":\"triplet\"", "kind triplet"},
    {"\"notes\":[]", "\"notes\":[\"one\",\"two\"]", "note one\nnote two"},
    {"\"notes\":[]", "\"notes\":null", "lens Singlet\nunit mm"},
    /* in another unit the digits are those of the unit: 25.4 mm */
    {"\"mm\",", "\"in\",", "aperture epd 0.3937007874015748031496062992126"},
    {"mm\",\"wavelengths\":[{\"name\":\"d\"", "cm\",\"wavelengths\":[{\"name\":\"d\"",
     "surface 5 0.4 1.5 1.2 stop"},
    {"\"mm\",", "\"m\",", "surface 0.05 0.004 1.5 0.012 stop"},
    {"\"mm\"", "null", "unit mm"},
    {"\"unit\":\"mm\",", "\"unit\":\"mm\" , ", "unit mm"},
    /* light */
    {"{\"name\":\"d\",\"wavelength_nm\":587.5618,\"weight\":1}", "", "unit mm\nobject inf"},
    {"\"wavelengths\":[", "\"wavelengths\":[{\"wavelength_nm\":1064,\"weight\":0.25},",
     "wavelength 1.064um:0.25 d"},
    {"\"name\":\"d\"", "\"name\":\"F\"", "wavelength d"}, /* the number decides */
    {"\"name\":\"d\"", "\"name\":7", "wavelength d"},
    {"\"name\":\"d\",\"wavelength_nm\":587.5618,\"weight\":1",
     "\"name\":\"0.532um\",\"wavelength_nm\":532,\"weight\":null", "wavelength 0.532um"},
    /* object, fields, aperture */
    {"\"object_mm\":null,\"object_is_infinite\":true",
     "\"object_mm\":200,\"object_is_infinite\":false", "object 200"},
    {"\"object_medium\":\"air\"", "\"object_medium\":\"1.333\"", "object inf\nmedium 1.333"},
    {"\"angle_deg\",\"fields\":[0,10]", "\"height_mm\",\"fields\":[0,-7.5]", "field height 0 -7.5"},
    {"\"angle_deg\",\"fields\":[0,10]", "\"image_mm\",\"fields\":[21.6]", "field image 21.6"},
    {"\"angle_deg\",\"fields\":[0,10]", "\"real_mm\",\"fields\":[21.6]", "field real 21.6"},
    {"\"angle_deg\",\"fields\":[0,10]",
     "\"angle_deg\",\"fields\":[0,10],\"fields_x\":[0,-2.5],\"field_weights\":[1,0.5]",
     "field angle 0 -2.5,10:0.5"},
    {"\"angle_deg\",\"fields\":[0,10]", "null,\"fields\":[]", "object inf\naperture epd 10"},
    {"\"epd_mm\",\"aperture\":10", "\"fnumber\",\"aperture\":2.8", "aperture f/2.8"},
    {"\"epd_mm\",\"aperture\":10", "\"na\",\"aperture\":0.25", "aperture na 0.25"},
    {"\"epd_mm\",\"aperture\":10", "\"stop\",\"aperture\":null", "aperture stop"},
    {"\"epd_mm\",\"aperture\":10", "null,\"aperture\":null", "field angle 0 10\nfocus table"},
    {"\"table\"", "\"best\"", "focus best"},
    {"\"table\"", "\"paraxial\"", "focus paraxial"},
    {"\"table\"", "null", "focus paraxial"},
    {"\"stated_efl_mm\":[]", "\"stated_efl_mm\":[100.5]", "stated efl 100.5"},
    {"\"stated_efl_mm\":[]", "\"stated_bfl_mm\":[-3]", "stated bfl -3"},
    {"\"stated_fnumber\":[]", "\"stated_fnumber\":[2.8]", "stated fnumber 2.8"},
    /* surfaces */
    {"\"radius_mm\":50,\"radius_is_infinite\":false", "\"curvature_per_mm\":0.02",
     "surface - 4 1.5 12 c=0.02 stop"},
    {"\"radius_mm\":50,\"radius_is_infinite\":false",
     "\"radius_mm\":null,\"radius_is_infinite\":true", "surface - 4 1.5 12 stop"},
    {"\"medium\":\"1.5\"", "\"medium\":\"SCHOTT:N-BK7\"", "surface 50 4 SCHOTT:N-BK7 12 stop"},
    {"\"medium\":\"1.5\"", "\"medium\":\"1.5168/64.17\"", "surface 50 4 1.5168/64.17 12 stop"},
    {"\"medium\":\"1.5\"", "\"medium\":\"{500nm 1.5, 600nm 1.4}\"",
     "surface 50 4 {500nm 1.5, 600nm 1.4} 12 stop"},
    {"\"medium\":\"1.5\"", "\"medium\":null", "surface 50 4 air 12 stop"},
    {"\"thickness_mm\":90", "\"thickness_mm\":null", "surface - - air -"},
    {"\"conic\":0", "\"conic\":-1.5", "surface 50 4 1.5 12 k=-1.5 stop"},
    {"\"conic\":0", "\"conic\":0,\"coefficients_mm\":{\"A4\":1e-6,\"A1\":0.5}",
     "surface 50 4 1.5 12 A1=0.5 A4=1e-06 stop"},
    {"\"conic\":0", "\"conic\":0,\"cylinder\":\"x\"", "surface 50 4 1.5 12 stop cyl=x"},
    {"\"conic\":0", "\"conic\":0,\"cylinder\":\"y\"", "surface 50 4 1.5 12 stop cyl=y"},
    {"\"conic\":0", "\"conic\":0,\"cylinder\":\"both\"", "surface 50 4 1.5 12 stop"},
    {"\"conic\":0", "\"moved\":{\"decenter_mm\":[0.5,-1],\"tilt_deg\":[15,-2,0]}",
     "surface 50 4 1.5 12 stop decenter=0.5,-1 tilt=15,-2"},
    {"\"conic\":0", "\"bend_before\":{\"tilt_deg\":[1,2,3],\"decenter_mm\":[0,0]}",
     "bend decenter=0,0 tilt=1,2,3\nsurface 50 4 1.5 12 stop"},
    {"\"name\":null", "\"name\":\"front\"", "surface 50 4 1.5 12 stop name=\"front\""},
    {"\"conic\":0", "\"vary\":[{\"what\":\"R\"},{\"what\":\"t\",\"low\":2,\"high\":10}]",
     "surface 50 4 1.5 12 stop R~ t~[2,10]"},
    {"\"kind\":\"refract\",\"is_stop\":false,\"radius_mm\":null,\"thickness_mm\":90,"
     "\"medium\":\"air\"",
     "\"kind\":\"reflect\",\"thickness_mm\":-90,\"medium\":\"mirror\"", "surface - -90 mirror -"},
    {"\"kind\":\"refract\",\"is_stop\":true,\"name\":null,\"radius_mm\":50,"
     "\"radius_is_infinite\":false",
     "\"kind\":\"stop\",\"is_stop\":true", "stop - 4 1.5 12"},
    {"\"kind\":\"refract\",\"is_stop\":false",
     "\"kind\":\"thick\",\"focal_mm\":80,\"hiatus_mm\":2,\"distortion\":[0.01,0,0]",
     "thick 80 90 air - hiatus=2 distortion=0.01"},
    {"\"kind\":\"refract\",\"is_stop\":false", "\"kind\":\"thick\",\"focal_mm\":-80",
     "thin -80 90 air -"},
};

/* 1 in = 25.4 mm: 25.4, 50.8, 1/25.4 and 25.4^-3 are exact in inches. */
static const struct meaning inches[] = {
    {"", "", "surface 2 0.5 1.5 1 stop"},
    {"\"radius_mm\":50.8", "\"curvature_per_mm\":0.02", "surface - 0.5 1.5 1 c=0.508 stop"},
    {"\"conic\":0", "\"coefficients_mm\":{\"A4\":1e-6,\"A2\":0.01}",
     "surface 2 0.5 1.5 1 A2=0.254 A4=0.016387064 stop"},
    {"\"conic\":0", "\"moved\":{\"decenter_mm\":[2.54,0],\"tilt_deg\":[1,0,0]}",
     "surface 2 0.5 1.5 1 stop decenter=0.1,0 tilt=1,0"},
    {"\"conic\":0",
     "\"vary\":[{\"what\":\"R\",\"low\":25.4,\"high\":76.2},"
     "{\"what\":\"A4\",\"low\":-1e-6,\"high\":1e-6}]",
     "surface 2 0.5 1.5 1 stop R~[1,3] A4~[-0.016387064,0.016387064]"},
};
static const char good_inches[] =
    "{\"lens\":null,\"unit\":\"in\",\"surfaces\":[{\"kind\":\"refract\",\"is_stop\":true,"
    "\"radius_mm\":50.8,\"thickness_mm\":12.7,\"medium\":\"1.5\",\"diameter_mm\":25.4,\"conic\":0},"
    "{\"kind\":\"refract\"}]}";

/* What differs between positions is an array. */
static const char zoom[] =
    "{\"lens\":null,\"positions\":[\"wide\",\"tele\"],\"object_mm\":[null,500],\n"
    "\"aperture_kind\":\"fnumber\",\"aperture\":[2.8,4],\"stated_efl_mm\":[50,80],\"surfaces\":[\n"
    "{\"kind\":\"refract\",\"is_stop\":true,\"radius_mm\":50,\"thickness_mm\":[4,5],"
    "\"medium\":\"1.5\",\"diameter_mm\":[10,12]},\n"
    "{\"kind\":\"thick\",\"focal_mm\":[100,120],\"hiatus_mm\":[1,2]}]}\n";
static const struct meaning zooms[] = {
    {"", "", "let d1 4 5\nlet a1 10 12\nlet f2 100 120\nlet h2 1 2"},
    {"", "", "let object inf 500\nlet aperture f/2.8 f/4"},
    {"", "", "stated efl 50 80"},
    {"[50,80]", "[65]", "position wide tele\nstated efl 65"},
    {"", "", "surface 50 d1 1.5 a1 stop\nthick f2 - air - hiatus=h2"},
};

static const char two[] = "2 values, but the lens has 0 positions";
static const char three[] = "3 values, but the lens has 2 positions";
static const char number[] = "expected a number below 1e100 here";
static const char array[] = "expected an array of numbers here";
static const char together[] = "the kind \"reflect\" and the medium \"mirror\" go together";
static const char marks[] = "what varies is R, c, t, k, A4, glass, dx, dy, ax or ay";

static const struct refusal refusals[] = {
    {"{\"lens\":\"Singlet\"", "@{\"name\":\"Singlet\"",
     "no JSON of lenscalc, which begins with \"lens\" and has \"surfaces\"; that of other programs "
     "(ray-optics) is not read",
     NULL},
    {"\"lens\":\"Singlet\"", "\"lens\":@7", "expected a text here", NULL},
    {"\"source\":null", "\"source\":@[]", "expected a text here", NULL},
    {"\"kind\":null", "\"kind\":@true", "expected a text here", NULL},
    {"\"notes\":[]", "\"notes\":\"@one\"", "expected an array of texts here", NULL},
    {"\"notes\":[]", "\"notes\":[\"one\",@2]", "a note is a text", NULL},
    {"\"positions\":[]", "\"positions\":@2", "expected an array of names here", NULL},
    {"\"positions\":[]", "\"positions\":[\"a\",@2]",
     "a position's name is a word, not 'all', and appears once", NULL},
    {"\"positions\":[]", "\"positions\":[\"a\",\"@a\"]",
     "a position's name is a word, not 'all', and appears once", NULL},
    {"\"positions\":[]", "\"positions\":[\"@all\"]",
     "a position's name is a word, not 'all', and appears once", NULL},
    {"\"positions\":[]", "\"positions\":[\"@two words\"]",
     "a position's name is a word, not 'all', and appears once", NULL},
    {"\"unit\":\"mm\"", "\"unit\":\"@ft\"", "expected one of mm .. in here", NULL},
    {"\"unit\":\"mm\"", "\"unit\":@25.4", "expected one of mm .. in here", NULL},
    {"\"source\":null", "\"sauce\":@null", "unknown key 'sauce'", ""},
    {"\"source\":null", "\"source\":null,\"lens\":@null", "the key 'lens' appears twice", NULL},
    /* light */
    {"[{\"name\":\"d\",\"wavelength_nm\":587.5618,\"weight\":1}]", "@587.5618",
     "expected an array of wavelengths here", NULL},
    {"[{\"name\":\"d\",\"wavelength_nm\":587.5618,\"weight\":1}]", "[@587.5618]",
     "a wavelength without its nm", NULL},
    {"{\"name\":\"d\",\"wavelength_nm\":587.5618", "@{\"name\":\"d\"",
     "a wavelength without its nm", NULL},
    {"\"wavelength_nm\":587.5618", "\"wavelength_nm\":\"@d\"", number, NULL},
    {"{\"name\":\"d\",\"wavelength_nm\":587.5618", "@{\"wavelength_nm\":0.5",
     "a wavelength is within 1 to 1e6 nm, a weight is not below 0", NULL},
    {"{\"name\":\"d\",\"wavelength_nm\":587.5618", "@{\"wavelength_nm\":1000001",
     "a wavelength is within 1 to 1e6 nm, a weight is not below 0", NULL},
    {"{\"name\":\"d\",\"wavelength_nm\":587.5618,\"weight\":1",
     "@{\"wavelength_nm\":550,\"weight\":-1",
     "a wavelength is within 1 to 1e6 nm, a weight is not below 0", NULL},
    {"\"weight\":1", "\"weight\":@[1]", number, NULL},
    {"\"weight\":1", "\"wait\":@1", "unknown key 'wait'", ""},
    /* object, fields, aperture */
    {"\"object_mm\":null", "\"object_mm\":@0", "the object's distance is above 0", NULL},
    {"\"object_mm\":null", "\"object_mm\":@-5", "the object's distance is above 0", NULL},
    {"\"object_mm\":null", "\"object_mm\":\"@far\"", number, NULL},
    {"\"object_mm\":null", "\"object_mm\":@[1,2]", two, NULL},
    {"\"object_mm\":null", "\"object_mm\":[@0,2]", "the object's distance is above 0", NULL},
    {"\"object_mm\":null,\"object_is_infinite\":true",
     "\"object_mm\":200,\"object_is_infinite\":@true", "object_is_infinite contradicts object_mm",
     NULL},
    {"\"object_is_infinite\":true", "\"object_is_infinite\":@false",
     "object_is_infinite contradicts object_mm", NULL},
    {"\"object_is_infinite\":true", "\"object_is_infinite\":@1", "expected true or false here",
     NULL},
    {"\"object_medium\":\"air\"", "\"object_medium\":@1.5",
     "a medium is a text, as in a .lens file", NULL},
    {"\"angle_deg\"", "\"@degrees\"", "expected one of none .. real_mm here", NULL},
    {"\"fields\":[0,10]", "\"fields\":@10", array, NULL},
    {"\"fields\":[0,10]", "\"fields\":[0,@true]", number, NULL},
    {"\"fields\":[0,10]", "\"fields\":@[0,180.5]", "a field angle is not beyond 180 degrees", NULL},
    {"\"angle_deg\",\"fields\":[0,10]", "null,\"fields\":@[0,10]", "fields without their kind",
     NULL},
    {"\"epd_mm\"", "\"@EPD\"", "expected one of none .. na here", NULL},
    {"\"epd_mm\",\"aperture\":10", "\"@epd_mm\",\"aperture\":null", "an aperture without its value",
     NULL},
    {"\"aperture\":10", "\"aperture\":@0", "the aperture must be above 0", NULL},
    {"\"aperture\":10", "\"aperture\":\"@10\"", number, NULL},
    {"\"aperture\":10", "\"aperture\":@[10,12]", two, NULL},
    {"\"epd_mm\",\"aperture\":10", "null,\"aperture\":@10", "an aperture without its kind", NULL},
    {"\"epd_mm\",\"aperture\":10", "\"stop\",\"aperture\":@10",
     "the stop's diameter is that of its surface", NULL},
    {"\"table\"", "\"@infinity\"", "expected one of paraxial .. afocal here", NULL},
    {"\"stop_surface\":1", "\"stop_surface\":@2", "stop_surface contradicts is_stop", NULL},
    {"\"stop_surface\":1", "\"stop_surface\":@null", "stop_surface contradicts is_stop", NULL},
    {"\"stop_surface\":1", "\"stop_surface\":\"@1\"", number, NULL},
    {"\"stated_efl_mm\":[]", "\"stated_efl_mm\":@100", array, NULL},
    {"\"stated_efl_mm\":[]", "\"stated_efl_mm\":[\"@100\"]", number, NULL},
    {"\"stated_efl_mm\":[]", "\"stated_efl_mm\":@[100,200]", two, NULL},
};

static const struct refusal surfaces[] = {
    {"{\"surface\":1", "@5,{\"surface\":1", "a surface is an object", NULL},
    {"\"conic\":0", "\"vary\":[{\"what\":\"R\"},@{\"what\":\"R\"}]", "'R' is marked twice", NULL},
    {"\"conic\":0", "\"vary\":[{\"what\":\"R\",\"low\":@60,\"high\":40}]",
     "the lower bound is above the upper", NULL},
    {"\"surface\":2", "\"surface\":@3", "another surface, where surface 2 is expected", NULL},
    {"\"surface\":2", "\"surface\":\"@2\"", number, NULL},
    {"\"is_stop\":true", "\"is_stop\":@1", "expected true or false here", NULL},
    {"{\"surface\":2,\"kind\":\"refract\",\"is_stop\":false",
     "@{\"surface\":2,\"kind\":\"refract\",\"is_stop\":true", "a second stop", NULL},
    {"{\"surface\":1,\"kind\":\"refract\"", "@{\"surface\":1", "the kind of the surface is missing",
     NULL},
    {"\"kind\":\"refract\",\"is_stop\":false", "\"kind\":\"@grating\",\"is_stop\":false",
     "expected one of refract .. thick here", NULL},
    {"\"kind\":\"refract\"", "\"kind\":\"@stop\"", "a stop is a plane with \"is_stop\": true",
     NULL},
    {"\"kind\":\"refract\",\"is_stop\":false", "\"kind\":\"@stop\",\"is_stop\":false",
     "a stop is a plane with \"is_stop\": true", NULL},
    {"\"radius_mm\":50", "\"radius_mm\":\"@50\"", number, NULL},
    {"\"radius_mm\":50", "\"radius_mm\":@1e100", number, NULL},
    {"\"radius_mm\":50", "\"radius_mm\":50,\"curvature_per_mm\":@0.02",
     "a curvature beside a radius", NULL},
    {"\"radius_is_infinite\":false", "\"radius_is_infinite\":@true",
     "radius_is_infinite contradicts radius_mm", NULL},
    {"\"radius_mm\":50,\"radius_is_infinite\":false",
     "\"radius_mm\":null,\"radius_is_infinite\":@false", "radius_is_infinite contradicts radius_mm",
     NULL},
    {"\"thickness_mm\":4", "\"thickness_mm\":\"@4\"", number, NULL},
    {"\"thickness_mm\":4", "\"thickness_mm\":@[4,5]", two, NULL},
    {"{\"surface\":1,\"kind\":\"refract\",\"is_stop\":true,\"name\":null,\"radius_mm\":50,"
     "\"radius_is_infinite\":false,\"thickness_mm\":4",
     "@{\"surface\":1,\"kind\":\"refract\",\"is_stop\":true,\"radius_mm\":50",
     "the thickness is missing", NULL},
    {"\"diameter_mm\":12", "\"diameter_mm\":@true", number, NULL},
    {"{\"surface\":1,\"kind\":\"refract\",\"is_stop\":true,\"name\":null,\"radius_mm\":50,"
     "\"radius_is_infinite\":false,\"thickness_mm\":4,\"medium\":\"1.5\",\"diameter_mm\":12",
     "@{\"kind\":\"refract\",\"thickness_mm\":4,\"diameter_mm\":0", "the diameter must be above 0",
     NULL},
    {"\"conic\":0", "\"conic\":@true", number, NULL},
    {"\"conic\":0", "\"conic\":@[0]", number, NULL},
    {"\"conic\":0", "\"coefficients_mm\":@[1]", "expected an object with A1 .. A20 here", NULL},
    {"\"conic\":0", "\"coefficients_mm\":{\"A4\":@null}", number, NULL},
    {"\"conic\":0", "\"coefficients_mm\":{\"A21\":@1}", "unknown key 'A21'", ""},
    {"\"conic\":0", "\"coefficients_mm\":{\"A4\":1e-5,\"\":@1}", "unknown key ''", ""},
    {"\"conic\":0", "\"cylinder\":\"@z\"", "expected one of both .. y here", NULL},
    {"\"conic\":0", "\"moved\":@[0,0]", "expected two decentres and three tilts here", NULL},
    {"\"conic\":0", "\"moved\":@{\"decenter_mm\":[0,0],\"tilt_deg\":[1,2]}",
     "expected two decentres and three tilts here", NULL},
    {"\"conic\":0", "\"moved\":@{\"decenter_mm\":[0],\"tilt_deg\":[1,2,0]}",
     "expected two decentres and three tilts here", NULL},
    {"\"conic\":0", "\"moved\":@{\"tilt_deg\":[1,2,0]}",
     "expected two decentres and three tilts here", NULL},
    {"\"conic\":0", "\"moved\":{\"decenter_mm\":[0,0],\"tilt_deg\":@[1,2,3]}",
     "a surface is not turned about z", NULL},
    {"\"conic\":0", "\"moved\":{\"decenter_mm\":[0,\"@\"],\"tilt_deg\":[1,2,0]}", number, NULL},
    {"\"conic\":0", "\"moved\":{\"decenter_mm\":[0,0],\"tilt_deg\":[1,@{},0]}", number, NULL},
    {"\"conic\":0", "\"bend_before\":{\"decenter_mm\":[0,0],\"tilt_deg\":[1,0,0],\"z\":@1}",
     "unknown key 'z'", ""},
    {"\"medium\":\"1.5\"", "\"medium\":@1.5", "a medium is a text, as in a .lens file", NULL},
    {"\"medium\":\"1.5\"", "\"medium\":\"@1.5 # 2\"", "no medium of a .lens file", NULL},
    {"\"medium\":\"1.5\"", "\"medium\":\"1.5\",\"index\":@1.5",
     "expected an array of 1 indices here", NULL},
    {"\"medium\":\"1.5\"", "\"medium\":\"1.5\",\"index\":[@1.6]", "the index of 1.5 is 1.5 here",
     NULL},
    {"\"medium\":\"1.5\"", "\"medium\":\"1.5\",\"index\":[\"@1.5\"]", number, NULL},
    {"\"kind\":\"refract\",\"is_stop\":false,\"radius_mm\":null,\"thickness_mm\":90,"
     "\"medium\":\"air\"",
     "\"kind\":\"reflect\",\"thickness_mm\":90,\"medium\":\"@air\"", together, NULL},
    {"\"medium\":\"1.5\"", "\"medium\":\"@mirror\"", together, NULL},
    {"\"kind\":\"refract\",\"is_stop\":true,\"name\":null,\"radius_mm\":50,"
     "\"radius_is_infinite\":false,\"thickness_mm\":4,\"medium\":\"1.5\",\"diameter_mm\":12,"
     "\"conic\":0",
     "\"kind\":\"stop\",\"is_stop\":true,\"thickness_mm\":4,\"conic\":@-1",
     "conic belongs to a surface that is curved", NULL},
    {"\"kind\":\"refract\",\"is_stop\":false",
     "\"kind\":\"thick\",\"focal_mm\":50,\"coefficients_mm\":@{\"A4\":1}",
     "coefficients_mm belongs to a surface that is curved", NULL},
    {"\"kind\":\"refract\",\"is_stop\":false",
     "\"kind\":\"thick\",\"focal_mm\":50,\"cylinder\":\"@x\"",
     "cylinder belongs to a surface that is curved", NULL},
    {"\"conic\":0",
     "\"apertures\":[{\"shape\":\"polygon\",\"blocks\":false,"
     "\"points_mm\":[[1,1],@null,[2,-1],[1,-1]]}]",
     "expected x and y here", NULL},
    {"\"conic\":0",
     "\"apertures\":[{\"shape\":\"polygon\",\"blocks\":false,"
     "\"points_mm\":[[1,1],@[2],[1,-1]]}]",
     "expected x and y here", NULL},
    {"\"name\":null", "\"name\":@5", "expected a text here", NULL},
    {"\"name\":null", "\"name\":\"@a\\\"b\"", "a name of a surface has no double quotes", NULL},
    {"\"conic\":0", "\"vary\":@{}", "expected an array here", NULL},
    {"\"conic\":0", "\"vary\":[\"@R\"]", marks, NULL},
    {"\"conic\":0", "\"vary\":[@{\"what\":\"Q\"}]", marks, NULL},
    {"\"conic\":0", "\"vary\":[@{\"what\":\"R\",\"low\":1}]", marks, NULL},
    {"\"conic\":0", "\"vary\":[@{\"what\":3}]", marks, NULL},
    {"\"conic\":0", "\"vary\":[{\"what\":\"R\",\"low\":@true,\"high\":4}]", number, NULL},
    {"\"conic\":0", "\"vary\":[{\"what\":\"R\",\"low\":1,\"high\":@{}}]", number, NULL},
    {"\"conic\":0", "\"vary\":[{\"what\":\"R\",\"many\":@1}]", "unknown key 'many'", ""},
    {"\"conic\":0", "\"focal_mm\":@50", "only a thick lens has this", NULL},
    {"\"conic\":0", "\"hiatus_mm\":@1", "only a thick lens has this", NULL},
    {"\"conic\":0", "\"distortion\":@[0,0,0]", "only a thick lens has this", NULL},
    {"{\"surface\":2,\"kind\":\"refract\"", "@{\"surface\":2,\"kind\":\"thick\"",
     "a thick lens has a focal length and no radius", NULL},
    {"\"kind\":\"refract\",\"is_stop\":false", "\"kind\":\"thick\",\"focal_mm\":\"@50\"", number,
     NULL},
    {"\"kind\":\"refract\",\"is_stop\":false",
     "\"kind\":\"thick\",\"focal_mm\":50,\"hiatus_mm\":@true", number, NULL},
    {"\"kind\":\"refract\",\"is_stop\":false",
     "\"kind\":\"thick\",\"focal_mm\":50,\"distortion\":@[1,2]",
     "expected three terms of distortion here", NULL},
    {"\"kind\":\"refract\",\"is_stop\":false",
     "\"kind\":\"thick\",\"focal_mm\":50,\"distortion\":[1,2,@null]", number, NULL},
};

static const struct refusal zoom_refusals[] = {
    {"[null,500]", "[null,@-5]", "the object's distance is above 0", NULL},
    {"[null,500]", "@[null,500,1]", three, NULL},
    {"[null,500]", "[null,500],\"object_is_infinite\":[true,@true]",
     "object_is_infinite contradicts object_mm", NULL},
    {"[null,500]", "[null,500],\"object_is_infinite\":@[true]",
     "1 values, but the lens has 2 positions", NULL},
    {"[2.8,4]", "@[2.8,4,5]", three, NULL},
    {"[2.8,4]", "[2.8,@false]", number, NULL},
    {"[2.8,4]", "@[2.8,-1]", "the aperture must be above 0", NULL},
    {"[50,80]", "@[50,80,90]", three, NULL},
    {"[4,5]", "@[4,5,6]", three, NULL},
    {"[4,5]", "[4,\"@5\"]", number, NULL},
    {"[100,120]", "@[100]", "1 values, but the lens has 2 positions", NULL},
};

int main(void)
{
    check_meanings("good.json", good, CASES(meanings));
    check_meanings("inches.json", good_inches, CASES(inches));
    check_meanings("zoom.json", zoom, CASES(zooms));
    check_refusals("bad.json", good, CASES(refusals));
    check_refusals("bad.json", good, CASES(surfaces));
    check_refusals("zoom.json", zoom, CASES(zoom_refusals));
    return check_report();
}
