"""The robot of the thesis in MuJoCo, its safety rules, and its experiments.

A robot that is modelled on Heron drives in a physical simulation; its sensors and its commands are
ROS topics by name and type. Safety rules written in ROSSMARie guard it.
"""
