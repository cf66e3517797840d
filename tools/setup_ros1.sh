#!/bin/sh
# Installs the Debian packages of ROS 1 for the live tests. Without ROS 1, these tests are skipped and
# the test run reports this.
set -eu
cd "$(dirname "$0")/.."

exec tools/setup_debian.sh \
    g++ cmake make catkin python3-catkin-pkg rospack-tools ros-message-generation \
    ros-message-runtime python3-rosmaster python3-roslaunch rosout python3-rospy libroscpp-dev \
    ros-std-msgs ros-geometry-msgs ros-sensor-msgs ros-nav-msgs ros-diagnostic-msgs \
    ros-tf2-msgs ros-actionlib-msgs ros-std-srvs ros-trajectory-msgs ros-rosgraph-msgs \
    libstd-msgs-dev libgeometry-msgs-dev libsensor-msgs-dev libnav-msgs-dev libdiagnostic-msgs-dev \
    libtf2-msgs-dev libactionlib-msgs-dev libtrajectory-msgs-dev libstd-srvs-dev \
    python3-std-msgs python3-geometry-msgs python3-sensor-msgs python3-nav-msgs \
    python3-tf2-msgs python3-diagnostic-msgs python3-actionlib-msgs python3-trajectory-msgs python3-std-srvs \
    python3-actionlib libactionlib-dev libtopic-tools-dev python3-topic-tools \
    topic-tools python3-dynamic-reconfigure python3-rostopic python3-rosservice python3-rosbag
