// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
//
// Access to the stamp in the header of a message, if the message has a header.
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

template <class Message> auto stamp_of(Message &message, int) -> decltype(&message.header.stamp)
{
    return &message.header.stamp;
}
template <class Message> std::nullptr_t stamp_of(Message &, long) { return nullptr; }

template <class Message> constexpr bool has_stamp()
{
    return !std::is_same_v<decltype(stamp_of(std::declval<Message &>(), 0)), std::nullptr_t>;
}

// Sets the stamp of a message, if the message has one.
template <class Message, class Time> void put_stamp(Message &message, const Time &time)
{
    if constexpr (has_stamp<Message>())
        *stamp_of(message, 0) = time;
}
