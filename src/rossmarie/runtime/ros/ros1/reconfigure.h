// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
//
// The wire format of the service dynamic_reconfigure/Reconfigure. Some ROS systems lack the C++
// headers of this package.
#pragma once

#include <ros/serialization.h>
#include <ros/service_traits.h>

#include <cstdint>
#include <string>
#include <vector>

namespace reconfigure {

template <class Value> struct Parameter {
    std::string name;
    Value value;
};

struct Group {
    std::string name;
    uint8_t state;
    int32_t id;
    int32_t parent;
};

// The request, and the response, of the service.
struct Config {
    std::vector<Parameter<uint8_t>> bools;
    std::vector<Parameter<int32_t>> ints;
    std::vector<Parameter<std::string>> strs;
    std::vector<Parameter<double>> doubles;
    std::vector<Group> groups;
};

} // namespace reconfigure

namespace ros {
namespace service_traits {

template <> struct MD5Sum<reconfigure::Config> {
    static const char *value() { return "bb125d226a21982a4a98760418dc2672"; }
    static const char *value(const reconfigure::Config &) { return value(); }
};

} // namespace service_traits

namespace serialization {

template <class Value> struct Serializer<reconfigure::Parameter<Value>> {
    template <class Stream, class Parameter>
    static void allInOne(Stream &stream, Parameter parameter)
    {
        stream.next(parameter.name);
        stream.next(parameter.value);
    }
    ROS_DECLARE_ALLINONE_SERIALIZER
};

template <> struct Serializer<reconfigure::Group> {
    template <class Stream, class Group> static void allInOne(Stream &stream, Group group)
    {
        stream.next(group.name);
        stream.next(group.state);
        stream.next(group.id);
        stream.next(group.parent);
    }
    ROS_DECLARE_ALLINONE_SERIALIZER
};

template <> struct Serializer<reconfigure::Config> {
    template <class Stream, class Config> static void allInOne(Stream &stream, Config config)
    {
        stream.next(config.bools);
        stream.next(config.ints);
        stream.next(config.strs);
        stream.next(config.doubles);
        stream.next(config.groups);
    }
    ROS_DECLARE_ALLINONE_SERIALIZER
};

} // namespace serialization
} // namespace ros
