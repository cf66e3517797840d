// Part of ROSSMARie, the same for all rules: SHA256SUMS lists it. Change nothing here.
//
// Transforms between frames: a message on /tf has any number of them, for anybody.
#pragma once

#include <string>
#include <type_traits>

// Whether a text is the name of a frame. Older programs write a slash in front, which tf2 leaves
// out.
inline bool is_frame(const std::string &text, const char *name)
{
    const std::size_t first = !text.empty() && text[0] == '/' ? 1 : 0;
    return text.compare(first, std::string::npos, name) == 0;
}

// The transform from the frame `child` to `parent`, the last one if there are several; null if
// there is none.
template <class Message>
auto transform_in(const Message &message, const char *parent, const char *child)
    -> const std::decay_t<decltype(message.transforms[0].transform)> *
{
    const std::decay_t<decltype(message.transforms[0].transform)> *found = nullptr;
    for (const auto &each : message.transforms)
        if (is_frame(each.header.frame_id, parent) && is_frame(each.child_frame_id, child))
            found = &each.transform;
    return found;
}
