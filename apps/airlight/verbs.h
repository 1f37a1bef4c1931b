#pragma once
#include "verb.h"

Action set_up_info(CLI::App& verb);
Action set_up_list(CLI::App& verb);
Action set_up_merge(CLI::App& verb);
Action set_up_mix(CLI::App& verb);
Action set_up_probe(CLI::App& verb);
Action set_up_compare(CLI::App& verb);
Action set_up_render(CLI::App& verb);
Action set_up_reproduce(CLI::App& verb);

/// Every verb there is. To add one: its file beside this one and its two lines here.
inline constexpr Verb verbs[] = {
    {"render", "turn a scene into a picture", set_up_render},
    {"merge", "add up the samples of several renders of one scene", set_up_merge},
    {"mix", "dim and colour the light groups of a rendered picture", set_up_mix},
    {"probe", "tell what happens along the camera rays of a pixel", set_up_probe},
    {"info", "tell what is in a scene and what to expect of it", set_up_info},
    {"compare", "measure how far estimators are from a reference, as a page", set_up_compare},
    {"list", "tell everything that scenes and renders can be made of", set_up_list},
    {"reproduce", "compute a figure of a paper again and hold it to its numbers", set_up_reproduce},
};
