// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
// Finds a transform between two frames. A message on /tf contains any number of transforms, from
// any node.
#pragma once

#include <cmath>
#include <string>
#include <type_traits>
#include <utility>

// Returns true if a text is the name of a frame. Older programs write a leading slash, which tf2
// removes.
inline bool is_frame(const std::string &text, const char *name)
{
    const std::size_t first = !text.empty() && text[0] == '/' ? 1 : 0;
    return text.compare(first, std::string::npos, name) == 0;
}

template <class Message>
using Transform = std::decay_t<decltype(std::declval<const Message &>().transforms[0].transform)>;

// Returns the transform of a frame with another parent than declared: its pose is unknown.
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

// Returns the last transform from the frame `child` to `parent`. Returns an unknown transform if
// the last transform of `child` has another parent, and null if there is no transform of `child`.
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
