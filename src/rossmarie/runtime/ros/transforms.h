// Part of ROSSMARie, the same for all rules: SHA256SUMS lists it. Change nothing here.
// Transforms between frames: a message on /tf has any number of them, from any node.
#pragma once

#include <cmath>
#include <string>
#include <type_traits>
#include <utility>

// True if a text is the name of a frame. Older programs write a slash in front, which tf2 leaves
// out.
inline bool is_frame(const std::string &text, const char *name)
{
    const std::size_t first = !text.empty() && text[0] == '/' ? 1 : 0;
    return text.compare(first, std::string::npos, name) == 0;
}

template <class Message>
using Transform = std::decay_t<decltype(std::declval<const Message &>().transforms[0].transform)>;

// The transform of a frame with another parent than declared: its place is unknown.
template <class Message> const Transform<Message> &unknown_transform()
{
    static const Transform<Message> unknown = [] {
        Transform<Message> found;
        found.translation.x = found.translation.y = found.translation.z = NAN;
        found.rotation.x = found.rotation.y = found.rotation.z = found.rotation.w = NAN;
        return found;
    }();
    return unknown;
}

// The transform from the frame `child` to `parent`, the last one if there are several; one that is
// not known if the last one is to another parent; null if there is none.
template <class Message>
const Transform<Message> *transform_in(const Message &message, const char *parent,
                                       const char *child)
{
    const Transform<Message> *found = nullptr;
    for (const auto &each : message.transforms)
        if (is_frame(each.child_frame_id, child))
            found = is_frame(each.header.frame_id, parent) ? &each.transform
                                                           : &unknown_transform<Message>();
    return found;
}
