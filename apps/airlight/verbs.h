#pragma once
#include "verb.h"

Action set_up_render(CLI::App& verb);

/// Every verb there is. To add one: its file beside this one and its two lines here.
inline constexpr Verb verbs[] = {
    {"render", "turn a scene into a picture", set_up_render},
};
