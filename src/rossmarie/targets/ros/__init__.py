"""What the targets for ROS 1 and ROS 2 share: a node that monitors, acts, and filters commands."""
