// Part of ROSSMARie, the same for all rules. Do not edit it: SHA256SUMS lists its hash.
//
// The parameters of the node, as the parameter server had them at the start of the node.
#pragma once

#include <ros/ros.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <string>
#include <utility>
#include <vector>

#include "settings.h"

class Parameters : public ParameterSource {
public:
    Parameters() : node_(ros::this_node::getName())
    {
        ros::param::get(node_, given_);
        if (given_.getType() != XmlRpc::XmlRpcValue::TypeStruct)
            given_ = XmlRpc::XmlRpcValue();
    }

    // Sets the parameters again on a restarted master, which has none. The restarted node needs
    // them.
    void give_to_master() const
    {
        if (given_.valid())
            ros::param::set(node_, given_);
    }

    std::vector<std::string> names() const override
    {
        std::vector<std::string> names;
        if (given_.valid())
            for (const auto &given : given_)
                names.push_back(given.first);
        return names;
    }

    bool read(const std::string &name, double &value) const override
    {
        if (!is_given(name))
            return false;
        const XmlRpc::XmlRpcValue &given = given_[name];
        if (given.getType() == XmlRpc::XmlRpcValue::TypeInt)
            value = static_cast<const int &>(given);
        else if (given.getType() == XmlRpc::XmlRpcValue::TypeDouble)
            value = static_cast<const double &>(given);
        else
            throw BadParameter(name, "the value must be a number");
        return true;
    }

    bool read(const std::string &name, std::string &value) const override
    {
        if (!is_given(name))
            return false;
        value = text(name, given_[name]);
        return true;
    }

    bool read(const std::string &name, std::vector<std::string> &value) const override
    {
        if (!is_given(name))
            return false;
        const XmlRpc::XmlRpcValue &given = given_[name];
        if (given.getType() != XmlRpc::XmlRpcValue::TypeArray)
            throw BadParameter(name, "the value must be a list of strings");
        value.clear();
        for (int i = 0; i < given.size(); i++)
            value.push_back(text(name, given[i]));
        return true;
    }

private:
    bool is_given(const std::string &name) const
    {
        return given_.valid() && given_.hasMember(name);
    }

    static std::string text(const std::string &name, const XmlRpc::XmlRpcValue &value)
    {
        if (value.getType() != XmlRpc::XmlRpcValue::TypeString)
            throw BadParameter(name, "the value must be a string");
        return static_cast<const std::string &>(value);
    }

    std::string node_;
    XmlRpc::XmlRpcValue given_;
};
