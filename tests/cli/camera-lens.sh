# a camera with one lens of its own brings the focal length where nothing else settles it
. "$TESTS/try.inc"
try fov --sensor 'iPhone 14 Pro' --columns focal,horizontal
try fov --gsd 2cm --sensor 'Phantom 4 Pro' --columns focal,altitude,ground_width
# 10 m/s in 1/500 s is 20 mm, of pixels of 60 m x 2.412 um/8.8 mm = 16.4 mm: 1.216
try motion --speed 10m/s -s 60m -t 1/500 --sensor 'Phantom 4 Pro' --columns focal,blur_pixels
# what is given, or solved for, goes before
try fov -f 24mm --sensor 'iPhone 14 Pro' --columns focal
try fov --horizontal 60deg --sensor 'Phantom 4 Pro' --columns focal
try fov --field-width 10m -s 20m --sensor 'DJI Mini 2' --columns focal
try motion --speed 10m/s -s 60m -t 1/500 --blur 2px --sensor 'Phantom 4 Pro' --columns focal,magnification
try motion -m 1:10 --speed 1m/s --sensor 'Phantom 4 Pro' --columns magnification,time
# cameras of many lenses
try fov --sensor 'Nikon D90'
